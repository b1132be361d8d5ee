// SPDX-License-Identifier: MIT
// How many workers are busy, over time.
#pragma once

#include <vector>

namespace grove::detail {

// Adds up stretches of time. Of one thread.
class BusyProfile {
 public:
  // One worker was busy from `from` to `to`, in seconds from 0.
  void add(double from, double to);

  // In `parts` equal parts of [0, end): the mean number of workers busy.
  std::vector<double> means(double end, int parts) const;

 private:
  void coarsen();

  double width_ = 1e-5;  // of a bin, in seconds
  std::vector<double> bins_ = std::vector<double>(std::size_t{1} << 16);
};

}  // namespace grove::detail
