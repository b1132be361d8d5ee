// SPDX-License-Identifier: MIT
// What the log of a run says, as the page holds it. Times in seconds since the program began.

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

// Where the run stands.
export interface Row {
  kind: "incumbent" | "bound" | "tree" | "progress";
  time: number;
  nodes: number; // expanded
  open: number;
  bound: number;
  incumbent: number | null;
  memory: number; // megabytes
  source: string; // of an incumbent
  raisedBy: Map<string, number>; // the bound, since the row before: by what and how far
}

// Megabytes by kind.
export const kMemory = ["nodes", "prices", "path_sets", "groups"] as const;
export interface Counts {
  time: number;
  counts: Map<string, number>;
  process: number; // megabytes
  memory: number[]; // by kMemory
  ranks: Rank[]; // none where one process searches
}

// null: it has not told.
export interface Rank {
  nodes: number | null;
  open: number | null;
  bound: number | null;
  memory: number | null;
  calls: number | null; // of the low level
}

export type Outcome = "split" | "raise" | "plan" | "closed";

export interface Expanded {
  order: number; // from 1
  time: number;
  worker: number;
  outcome: Outcome;
  conflict: string;
  split: string;
  planCost: number; // of a plan
}

export interface TreeNode {
  number: number;
  tree: number;
  parent: TreeNode | null;
  depth: number;
  bound: number;
  cost: number;
  conflicts: number | null;
  demand: string; // what it demands beyond its parent
  children: TreeNode[];
  expanded: Expanded | null;
}

// Something to know of, in words.
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
