// SPDX-License-Identifier: MIT
// Time in unit tests: that of the machine decides nothing.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "model/limits.h"

namespace grove::detail::testing {

// A deadline that has passed.
inline constexpr Limits::Clock::time_point kPast{};

// The clock of some limits, which stands still until the test advances it. Thread-safe.
class ManualClock {
 public:
  // This must outlive the last use of `limits`.
  explicit ManualClock(Limits& limits) {
    limits.set_clock([this] { return Limits::Clock::time_point(time_.load()); });
  }
  void advance(std::chrono::milliseconds time) { time_ = time_.load() + time; }

 private:
  std::atomic<Limits::Clock::duration> time_{std::chrono::hours(1)};
};

// Limits whose deadline passes after `looks` readings of their clock, each of which takes a
// millisecond. So a run of one thread stops at the same point on every machine.
class LimitOfLooks : public Limits {
 public:
  explicit LimitOfLooks(std::int64_t looks) {
    set_clock([this] { return at(++looks_); });
    set_deadline(at(looks + 1));
  }
  // Readings so far.
  std::int64_t looks() const { return looks_; }

 private:
  static Clock::time_point at(std::int64_t looks) {
    return Clock::time_point(std::chrono::milliseconds(looks));
  }

  mutable std::atomic<std::int64_t> looks_{0};
};

// Counts readings, and limits nothing: as many as a whole run makes.
inline constexpr std::int64_t kNoEnd = std::int64_t{1} << 40;

// Limits that end a run only if it hangs.
class LimitOfHangs : public Limits {
 public:
  LimitOfHangs() { set_deadline(Clock::now() + std::chrono::minutes(5)); }
};

}  // namespace grove::detail::testing
