// SPDX-License-Identifier: MIT
// The back ends behind make_rtsp_solver, each in the file of its name.
#pragma once

#include <cstddef>
#include <memory>

#include "sequencing/rtsp.h"

namespace grove::detail {

// Up to here a table takes less than a millisecond and 0.5 MB (four times that with ports);
// sequence graphs take about as long from here on, stay small, and only deep lists come from them
// more slowly.
inline constexpr int kTableStops = 14;

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits);
// A graph of all sequences may have so many states, some 0.2 s; larger ones are of canonical
// sequences alone.
inline constexpr std::size_t kMostGraphStates = std::size_t{1} << 16;
std::unique_ptr<RtspSolver> make_bounded_dp(const CostMatrix& matrix, const Limits& limits,
                                            std::size_t most_states = kMostGraphStates);
std::unique_ptr<RtspSolver> make_cbc_rtsp(const CostMatrix& matrix, const Limits& limits);

}  // namespace grove::detail
