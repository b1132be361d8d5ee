// SPDX-License-Identifier: MIT
// Data of a run log. Times are in seconds since the start of the program.

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

// State of the search at one time.
export interface Row {
  kind: "incumbent" | "bound" | "tree" | "progress";
  time: number;
  nodes: number; // number of expanded nodes
  open: number; // number of open nodes
  bound: number; // lower bound
  incumbent: number | null; // cost of the best plan; null: none
  memory: number; // in megabytes
  source: string; // only for an incumbent: the method that found it
  raisedBy: Map<string, number>; // increase of the lower bound since the previous row, by source
}

// How much each source has raised the lower bound up to a row.
export type Shares = Map<string, number>;

// Kinds of memory that the log reports.
export const kMemory = ["nodes", "subproblems", "mdds", "dependencies"] as const;
export interface Counts {
  time: number;
  counts: Map<string, number>;
  process: number; // memory of the whole process, in megabytes
  memory: number[]; // megabytes, in the order of kMemory
  ranks: Rank[]; // by rank; empty for a single process
}

// State of one rank, with memory in megabytes. null: not reported.
export interface Rank {
  nodes: number | null;
  open: number | null;
  bound: number | null;
  memory: number | null;
  calls: number | null; // number of low-level searches
}

export type Outcome = "split" | "bound_raised" | "plan" | "pruned";

export interface Expanded {
  order: number; // number of the expansion, from 1
  time: number;
  worker: number;
  outcome: Outcome;
  conflict: string;
  split: string;
  planCost: number; // cost of the plan if the outcome is `plan`; otherwise 0
}

export interface TreeNode {
  number: number;
  tree: number;
  parent: TreeNode | null;
  depth: number;
  bound: number;
  cost: number;
  conflicts: number | null;
  constraint: string; // the constraint that it adds to its parent, in words
  children: TreeNode[];
  expanded: Expanded | null;
}

// An event of another kind, in words.
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
  expanded: TreeNode[]; // in order of expansion
  moments: Moment[];
  summary: Summary | null;
}
