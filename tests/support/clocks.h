// SPDX-License-Identifier: MIT
// Clocks and limits for tests. Tests that use the simulated clocks do not depend on the machine's
// clock; HangLimit uses the machine's clock.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "model/limits.h"

namespace grove::detail::testing {

// A deadline in the past.
inline constexpr Limits::Clock::time_point kPast{};

// A clock for Limits that advances only in advance(). Any thread may read it; advance(): one thread
// at a time.
class ManualClock {
 public:
  // Installs this clock in `limits`. This object must outlive the last use of `limits`.
  explicit ManualClock(Limits& limits) {
    limits.set_clock([this] { return Limits::Clock::time_point(time_.load()); });
  }
  void advance(std::chrono::milliseconds time) { time_ = time_.load() + time; }

 private:
  std::atomic<Limits::Clock::duration> time_{std::chrono::hours(1)};
};

// Limits whose deadline passes after `readings` readings of the clock. Each reading advances the
// clock by one millisecond, so that a single-threaded run stops at the same point on every machine.
class ClockReadingLimit : public Limits {
 public:
  explicit ClockReadingLimit(std::int64_t readings) {
    set_clock([this] { return at(++readings_); });
    set_deadline(at(readings + 1));
  }
  // Number of clock readings so far.
  std::int64_t readings() const { return readings_; }

 private:
  static Clock::time_point at(std::int64_t readings) {
    return Clock::time_point(std::chrono::milliseconds(readings));
  }

  mutable std::atomic<std::int64_t> readings_{0};
};

// More readings than any run makes: with this value ClockReadingLimit only counts them.
inline constexpr std::int64_t kUnlimitedReadings = std::int64_t{1} << 40;

// Limits that stop a run only if it hangs (after 5 minutes).
class HangLimit : public Limits {
 public:
  HangLimit() { set_deadline(Clock::now() + std::chrono::minutes(5)); }
};

}  // namespace grove::detail::testing
