// SPDX-License-Identifier: MIT
// Names in logs of versions before 0.1, with their current names.

export const kCounters: Record<string, string> = {
  batches: "node_batches",
  facts_sent: "learned_bounds_sent",
  gain_configurations: "gain_lacam",
  gain_neighborhood: "gain_lns",
  gain_priorities: "gain_prioritized",
  helps: "assists",
  joint_pairs: "joint_mdd_nodes",
  path_sets_asked: "mdd_queries",
  path_sets_known: "mdd_hits",
  plans_configurations: "plans_lacam",
  plans_neighborhood: "plans_lns",
  plans_priorities: "plans_prioritized",
  prices_asked: "branching_cost_queries",
  prices_known: "branching_cost_hits",
  prices_of_ranks: "remote_pricings",
  primal_joint_steps: "primal_lacam_steps",
  primal_neighborhoods: "primal_lns_iterations",
  silent_ranks: "unresponsive_ranks",
  splits_bar: "splits_vertex_edge",
  splits_no_rest_by: "splits_cost",
  splits_no_traversal: "splits_corridor",
  splits_rest_by: "splits_target",
  splits_stop_is_not: "splits_sequence",
  trees_prepared_in_vain: "trees_prepared_unused",
};
export const kPlanSources: Record<string, string> = {
  priorities: "prioritized", configurations: "lacam", neighborhood: "lns",
};
export const kBoundSources: Record<string, string> = {
  sequences: "individual", groups: "wdg", splits: "branching",
};
export const kMemory: Record<string, string> = {
  prices: "subproblems", path_sets: "mdds", groups: "dependencies",
};
export const kOutcomes: Record<string, string> = { raise: "bound_raised", closed: "pruned" };
export const kSplits: Record<string, string> = {
  "bar": "vertex-edge", "no-rest-by": "cost", "rest-by": "target", "no-traversal": "corridor",
  "stop-is-not": "sequence",
};

// Returns the current name for a name in a log.
export function current(renamed: Record<string, string>, name: string): string {
  return renamed[name] ?? name;
}
