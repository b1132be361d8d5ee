// SPDX-License-Identifier: MIT
// Poll times of a rank, and delays of messages that are not urgent.
#pragma once

#include <algorithm>
#include <cmath>

namespace grove::detail {

// Polls the network with exponential back-off. A wake-up costs the searching threads more than it
// seems: some 40 us on a virtual machine (polling every 0.2 ms took 15 % of a search by one rank,
// every millisecond 5 %). But after one message another may follow, above all while nodes spread
// over ranks that have none. So a rank polls again soon after it has received a message, and then
// less often: 1, 2, 4, ... times the minimum interval after the message, up to the maximum
// interval, and from then on once per maximum interval. (Simulated: maximum intervals of 4 ms and
// of 1 ms make no difference with 128 and 1,024 ranks; with 16 ms an instance took 128 ranks a
// tenth longer.)
constexpr double kMaxPollInterval_s = 4e-3;
constexpr double kMinPollInterval = 1.0 / 16;  // as a fraction of the maximum interval

// Maximum poll interval in seconds, `of_who_searches` during the search. If the search `has_ended`
// it is shorter: no thread can be disturbed any more, and the job waits for the remaining messages.
inline double max_poll_interval(bool has_ended, double of_who_searches = kMaxPollInterval_s) {
  return has_ended ? of_who_searches * kMinPollInterval : of_who_searches;
}

// The first poll at `time` or later of a rank that received its last message at `heard`. All in
// seconds of one clock.
inline double next_poll(double heard, double time, double max_poll_interval = kMaxPollInterval_s) {
  if (max_poll_interval <= 0) return time;
  const double elapsed = std::max(time - heard, kMinPollInterval * max_poll_interval);
  double interval = kMinPollInterval * max_poll_interval;
  while (interval < std::min(elapsed, max_poll_interval)) interval *= 2;
  if (elapsed > interval) interval = max_poll_interval * std::ceil(elapsed / max_poll_interval);
  return std::max(time, heard + interval);  // rounding must not make it earlier
}

constexpr double kMaxPause_s = 20e-3;

// Minimum time between two messages that are not urgent, `time` after the beginning; `pause` is its
// value at the beginning. All in seconds. Information that is late by a hundredth of the time so
// far loses little, and each message wakes up its receiver.
inline double pause_at(double time, double pause) {
  return std::max(pause, std::min(time / 100, kMaxPause_s));
}

}  // namespace grove::detail
