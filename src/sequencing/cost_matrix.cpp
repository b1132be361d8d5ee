// SPDX-License-Identifier: MIT
#include "grove/sequencing/cost_matrix.h"

#include "stop_set.h"

namespace grove {

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent,
                       const DistanceFields& distances) {
  const Agent& who = instance.agent(agent);
  const auto n = static_cast<Eigen::Index>(who.tasks.size());
  std::vector<Cell> from;
  for (TaskIndex task : who.tasks) from.push_back(instance.task(task).cell);
  from.push_back(who.start);

  CostMatrix matrix{CostMatrix::Matrix::Zero(n + 1, n + 1)};
  const auto fill_column = [&](Eigen::Index column, const DistanceField& distance) {
    for (Eigen::Index row = 0; row <= n; ++row) matrix.cost(row, column) = distance[from[row]];
  };
  for (Eigen::Index stop = 0; stop < n; ++stop) fill_column(stop, distances.to(from[stop]));
  if (who.goal) fill_column(n, distances.to(*who.goal));
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
