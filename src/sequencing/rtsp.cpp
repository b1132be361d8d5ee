// SPDX-License-Identifier: MIT
#include "grove/sequencing/rtsp.h"

#include <stdexcept>

#include "grove/sequencing/cost_matrix.h"
#include "rtsp_backends.h"

namespace grove {
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
      return make_cbc_rtsp(matrix, limits);
  }
  throw std::invalid_argument("unknown rTSP back end");
}

}  // namespace grove
