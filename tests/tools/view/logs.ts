// SPDX-License-Identifier: MIT
// Log events for tests.

export function lines(events: object[]): string {
  return events.map((event) => `${JSON.stringify(event)}\n`).join("");
}

export function header(more: object = {}): object {
  return { event: "header", version: "grove 1", machine: "here", options: "", method: "auto", threads: "2",
    instance: "first.cts.json", agents: 2, tasks: 3, ...more };
}

export function row(more: object): object {
  return { event: "progress", time_s: 0.5, nodes: 4, open: 2, trees: 1, lower_bound: 3, incumbent: null,
    gap: null, memory_mb: 10, ...more };
}

export function incumbent(more: object): object {
  return row({ event: "incumbent", source: "tree", ...more });
}

export function counts(numbers: object, more: object = {}): object {
  return { event: "counts", time_s: 1, counts: numbers,
    memory_mb: { process: 10, nodes: 1, subproblems: 2, mdds: 3, dependencies: 4 }, ...more };
}

export function root(number: number): object {
  return { event: "root", time_s: 0.1, node: number, tree: 0, bound: 3, cost: 3 };
}

export function node(number: number, outcome: string, children: number[]): object {
  return { event: "node", time_s: 0.2, node: number, worker: 0, outcome, cost: 5,
    children: children.map((child) => ({ node: child, bound: 3, cost: 3 })) };
}

export function summary(cost: number | null, bound: number, status = "optimal"): object {
  return { event: "summary", status, cost, lower_bound: bound, gap: 0, plan_file: "p.json", stats: { wall_s: 2 } };
}
