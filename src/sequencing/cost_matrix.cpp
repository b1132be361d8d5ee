// SPDX-License-Identifier: MIT
#include "grove/sequencing/cost_matrix.h"

#include <algorithm>

#include "stop_set.h"

namespace grove {

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent,
                       const DistanceFields& distances) {
  const Agent& who = instance.agent(agent);
  const World& world = instance.world();
  const auto n = static_cast<Eigen::Index>(who.stops.size());
  CostMatrix matrix{CostMatrix::Matrix::Zero(n + 1, n + 1)};
  const auto fill_column = [&](Eigen::Index column, const DistanceField& distance) {
    for (Eigen::Index row = 0; row < n; ++row)
      matrix.cost(row, column) =
          row == column ? 0
                        : least_from(world, instance.task(who.stops[row]).cell, who.kind, distance);
    matrix.cost(n, column) = distance[who.start];
  };
  for (Eigen::Index stop = 0; stop < n; ++stop)
    fill_column(stop, distances.to_task(who.stops[stop]));
  if (!instance.rests_on_last_stop(agent)) fill_column(n, distances.to_rest(agent));
  // Work that is under way is completed first.
  if (world.is_working(who.start))
    for (Eigen::Index stop = 0; stop < n; ++stop)
      if (who.stops[stop] != world.work(who.start).task) matrix.cost(n, stop) = kNever;
  return matrix;
}

Time sequence_cost(const CostMatrix& matrix, const Sequence& sequence) {
  Time cost = 0;
  int last = matrix.stops();
  for (Stop stop : sequence) {
    cost = add_costs(cost, matrix.between(last, stop));
    last = stop;
  }
  return add_costs(cost, matrix.to_end(last));
}

}  // namespace grove
