// SPDX-License-Identifier: MIT
// Explanations of the words in the log.

import type { Run } from "./model";

// Texts for kinds of splits, by their names in `split` of a node. Counters `splits_...` have underscores
// instead of dashes.
export const kSplits: Record<string, string> = {
  "vertex-edge": "one of two robots avoids a place or a move at some time",
  "cost": "two robots together cost more than each on its own: one of them finishes later",
  "target": "a robot rests early and no other robot passes, or it rests later",
  "corridor": "one of two robots does not pass through a corridor at some time",
  "sequence": "a robot visits this place as its next one, or does not",
};

export const kPlanSources: Record<string, string> = {
  tree: "the tree search",
  start: "given by --start or a checkpoint",
  prioritized: "robots planned one after the other (prioritized planning)",
  lacam: "all robots moved together (LaCAM)",
  lns: "parts of a plan planned again (large neighbourhood search)",
  joint: "all robots searched together (A*)",
  cores: "a search for unsatisfiable cores",
};

// Sources of the lower bound, in the order in which the chart stacks them.
export const kBoundSources: Record<string, string> = {
  individual: "costs of single robots",
  wdg: "joint costs of groups of robots",
  branching: "splits on conflicts",
  tree: "the tree search of the ranks",
  lagrangian: "the Lagrangian bound",
  joint: "joint search of all robots",
  cores: "unsatisfiable cores",
};

export const kOutcomes: Record<string, string> = {
  split: "split into two nodes",
  bound_raised: "bound raised: groups of robots cost more together",
  plan: "its paths are a plan without conflicts",
  pruned: "pruned: no plan below this node is cheaper than the best one",
};

export function seconds(time: number): string {
  if (time < 1) return `${Number((time * 1000).toPrecision(3))} ms`;
  if (time < 120) return `${Number(time.toPrecision(3))} s`;
  return time < 7200 ? `${(time / 60).toFixed(1)} min` : `${(time / 3600).toFixed(1)} h`;
}

export function number(value: number): string {
  return value.toLocaleString("en");
}

export function megabytes(value: number): string {
  return value >= 1000 ? `${(value / 1000).toFixed(2)} GB` : `${value.toFixed(1)} MB`;
}

export function percent(cost: number, bound: number): string {
  if (cost === bound) return "0 %";
  return bound > 0 ? `${Number((((cost - bound) / bound) * 100).toPrecision(2))} %` : "no limit";
}

// Returns a sentence about the quality of the plan.
export function verdict(run: Run): string {
  const last = run.rows[run.rows.length - 1];
  const status = run.summary?.status ?? "";
  const cost = run.summary ? run.summary.cost : last?.incumbent ?? null;
  const bound = run.summary?.bound ?? last?.bound ?? 0;
  if (status === "infeasible") return "Proven: there is no plan.";
  if (cost === null)
    return `No plan yet${run.summary ? " when a limit was reached" : ""}; none costs less than ${number(bound)}.`;
  if (cost === bound) return `Optimal: a plan of ${number(cost)} steps, and none costs less.`;
  const gap = bound > 0 ? `at most ${percent(cost, bound)} above the best possible plan` :
    "the distance from the best plan is unknown";
  return `A plan of ${number(cost)} steps; none costs less than ${number(bound)}: ${gap}.`;
}
