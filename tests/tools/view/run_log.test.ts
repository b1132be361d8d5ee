// SPDX-License-Identifier: MIT
// Tests the log of a run and the layout of its tree.

import assert from "node:assert/strict";
import { test } from "node:test";
import { boundChart, boundSourcesOf, kSigns, sourcesChart } from "../../../tools/view/run/charts";
import { layout } from "../../../tools/view/run/layout";
import { Log } from "../../../tools/view/run/log";
import type { TreeNode } from "../../../tools/view/run/model";
import { linear, logarithmic, thin } from "../../../tools/view/run/scale";
import { kBoundSources, kPlanSources, kSplits, verdict } from "../../../tools/view/run/words";
import { counts, header, incumbent, lines, node, root, row, summary } from "./logs";

function read(...events: object[]) {
  const log = new Log();
  log.add(lines(events));
  return log.run;
}

test("a log is read", () => {
  const run = read(header(), row({ lower_bound: 30, raised_by: { individual: 30 } }),
    incumbent({ time_s: 1, lower_bound: 30, incumbent: 33 }), counts({ mdd_queries: 5 }), summary(33, 33));
  assert.equal(run.header!.agents, 2);
  assert.equal(run.rows.length, 2);
  assert.equal(run.rows[0].raisedBy.get("individual"), 30);
  assert.equal(run.rows[1].source, "tree");
  assert.equal(run.counts[0].counts.get("mdd_queries"), 5);
  assert.equal(run.summary!.cost, 33);
});

test("an incomplete line waits for the rest", () => {
  const text = lines([header(), row({}), root(0), summary(3, 3)]);
  for (let cut = 0; cut <= text.length; ++cut) {
    const log = new Log();
    log.add(text.slice(0, cut));
    log.add(text.slice(cut));
    assert.equal(log.run.rows.length, 1);
    assert.equal(log.run.summary!.cost, 3);
  }
});

test("errors name the line", () => {
  const wrong: [object[], RegExp][] = [
    [[row({})], /line 1: event: expected 'header' first/],
    [[header(), row({ lower_bound: "many" })], /line 2: lower_bound: expected a number/],
    [[header(), { event: "incumbent" }], /line 2: time_s/],
    [[header(), {}], /line 2: event: expected a text/],
    [[header(), node(7, "split", [])], /line 2: node: expected a node that was made before/],
    [[header(), root(0), node(0, "eaten", [])], /line 3: outcome: expected split/],
    [[header(), root(0), node(0, "split", [1, 1])], /line 3: children\[1\].node: expected a number of its own/],
  ];
  for (const [events, message] of wrong) assert.throws(() => read(...events), message);
  const log = new Log();
  assert.throws(() => log.add(`${lines([header()])}{"event": \n`), /line 2: the data is no JSON/);
});

test("logs with the old names are read", () => {
  const old = { ...node(1, "split", []), split: "rest-by",
    children: [{ node: 2, bound: 3, cost: 3, demand: "r1 waits" }] };
  const run = read(header(), row({ raised_by: { groups: 30 } }), incumbent({ source: "configurations" }),
    counts({ path_sets_asked: 5 }, { memory_mb: { process: 10, nodes: 1, prices: 2, path_sets: 3, groups: 4 } }),
    root(0), node(0, "raise", [1]), old, node(2, "closed", []));
  assert.equal(run.rows[0].raisedBy.get("wdg"), 30);
  assert.equal(run.rows[1].source, "lacam");
  assert.equal(run.counts[0].counts.get("mdd_queries"), 5);
  assert.deepEqual(run.counts[0].memory, [1, 2, 3, 4]);
  const split = run.roots[0].children[0];
  assert.equal(run.roots[0].expanded!.outcome, "bound_raised");
  assert.equal(split.expanded!.split, "target");
  assert.equal(split.children[0].constraint, "r1 waits");
  assert.equal(split.children[0].expanded!.outcome, "pruned");
});

test("unknown events are ignored", () => {
  assert.equal(read(header(), { event: "weather", text: "fine" }, row({})).rows.length, 1);
});

test("a tree is built from its events", () => {
  const run = read(header(), root(0), node(0, "bound_raised", [1]), node(1, "split", [2, 3]), node(3, "plan", []));
  assert.equal(run.roots.length, 1);
  const split = run.roots[0].children[0];
  assert.equal(split.expanded!.order, 2);
  assert.deepEqual(split.children.map((child) => child.number), [2, 3]);
  assert.equal(split.children[0].expanded, null);
  assert.equal(split.children[1].depth, 2);
});

// --- layout ---

function randomTree(seed: number, size: number): TreeNode[] {
  let state = seed;
  const dice = (sides: number) => (state = (state * 48271) % 0x7fffffff) % sides;
  const make = (number: number, parent: TreeNode | null): TreeNode => ({
    number, parent, tree: 0, depth: parent ? parent.depth + 1 : 0, bound: 0, cost: 0, conflicts: null,
    constraint: "", children: [], expanded: null,
  });
  const nodes = [make(0, null)];
  while (nodes.length < size) {
    const parent = nodes[dice(2) ? nodes.length - 1 : dice(nodes.length)];
    if (parent.children.length === 2) continue;
    const child = make(nodes.length, parent);
    parent.children.push(child);
    nodes.push(child);
  }
  return nodes;
}

