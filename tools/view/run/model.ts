// SPDX-License-Identifier: MIT
// Data of the log of a run. Times are in seconds since the start of the program.

export interface Header {
  version: string;
  machine: string;
  options: string;
  method: string;
  threads: string;
  instance: string;
  agents: number;
  tasks: number;
}

// State of the run at a time.
export interface Row {
  kind: "incumbent" | "bound" | "tree" | "progress";
  time: number;
  nodes: number; // expanded
  open: number;
  bound: number;
  incumbent: number | null;
  memory: number; // megabytes
  source: string; // source of an incumbent
  raisedBy: Map<string, number>; // increase of the bound since the previous row, by source
}

// Megabytes by kind.
export const kMemory = ["nodes", "subproblems", "mdds", "dependencies"] as const;
export interface Counts {
  time: number;
  counts: Map<string, number>;
  process: number; // megabytes
  memory: number[]; // by kMemory
  ranks: Rank[]; // empty for a single process
}

// null: not reported.
export interface Rank {
  nodes: number | null;
  open: number | null;
  bound: number | null;
  memory: number | null;
  calls: number | null; // low-level searches
}

export type Outcome = "split" | "bound_raised" | "plan" | "pruned";

export interface Expanded {
  order: number; // from 1
  time: number;
  worker: number;
  outcome: Outcome;
  conflict: string;
  split: string;
  planCost: number; // if the outcome is a plan
}

export interface TreeNode {
  number: number;
  tree: number;
  parent: TreeNode | null;
  depth: number;
  bound: number;
  cost: number;
  conflicts: number | null;
  constraint: string; // its constraint, in words
  children: TreeNode[];
  expanded: Expanded | null;
}

// An event, in words.
export interface Moment {
  time: number | null;
  kind: string;
  text: string;
}

export interface Summary {
  status: string;
  cost: number | null;
  bound: number;
  planFile: string;
  seconds: number | null;
  stats: Map<string, number>;
}

export interface Run {
  header: Header | null; // null before the first line
  rows: Row[];
  counts: Counts[];
  roots: TreeNode[];
  expanded: TreeNode[]; // in order
  moments: Moment[];
  summary: Summary | null;
}
