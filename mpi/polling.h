// SPDX-License-Identifier: MIT
// Poll times of a rank, and minimum intervals between messages that are not urgent.
#pragma once

#include <algorithm>
#include <cmath>

namespace grove::detail {

// A rank polls the network with exponential back-off. Each wake-up of the polling thread costs the
// searching threads some 40 us on a virtual machine (with one rank, polling every 0.2 ms took 15 %
// of the search time, every millisecond 5 %). However, one message is often followed by another,
// above all while nodes spread to ranks that have none. Therefore a rank polls 1, 2, 4, ... times
// the minimum interval after a message, up to the maximum interval, and from then on once per
// maximum interval. (Simulated with 128 and 1,024 ranks: maximum intervals of 4 ms and 1 ms make no
// difference; with 16 ms an instance took 128 ranks a tenth longer.)
constexpr double kMaxPollInterval_s = 4e-3;
constexpr double kMinPollInterval = 1.0 / 16;  // as a fraction of the maximum interval

// Returns the maximum poll interval in seconds: `search_interval` during the search, and a shorter
// one after its end, because then no thread can be disturbed and the job waits for the remaining
// messages.
inline double max_poll_interval(bool has_ended, double search_interval = kMaxPollInterval_s) {
  return has_ended ? search_interval * kMinPollInterval : search_interval;
}

// Returns the time of the first poll at or after `time` by a rank that received its last message at
// `heard`. All times are in seconds of one clock.
inline double next_poll(double heard, double time, double max_poll_interval = kMaxPollInterval_s) {
  if (max_poll_interval <= 0) return time;
  const double elapsed = std::max(time - heard, kMinPollInterval * max_poll_interval);
  double interval = kMinPollInterval * max_poll_interval;
  while (interval < std::min(elapsed, max_poll_interval)) interval *= 2;
  if (elapsed > interval) interval = max_poll_interval * std::ceil(elapsed / max_poll_interval);
  return std::max(time, heard + interval);  // guards against rounding errors
}

constexpr double kMaxPause_s = 20e-3;

// Returns the minimum interval between two messages that are not urgent, at `time` after the start
// of the run; `pause` is the interval at the start. All in seconds. The interval grows to a
// hundredth of `time`, but not above kMaxPause_s, because each message wakes its receiver, and
// information loses little value in that time.
inline double pause_at(double time, double pause) {
  return std::max(pause, std::min(time / 100, kMaxPause_s));
}

}  // namespace grove::detail