test("nodes do not overlap; parents are over their children", () => {
  for (let seed = 1; seed <= 100; ++seed) {
    const nodes = randomTree(seed, seed * 3);
    const placed = layout([nodes[0]]);
    assert.equal(placed.size, nodes.length);
    const rows = new Map<number, number[]>();
    for (const { node: n, x, y } of placed.values()) {
      assert.equal(y, n.depth);
      rows.set(y, [...(rows.get(y) ?? []), x]);
      const xs = n.children.map((child) => placed.get(child)!.x);
      if (xs.length > 0) assert.ok(Math.min(...xs) <= x && x <= Math.max(...xs));
    }
    for (const row of rows.values()) {
      row.sort((a, b) => a - b);
      for (let i = 1; i < row.length; ++i) assert.ok(row[i] - row[i - 1] >= 1, `${seed}`);
    }
  }
});

test("a very deep tree is laid out", () => {
  const nodes = randomTree(1, 1);
  for (let i = 1; i < 100_000; ++i) {
    const parent = nodes[i - 1];
    nodes.push({ ...parent, number: i, parent, depth: i, children: [] });
    parent.children.push(nodes[i]);
  }
  assert.equal(layout([nodes[0]]).size, 100_000);
});

// --- charts and words ---

test("scales", () => {
  assert.deepEqual(linear(0, 10).marks(5), [0, 2, 4, 6, 8, 10]);
  assert.equal(linear(10, 20).at(15), 0.5);
  assert.equal(linear(7, 7).at(7), 0);
  assert.equal(logarithmic(0.01, 100).at(1), 0.5);
  assert.equal(logarithmic(0.01, 100).at(0), 0);
  const all = Array.from({ length: 1000 }, (_, i) => i);
  const thinned = thin(all, 10);
  assert.deepEqual([thinned.length, thinned[0], thinned[9]], [10, 0, 999]);
});

test("reading of a moment is its latest row", () => {
  const chart = boundChart(read(header(), row({ time_s: 1, lower_bound: 30 }),
    incumbent({ time_s: 2, lower_bound: 30, incumbent: 33 }),
    row({ time_s: 3, lower_bound: 33, incumbent: 33 })), false);
  assert.match(chart.read(0.5), /nothing known/);
  assert.match(chart.read(1.5), /less than 30; no plan yet/);
  assert.match(chart.read(2), /best plan 33, no plan costs less than 30, gap 10 %/);
  assert.match(chart.read(9), /gap 0 %/);
});

test("the bound is divided among its sources", () => {
  const run = read(header(), row({ time_s: 1, lower_bound: 30, raised_by: { individual: 30 } }),
    row({ time_s: 2, lower_bound: 35, raised_by: { cores: 3, wdg: 2 } }), row({ time_s: 3, lower_bound: 35 }),
    row({ time_s: 4, lower_bound: 36, raised_by: { cores: 1 } }));
  assert.deepEqual(boundSourcesOf(run), ["individual", "wdg", "cores"]);
  const chart = sourcesChart(run, false);
  const area = (source: string) => chart.series.find(({ kind }) => kind === `raised-${source}`)!;
  const values = (points: { value: number }[]) => points.map(({ value }) => value);
  assert.deepEqual(values(area("cores").points), [30, 35, 35, 36]); // the bound
  assert.deepEqual(values(area("cores").until!), [30, 32, 32, 32]);
  assert.deepEqual(values(area("wdg").points), values(area("cores").until!));
  assert.deepEqual(values(area("wdg").until!), [30, 30, 30, 30]);
  assert.deepEqual(values(area("individual").until!), [29, 29, 29, 29]); // the lower edge of the chart
  assert.match(chart.read(0.5), /nothing known/);
  assert.match(chart.read(3.5), /bound 35; of it costs of single robots 30, unsatisfiable cores 3, joint costs of groups/);
  assert.match(chart.read(4), /unsatisfiable cores 4/);
});

test("a bound without sources has no areas", () => {
  const run = read(header(), row({ lower_bound: 30 }));
  assert.deepEqual(boundSourcesOf(run), []);
  assert.deepEqual(sourcesChart(run, false).series.map(({ name }) => name), ["lower bound"]);
});

// The names are those of docs/schemas/run-log-line.schema.json.
test("all sources have words and signs", () => {
  assert.deepEqual(Object.keys(kPlanSources).sort(), Object.keys(kSigns).sort());
  for (const source of ["tree", "start", "prioritized", "lacam", "lns", "joint", "cores"])
    assert.ok(source in kPlanSources, source);
  for (const source of ["individual", "wdg", "branching", "joint", "cores", "lagrangian", "tree"])
    assert.ok(source in kBoundSources, source);
});

test("verdict reports the quality of the plan", () => {
  assert.match(verdict(read(header(), summary(33, 33))), /Optimal: a plan of 33/);
  assert.match(verdict(read(header(), summary(33, 30))), /at most 10 % above/);
  assert.match(verdict(read(header(), summary(33, 0))), /is unknown/);
  assert.match(verdict(read(header(), summary(null, 30, "unknown"))), /No plan yet when a limit was reached; none costs less than 30/);
  assert.match(verdict(read(header(), summary(null, 0, "infeasible"))), /Proven: there is no plan/);
  assert.match(verdict(read(header(), row({ lower_bound: 30 }))), /No plan yet; none costs less than 30/);
});

// A split is named by the constraint of its second child: src/conflicts/target.cpp,
// src/search/wdg_heuristic.cpp.
test("splits have the texts of their techniques", () => {
  assert.match(kSplits["target"], /rests early and no other robot passes/);
  assert.match(kSplits["cost"], /two robots together cost more/);
});
