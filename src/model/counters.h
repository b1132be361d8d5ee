// SPDX-License-Identifier: MIT
// Counters of a run. counters.def declares each of them once.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace grove::detail {

enum class Counter : std::uint8_t {
#define GROVE_COUNTER(id, name, reported, title, meaning) id,
#include "model/counters.def"
#undef GROVE_COUNTER
};

inline constexpr std::size_t kCounterCount = 0
#define GROVE_COUNTER(id, name, reported, title, meaning) +1
#include "model/counters.def"
#undef GROVE_COUNTER
    ;

// When a counter is reported.
enum class CounterReported : std::uint8_t {
  kAlways,      // by each run with a search, even if it is 0
  kIfCounted,   // by each run with a part that counts it, even if it is 0
  kIfPositive,  // by each run in which it is not 0
};

struct CounterInfo {
  std::string_view name;
  CounterReported reported;
  std::string_view title;
  std::string_view meaning;
};

// By Counter.
extern const std::array<CounterInfo, kCounterCount> kCounters;

// Returns the counter `prefix` + `name`, in which each '-' is replaced by '_'; nullopt if there is
// none.
std::optional<Counter> counter_named(std::string_view prefix, std::string_view name);

// The values of all counters. A value type.
class Counters {
 public:
  // The value, to change it. The counter is then among the counted ones.
  std::int64_t& operator[](Counter counter) {
    counted_.set(index(counter));
    return values_[index(counter)];
  }
  std::int64_t operator[](Counter counter) const { return values_[index(counter)]; }

  Counters& operator+=(const Counters& more);
  // Subtracts the values. Which counters are counted does not change.
  Counters& operator-=(const Counters& less);

  // By name: the values of the counted counters, without those that are kIfPositive and 0.
  std::map<std::string, std::int64_t> named() const;

 private:
  static std::size_t index(Counter counter) { return static_cast<std::size_t>(counter); }

  std::array<std::int64_t, kCounterCount> values_{};
  std::bitset<kCounterCount> counted_;
};

// Adds `more` to `counts`, name by name.
void add(const Counters& more, std::map<std::string, std::int64_t>& counts);
// Adds each absent counter that is always reported (kAlways), with the value 0.
void add_missing(std::map<std::string, std::int64_t>& counts);

}  // namespace grove::detail
