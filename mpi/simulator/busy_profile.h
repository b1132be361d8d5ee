// SPDX-License-Identifier: MIT
// Number of busy workers over time.
#pragma once

#include <vector>

namespace grove::detail {

// Sums the intervals in which workers are busy. One thread at a time.
class BusyProfile {
 public:
  // Adds one worker that was busy from `from` to `to`, in seconds >= 0.
  void add(double from, double to);

  // The mean number of busy workers in each of `parts` equal parts of [0, end).
  std::vector<double> means(double end, int parts) const;

 private:
  void coarsen();

  double width_ = 1e-5;  // width of a bin, in seconds
  std::vector<double> bins_ = std::vector<double>(std::size_t{1} << 16);
};

}  // namespace grove::detail
