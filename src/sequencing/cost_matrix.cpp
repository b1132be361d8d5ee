// SPDX-License-Identifier: MIT
#include "sequencing/cost_matrix.h"

#include <algorithm>

#include "sequencing/sequence.h"

namespace grove::detail {
namespace {

// Maximum of stops * states for ports: keeps the distances to the ports of an agent below 16 MB.
constexpr int kMaxPortStates = 1 << 20;

}  // namespace

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent,
                       const DistanceFields& distances) {
  const Agent& who = instance.agent(agent);
  const World& world = instance.world();
  const int n = static_cast<int>(who.stops.size());
  CostMatrix matrix{CostMatrix::Matrix(n + 1)};
  const auto fill_column = [&](int column, DistanceView distance) {
    for (int row = 0; row < n; ++row)
      matrix.cost(row, column) =
          row == column
              ? 0
              : min_distance_from(world, instance.task(who.stops[row]).cell, who.kind, distance);
    matrix.cost(n, column) = distance[who.start];
  };
  for (int stop = 0; stop < n; ++stop) fill_column(stop, distances.to_task(who.stops[stop]));
  if (!instance.rests_on_last_stop(agent)) fill_column(n, distances.to_rest(agent));
  // An agent that starts during a task execution completes it first.
  if (world.is_working(who.start))
    for (int stop = 0; stop < n; ++stop)
      if (who.stops[stop] != world.work(who.start).task) matrix.cost(n, stop) = kNever;
  return matrix;
}

CostMatrix port_matrix(const Instance& instance, AgentIndex agent,
                       const DistanceFields& distances) {
  const Agent& who = instance.agent(agent);
  const World& world = instance.world();
  const int n = static_cast<int>(who.stops.size());
  const bool apply = who.kind > 0 && distances.has_ports() && n > 0 &&
                     world.state_count() <= kMaxPortStates / n &&
                     instance.pose_of(who.start).steps == 0;
  if (!apply) return cost_matrix(instance, agent, distances);

  constexpr int kPorts = DistanceFields::kPorts;
  CostMatrix matrix{CostMatrix::Matrix(n * kPorts + 1), kPorts};
  const auto state = [&](int port) {
    return world.bases(instance.task(who.stops[port / kPorts]).cell, who.kind).first +
           port % kPorts;
  };
  const auto fill_column = [&](int column, DistanceView distance) {
    for (int port = 0; port < n * kPorts; ++port) matrix.cost(port, column) = distance[state(port)];
    matrix.cost(n * kPorts, column) = distance[who.start];
  };
  for (int port = 0; port < n * kPorts; ++port)
    fill_column(port, distances.to_port(who.stops[port / kPorts], who.kind, port % kPorts));
  if (!instance.rests_on_last_stop(agent)) fill_column(n * kPorts, distances.to_rest(agent));
  if (world.is_working(who.start))
    for (int port = 0; port < n * kPorts; ++port)
      if (who.stops[port / kPorts] != world.work(who.start).task)
        matrix.cost(n * kPorts, port) = kNever;
  return matrix;
}

CostMatrix min_matrix(const CostMatrix& matrix) {
  if (matrix.ports == 1) return matrix;
  const int n = matrix.stops();
  CostMatrix least{CostMatrix::Matrix(n + 1, kNever)};
  for (int row = 0; row < matrix.cost.size(); ++row)
    for (int column = 0; column < matrix.cost.size(); ++column) {
      Time& cost = least.cost(row / matrix.ports, column / matrix.ports);
      cost = std::min(cost, matrix.cost(row, column));
    }
  for (int stop = 0; stop <= n; ++stop)
    if (stop < n) least.cost(stop, stop) = 0;
  return least;
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

int common_parity(const CostMatrix& matrix) {
  if (matrix.ports > 1) return -1;
  const int n = matrix.stops();
  const auto odd = [&](int row, int column) { return matrix.cost(row, column) & 1; };
  const auto sum = [&](int from, int to) { return odd(from, n) ^ odd(n, to); };
  const int more =
      n > 1 ? odd(0, 1) ^ sum(0, 1) : 0;  // constant part of the parity of each leg between stops
  int parity = (n - 1) * more & 1;
  for (int stop = 0; stop < n; ++stop) {
    parity ^= sum(stop, stop);
    for (int to = 0; to < n; ++to)
      if (to != stop && odd(stop, to) != (sum(stop, to) ^ more)) return -1;
  }
  return parity;
}

}  // namespace grove::detail
