// SPDX-License-Identifier: MIT
#include "mpi/simulator/scaling_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace grove::detail {
namespace {

std::int64_t nodes_of(const SimulatedRun& run) {
  const auto nodes = run.solution.stats.counts.find("nodes_expanded");
  return nodes == run.solution.stats.counts.end() ? 0 : nodes->second;
}

double expanding_of(const SimulatedRun& run) {
  double sum = 0;
  for (const SimulatedRun::Rank& rank : run.ranks) sum += rank.worker.busy_s;
  return sum;
}

double ratio(double part, double whole) {
  return whole == 0 ? 0 : part / whole;
}

// Returns the relative increase from `before` to `now`.
double growth(double now, double before) {
  return ratio(now - before, before);
}

void count_messages(const SimulatedRun& run, ScalingRow& row) {
  double communication_s = 0;
  for (const SimulatedRun::Rank& rank : run.ranks) {
    row.messages += rank.messages;
    row.bytes += rank.bytes;
    communication_s += rank.communication_s;
  }
  const auto nodes = static_cast<double>(row.nodes);
  const SimulatedRun::Rank& coordinator = run.ranks.front();
  row.messages_per_node = ratio(static_cast<double>(row.messages), nodes);
  row.bytes_per_node = ratio(static_cast<double>(row.bytes), nodes);
  row.nodes_sent = run.solution.stats.counts.at("nodes_sent");
  row.communication_share = ratio(communication_s, run.wall_s * row.ranks);
  row.coordinator_communication_share = ratio(coordinator.communication_s, run.wall_s);
  row.coordinator_wait_s = ratio(coordinator.waited_s, static_cast<double>(coordinator.received));
}

void measure_load_balance(const SimulatedRun& run, ScalingRow& row) {
  double max_s = 0;
  std::int64_t working = 0;
  for (const SimulatedRun::Rank& rank : run.ranks) {
    max_s = std::max(max_s, rank.worker.busy_s);
    if (rank.worker.turns == 0) continue;
    ++working;
    row.first_node_s += rank.worker.first_turn_s;
  }
  row.first_node_s = ratio(row.first_node_s, static_cast<double>(working));
  row.ranks_without_node = row.ranks - working;
  row.max_over_mean = ratio(max_s * row.ranks, row.expanding_s);
  row.idle_share = 1 - ratio(row.expanding_s, run.wall_s * row.ranks);
}

}  // namespace

ScalingRow scaling_row(const SimulatedRun& run, const SimulatedRun& alone) {
  ScalingRow row;
  row.ranks = static_cast<int>(run.ranks.size());
  row.cost = run.solution.plan ? run.solution.plan->cost : -1;
  row.lower_bound = run.solution.lower_bound;
  row.wall_s = run.wall_s;
  row.status = "unfinished";
  if (!run.ended) return row;
  row.status = to_string(run.solution.status);
  row.nodes = nodes_of(run);
  row.expanding_s = expanding_of(run);
  if (alone.ended) {
    row.speed_up = ratio(alone.wall_s, run.wall_s);
    row.efficiency = row.speed_up / row.ranks;
    row.nodes_overhead =
        growth(static_cast<double>(row.nodes), static_cast<double>(nodes_of(alone)));
    row.expanding_overhead = growth(row.expanding_s, expanding_of(alone));
  }
  count_messages(run, row);
  measure_load_balance(run, row);
  return row;
}

std::string scaling_header() {
  return "ranks,status,cost,lower_bound,wall_s,speed_up,efficiency,nodes,nodes_overhead,"
         "expanding_s,expanding_overhead,messages,bytes,messages_per_node,bytes_per_node,"
         "nodes_sent,communication_share,coordinator_communication_share,coordinator_wait_s,max_"
         "over_mean,"
         "idle_share,first_node_s,ranks_without_node";
}

std::string csv_line(const ScalingRow& r) {
  return fmt::format(
      "{},{},{},{},{:.6g},{:.6g},{:.4f},{},{:.4f},{:.6g},{:.4f},{},{},{:.4f},{:.1f},{},{:.5f},"
      "{:.5f},{:.3g},{:.3f},{:.4f},{:.4g},{}",
      r.ranks, r.status, r.cost, r.lower_bound, r.wall_s, r.speed_up, r.efficiency, r.nodes,
      r.nodes_overhead, r.expanding_s, r.expanding_overhead, r.messages, r.bytes,
      r.messages_per_node, r.bytes_per_node, r.nodes_sent, r.communication_share,
      r.coordinator_communication_share, r.coordinator_wait_s, r.max_over_mean, r.idle_share,
      r.first_node_s, r.ranks_without_node);
}

}  // namespace grove::detail
