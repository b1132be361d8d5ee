// SPDX-License-Identifier: MIT
// The back ends of make_rtsp_solver(), each in the file of its name.
#pragma once

#include <cstddef>
#include <memory>

#include "sequencing/rtsp.h"

namespace grove::detail {

// Largest number of stops for a table. Up to here a table takes less than a millisecond and 0.5 MB
// (four times that with ports). For more stops, sequence graphs take about as long and stay small;
// only long lists of sequences are slower with them.
inline constexpr int kTableStops = 14;

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits);
// Largest number of states in a graph of all sequences, about 0.2 s. Larger graphs hold only
// canonical sequences.
inline constexpr std::size_t kMostGraphStates = std::size_t{1} << 16;
std::unique_ptr<RtspSolver> make_bounded_dp(const CostMatrix& matrix, const Limits& limits,
                                            std::size_t most_states = kMostGraphStates);
std::unique_ptr<RtspSolver> make_cbc_rtsp(const CostMatrix& matrix, const Limits& limits);

}  // namespace grove::detail
