// SPDX-License-Identifier: MIT
#include "sequencing/rtsp.h"

#include <stdexcept>

#include "sequencing/cost_matrix.h"

namespace grove::detail {
std::vector<RtspBackend> rtsp_backends() {
  std::vector<RtspBackend> backends{RtspBackend::kAuto, RtspBackend::kHeldKarp,
                                    RtspBackend::kBoundedDp};
#ifdef GROVE_WITH_CBC
  backends.push_back(RtspBackend::kCbc);
#endif
  return backends;
}

std::unique_ptr<RtspSolver> make_rtsp_solver(RtspBackend backend, const CostMatrix& matrix,
                                             const Limits& limits) {
  switch (backend) {
    case RtspBackend::kAuto:
      return matrix.stops() <= kTableStops ? make_held_karp(matrix, limits)
                                           : make_bounded_dp(matrix, limits);
    case RtspBackend::kHeldKarp:
      return make_held_karp(matrix, limits);
    case RtspBackend::kBoundedDp:
      return make_bounded_dp(matrix, limits);
    case RtspBackend::kCbc:
#ifdef GROVE_WITH_CBC
      return make_cbc_rtsp(matrix, limits);
#else
      throw std::invalid_argument("Grove was built without CBC (GROVE_WITH_CBC)");
#endif
  }
  throw std::invalid_argument("unknown rTSP back end");
}

}  // namespace grove::detail
