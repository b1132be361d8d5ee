// SPDX-License-Identifier: MIT
// Cost matrices to test with. Random ones are the same for the same state of `random`.
#pragma once

#include <optional>
#include <random>
#include <string>

#include "model/instance.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/rtsp.h"

namespace grove::detail::testing {

using Random = std::mt19937;

enum class Variant { kCts, kMg };
inline constexpr Variant kVariants[] = {Variant::kCts, Variant::kMg};

// An instance of one agent with n tasks on a small random grid; places may be unreachable.
Instance random_instance(int n, Variant variant, Random& random);
CostMatrix grid_matrix(int n, Variant variant, Random& random);

// Symmetric, with the triangle inequality, of no common parity; not from a grid.
CostMatrix metric_matrix(int n, Variant variant, Random& random);

// Any costs at all: asymmetric, some legs without a way.
CostMatrix wild_matrix(int n, Variant variant, Random& random);

// The same with four ports a stop; every leg from and to every port has its own cost.
CostMatrix wild_port_matrix(int n, Variant variant, Random& random);
// An agent that turns, with n tasks on a small random grid, some of which take time.
CostMatrix turning_matrix(int n, Variant variant, Random& random);

void fill_column(CostMatrix& matrix, int column, Time cost);
// Multiplies all costs.
void scale(CostMatrix& matrix, Time factor);

// n tasks on a Moving AI map, from the first random scenario's starts; none when the map is absent.
std::optional<CostMatrix> map_matrix(const std::string& map, int n, Variant variant,
                                     Random& random);
inline constexpr const char* kMaps[] = {"empty-32-32", "random-32-32-20", "room-32-32-4"};

// A class of sequences of n stops: a random prefix and a random set forbidden after it.
SequenceClass random_class(int n, Random& random);

}  // namespace grove::detail::testing
