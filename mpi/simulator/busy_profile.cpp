// SPDX-License-Identifier: MIT
// The number of bins is fixed and all bins have the same width. If a time is beyond the last bin,
// pairs of bins are merged and the width doubles.
#include "mpi/simulator/busy_profile.h"

#include <algorithm>

namespace grove::detail {

void BusyProfile::add(double from, double to) {
  while (to >= width_ * static_cast<double>(bins_.size())) coarsen();
  const auto last = static_cast<std::size_t>(to / width_);
  for (auto bin = static_cast<std::size_t>(from / width_); bin <= last; ++bin) {
    const double begin = width_ * static_cast<double>(bin);
    bins_[bin] += std::max(0.0, std::min(to, begin + width_) - std::max(from, begin));
  }
}

void BusyProfile::coarsen() {
  const std::size_t half = bins_.size() / 2;
  for (std::size_t i = 0; i < half; ++i) bins_[i] = bins_[2 * i] + bins_[2 * i + 1];
  std::fill(bins_.begin() + static_cast<std::ptrdiff_t>(half), bins_.end(), 0);
  width_ *= 2;
}

std::vector<double> BusyProfile::means(double end, int parts) const {
  std::vector<double> means(static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double middle = width_ * (static_cast<double>(i) + 0.5);
    if (middle < end) means[static_cast<std::size_t>(middle / end * parts)] += bins_[i];
  }
  for (double& mean : means) mean *= parts / end;
  return means;
}

}  // namespace grove::detail
