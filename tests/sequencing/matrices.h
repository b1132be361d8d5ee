// SPDX-License-Identifier: MIT
// Cost matrices for tests. Random matrices depend only on the state of `random`.
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

// Returns an instance with one agent and n tasks on a small random grid, possibly with unreachable
// places.
Instance random_instance(int n, Variant variant, Random& random);
CostMatrix grid_matrix(int n, Variant variant, Random& random);

// A random metric (symmetric, with the triangle inequality) that is not derived from a grid, so its
// distances have no common parity. For kMg the costs to the end are 0.
CostMatrix metric_matrix(int n, Variant variant, Random& random);

// Arbitrary costs: asymmetric, with some infeasible legs.
CostMatrix wild_matrix(int n, Variant variant, Random& random);

// Arbitrary costs with four ports for each stop; each leg between two ports has its own cost.
CostMatrix wild_port_matrix(int n, Variant variant, Random& random);
// Costs of a turning agent with n tasks on a small random grid; tasks can have a duration.
CostMatrix turning_matrix(int n, Variant variant, Random& random);

void fill_column(CostMatrix& matrix, int column, Time cost);
// Multiplies all costs by `factor`.
void scale(CostMatrix& matrix, Time factor);

// Costs for n tasks on a Moving AI map; start, destination and tasks are on random cells. Returns
// nullopt if the map is missing.
std::optional<CostMatrix> map_matrix(const std::string& map, int n, Variant variant,
                                     Random& random);
inline constexpr const char* kMaps[] = {"empty-32-32", "random-32-32-20", "room-32-32-4"};

// Returns a class of sequences of n stops with a random prefix and a random set of stops that may
// not follow it.
SequenceClass random_class(int n, Random& random);

}  // namespace grove::detail::testing
