// SPDX-License-Identifier: MIT
#include "model/counters.h"

#include <algorithm>

namespace grove::detail {

const std::array<CounterInfo, kCounterCount> kCounters = {{
#define GROVE_COUNTER(id, name, reported, title, meaning) \
  {name, CounterReported::reported, title, meaning},
#include "model/counters.def"
#undef GROVE_COUNTER
}};

std::optional<Counter> counter_named(std::string_view prefix, std::string_view name) {
  std::string wanted(prefix);
  wanted += name;
  std::ranges::replace(wanted, '-', '_');
  const auto found = std::ranges::find(kCounters, wanted, &CounterInfo::name);
  if (found == kCounters.end()) return std::nullopt;
  return static_cast<Counter>(found - kCounters.begin());
}

Counters& Counters::operator+=(const Counters& more) {
  for (std::size_t i = 0; i < kCounterCount; ++i) values_[i] += more.values_[i];
  counted_ |= more.counted_;
  return *this;
}

Counters& Counters::operator-=(const Counters& less) {
  for (std::size_t i = 0; i < kCounterCount; ++i) values_[i] -= less.values_[i];
  return *this;
}

std::map<std::string, std::int64_t> Counters::named() const {
  std::map<std::string, std::int64_t> counts;
  for (std::size_t i = 0; i < kCounterCount; ++i)
    if (counted_[i] && (values_[i] != 0 || kCounters[i].reported != CounterReported::kIfPositive))
      counts.emplace(kCounters[i].name, values_[i]);
  return counts;
}

void add(const Counters& more, std::map<std::string, std::int64_t>& counts) {
  for (const auto& [name, count] : more.named()) counts[name] += count;
}

void add_missing(std::map<std::string, std::int64_t>& counts) {
  for (const CounterInfo& counter : kCounters)
    if (counter.reported == CounterReported::kAlways)
      counts.try_emplace(std::string(counter.name), 0);
}

}  // namespace grove::detail
