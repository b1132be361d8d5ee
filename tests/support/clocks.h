// SPDX-License-Identifier: MIT
// Simulated clocks, so that unit tests do not depend on the time of the machine.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "model/limits.h"

namespace grove::detail::testing {

// A deadline that has passed.
inline constexpr Limits::Clock::time_point kPast{};

// A clock for Limits that advances only when the test advances it. Thread-safe.
class ManualClock {
 public:
  // This object must outlive the last use of `limits`.
  explicit ManualClock(Limits& limits) {
    limits.set_clock([this] { return Limits::Clock::time_point(time_.load()); });
  }
  void advance(std::chrono::milliseconds time) { time_ = time_.load() + time; }

 private:
  std::atomic<Limits::Clock::duration> time_{std::chrono::hours(1)};
};

// Limits whose deadline passes after `looks` readings of their clock. Each reading advances the
// clock by one millisecond, so a single-threaded run stops at the same point on every machine.
class ClockReadingLimit : public Limits {
 public:
  explicit ClockReadingLimit(std::int64_t looks) {
    set_clock([this] { return at(++looks_); });
    set_deadline(at(looks + 1));
  }
  // Number of readings so far.
  std::int64_t looks() const { return looks_; }

 private:
  static Clock::time_point at(std::int64_t looks) {
    return Clock::time_point(std::chrono::milliseconds(looks));
  }

  mutable std::atomic<std::int64_t> looks_{0};
};

// Number of looks that no run reaches: ClockReadingLimit then only counts readings.
inline constexpr std::int64_t kUnlimitedLooks = std::int64_t{1} << 40;

// Limits that end a run only if it hangs.
class HangLimit : public Limits {
 public:
  HangLimit() { set_deadline(Clock::now() + std::chrono::minutes(5)); }
};

}  // namespace grove::detail::testing
