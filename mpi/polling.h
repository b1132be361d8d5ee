// SPDX-License-Identifier: MIT
// When a rank looks whether messages have come, and how long it waits with news of little weight.
#pragma once

#include <algorithm>
#include <cmath>

namespace grove::detail {

// To be woken up costs the threads that search more than it seems to: on a virtual machine some
// 40 us (looking every 0.2 ms took 15 % of a search by one rank, every millisecond 5 %). But where
// one message has come another may follow, above all while nodes spread over ranks that have none.
// So a rank looks again soon after it has heard something, and then ever more rarely: after 1, 2,
// 4, ... parts of the longest nap, and at the end of each nap of that length. (Simulated, naps of 4
// ms instead of one make no difference with 128 and 1,024 ranks; with naps of 16 an instance took
// 128 a tenth longer.)
constexpr double kMaxPollInterval_s = 4e-3;
constexpr double kMinPollInterval = 1.0 / 16;  // of the longest

// The longest nap of a rank whose search goes on or `has_ended`: then nothing is left to be
// disturbed, and the job waits for what is still to be said.
inline double max_poll_interval(bool has_ended, double of_who_searches = kMaxPollInterval_s) {
  return has_ended ? of_who_searches * kMinPollInterval : of_who_searches;
}

// The first look at `time` or later, of a rank that heard something last at `heard`. All in seconds
// of one clock.
inline double next_poll(double heard, double time, double max_poll_interval = kMaxPollInterval_s) {
  if (max_poll_interval <= 0) return time;
  const double elapsed = std::max(time - heard, kMinPollInterval * max_poll_interval);
  double interval = kMinPollInterval * max_poll_interval;
  while (interval < std::min(elapsed, max_poll_interval)) interval *= 2;
  if (elapsed > interval) interval = max_poll_interval * std::ceil(elapsed / max_poll_interval);
  return std::max(time, heard + interval);  // rounding must not make it earlier
}

constexpr double kLongestPause_s = 20e-3;

// How long news may wait that nothing hangs on, `time` after the beginning, if at first it may wait
// for `pause`. All in seconds. News that is late by a hundredth of the time so far loses little,
// and each message wakes up somebody.
inline double pause_at(double time, double pause) {
  return std::max(pause, std::min(time / 100, kLongestPause_s));
}

}  // namespace grove::detail
