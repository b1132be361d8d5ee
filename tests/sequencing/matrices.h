// SPDX-License-Identifier: MIT
// Cost matrices for tests. Random ones depend only on the state of `random`.
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

// A random metric: symmetric, with the triangle inequality, without common parity; not from a grid.
CostMatrix metric_matrix(int n, Variant variant, Random& random);

// Arbitrary costs: asymmetric, some legs infeasible.
CostMatrix wild_matrix(int n, Variant variant, Random& random);

// Arbitrary costs with four ports per stop; each leg between two ports has its own cost.
CostMatrix wild_port_matrix(int n, Variant variant, Random& random);
// An agent that turns, with n tasks on a small random grid, some of which take time.
CostMatrix turning_matrix(int n, Variant variant, Random& random);

void fill_column(CostMatrix& matrix, int column, Time cost);
// Multiplies all costs.
void scale(CostMatrix& matrix, Time factor);

// n tasks on a Moving AI map, from the starts of the first random scenario. Returns nullopt if the
// map is missing.
std::optional<CostMatrix> map_matrix(const std::string& map, int n, Variant variant,
                                     Random& random);
inline constexpr const char* kMaps[] = {"empty-32-32", "random-32-32-20", "room-32-32-4"};

// A class of sequences of n stops: a random prefix, and a random set of stops forbidden after it.
SequenceClass random_class(int n, Random& random);

}  // namespace grove::detail::testing
