// SPDX-License-Identifier: MIT
// Contents of the charts of a run: bound and incumbent, sources of the bound, nodes, and memory.

import type { Contents, Mark, Point, Series } from "./chart";
import type { Row, Run, Shares } from "./model";
import { kMemory } from "./model";
import type { Scale } from "./scale";
import { linear, logarithmic } from "./scale";
import { kBoundSources, kPlanSources, megabytes, number, percent, seconds } from "./words";

// Marks for an increase of the lower bound, and for plans by their source.
export const kBoundSign = "⊥";
export const kSigns: Record<string, string> = {
  tree: "●", start: "■", prioritized: "▲", lacam: "◆", lns: "+", joint: "▼", cores: "★",
};
export const kMemoryNames: Record<string, string> = {
  nodes: "tree nodes", subproblems: "costs of single robots", mdds: "MDDs (all paths of one cost)",
  dependencies: "costs of groups of robots",
};

export function endOf(run: Run): number {
  const rows = run.rows.length > 0 ? run.rows[run.rows.length - 1].time : 0;
  const counts = run.counts.length > 0 ? run.counts[run.counts.length - 1].time : 0;
  return Math.max(rows, counts, run.summary?.seconds ?? 0, 1e-3);
}

export function boundChart(run: Run, isLogarithmic: boolean): Contents {
  const { rows } = run;
  const plans = rows.filter((row) => row.incumbent !== null);
  const values = [...rows.map((row) => row.bound), ...plans.map((row) => row.incumbent!)];
  const [least, most] = extremes(values);
  const room = Math.max(1, (most - least) * 0.05);
  const of = (all: Row[], value: (row: Row) => number): Point[] =>
    all.map((row) => ({ time: row.time, value: value(row) }));
  const known = of(plans, (row) => row.incumbent!);
  return {
    ...frame(run, isLogarithmic, "Lower bound and best plan over time"),
    y: linear(least - room, most + room),
    series: [
      { name: "gap", kind: "gap", points: known, until: of(plans, (row) => row.bound) },
      { name: "lower bound", kind: "bound", points: of(rows, (row) => row.bound) },
      { name: "best plan", kind: "incumbent", points: known },
    ],
    marks: [...planMarks(rows), ...boundMarks(rows)],
    label: number,
    read: (time) => standing(rowAt(rows, time)),
  };
}

// Returns for each row how much each source has raised the lower bound so far.
export function sharesOf(rows: Row[]): Shares[] {
  let shares: Shares = new Map();
  return rows.map(({ raisedBy }) => {
    if (raisedBy.size > 0) shares = new Map(shares);
    for (const [source, gain] of raisedBy) shares.set(source, (shares.get(source) ?? 0) + gain);
    return shares;
  });
}

// Returns the sources of the lower bound in a run, in the order in which the chart stacks them.
export function boundSourcesOf(run: Run): string[] {
  const found = new Set(run.rows.flatMap((row) => [...row.raisedBy.keys()]));
  return Object.keys(kBoundSources).filter((source) => found.has(source));
}

export function sourcesChart(run: Run, isLogarithmic: boolean): Contents {
  const { rows } = run;
  const shares = sharesOf(rows);
  const [least, most] = extremes(rows.map((row) => row.bound));
  const room = Math.max(1, (most - least) * 0.05);
  return {
    ...frame(run, isLogarithmic, "Lower bound over time, divided into what raised it"),
    y: linear(least - room, most + room),
    series: [
      ...sourceAreas(rows, shares, least - room),
      { name: "lower bound", kind: "bound", points: rows.map(({ time, bound }) => ({ time, value: bound })) },
    ],
    marks: [],
    label: number,
    read: (time) => {
      const index = indexAt(rows, time);
      return index < 0 ? "nothing known yet" : sharesText(rows[index], shares[index]);
    },
  };
}

// Returns the lower bound divided into the shares of its sources. The last source ends at the bound. Values below
// `least` are outside of the chart.
function sourceAreas(rows: Row[], shares: Shares[], least: number): Series[] {
  const bounds = rows.map((row) => row.bound);
  const pointsOf = (values: number[]): Point[] =>
    values.map((value, i) => ({ time: rows[i].time, value: Math.max(least, value) }));
  const areas: Series[] = [];
  let above = bounds;
  for (const source of Object.keys(kBoundSources).reverse()) {
    if (!shares[shares.length - 1]?.has(source)) continue;
    const below = above.map((value, i) => value - (shares[i].get(source) ?? 0));
    areas.push({ name: kBoundSources[source], kind: `raised-${source}`, points: pointsOf(above), until: pointsOf(below) });
    above = below;
  }
  return areas;
}

export function nodesChart(run: Run, isLogarithmic: boolean): Contents {
  const { rows } = run;
  const most = extremes(rows.map((row) => Math.max(row.nodes, row.open)))[1];
  return {
    ...frame(run, isLogarithmic, "Nodes expanded and open over time"),
    y: linear(0, Math.max(1, most)),
    series: [
      { name: "expanded", kind: "bound", points: rows.map(({ time, nodes }) => ({ time, value: nodes })) },
      { name: "open", kind: "incumbent", points: rows.map(({ time, open }) => ({ time, value: open })) },
    ],
    marks: [],
    label: number,
    read: (time) => {
      const row = rowAt(rows, time);
      return row ? `${number(row.nodes)} nodes expanded, ${number(row.open)} open` : "";
    },
  };
}

// Returns the memory chart: the memory of the search, stacked by kind, and that of the whole process.
export function memoryChart(run: Run, isLogarithmic: boolean): Contents {
  const { rows } = run;
  const counts = run.counts.filter((c) => c.process > 0); // 0 until the ranks have reported
  const whole: Point[] = counts.length > 0
    ? counts.map(({ time, process }) => ({ time, value: process }))
    : rows.map(({ time, memory }) => ({ time, value: memory }));
  const upTo = (kinds: number) => counts.map(({ time, memory }) =>
    ({ time, value: memory.slice(0, kinds).reduce((sum, part) => sum + part, 0) }));
  return {
    ...frame(run, isLogarithmic, "Memory by kind over time"),
    y: linear(0, Math.max(1, extremes(whole.map((point) => point.value))[1])),
    series: [
      ...kMemory.map((kind, i) =>
        ({ name: kMemoryNames[kind], kind: `memory-${kind}`, points: upTo(i + 1), until: upTo(i) })),
      { name: "whole process", kind: "incumbent", points: whole },
    ],
    marks: [],
    label: megabytes,
    read: (time) => memoryAt(run, time),
  };
}

function frame(run: Run, isLogarithmic: boolean, title: string) {
  const end = endOf(run);
  const begin = Math.max(1e-3, run.rows.length > 0 ? run.rows[0].time : 1e-3);
  const x: Scale = isLogarithmic ? logarithmic(begin, end) : linear(0, end);
  return { title, end, x, stops: run.rows.map((row) => row.time) };
}

function planMarks(rows: Row[]): Mark[] {
  return rows.filter((row) => row.kind === "incumbent").map((row) => ({
    time: row.time,
    value: row.incumbent!,
    shape: kSigns[row.source] ?? "?",
    kind: "incumbent",
    title: `${seconds(row.time)}: a plan of ${number(row.incumbent!)}, from ${kPlanSources[row.source] ?? row.source}`,
  }));
}

function boundMarks(rows: Row[]): Mark[] {
  return rows.filter((row) => row.raisedBy.size > 0).map((row) => ({
    time: row.time,
    value: row.bound,
    shape: kBoundSign,
    kind: "bound",
    title: `${seconds(row.time)}: at least ${number(row.bound)}, by ` +
      [...row.raisedBy.keys()].map((source) => kBoundSources[source] ?? source).join(" and "),
  }));
}

function extremes(values: number[]): [number, number] {
  let [least, most] = [Infinity, -Infinity];
  for (const value of values) {
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  return values.length > 0 ? [least, most] : [0, 1];
}

// Returns the index of the last row that is not after `time`; -1: none.
function indexAt(rows: { time: number }[], time: number): number {
  let [least, most] = [0, rows.length];
  while (least < most) {
    const middle = (least + most) >> 1;
    if (rows[middle].time <= time + 1e-9) least = middle + 1;
    else most = middle;
  }
  return least - 1;
}

function rowAt<T extends { time: number }>(rows: T[], time: number): T | null {
  return rows[indexAt(rows, time)] ?? null;
}

function standing(row: Row | null): string {
  if (!row) return "nothing known yet";
  const bound = `no plan costs less than ${number(row.bound)}`;
  if (row.incumbent === null) return `${bound}; no plan yet`;
  return `best plan ${number(row.incumbent)}, ${bound}, gap ${percent(row.incumbent, row.bound)}`;
}

function sharesText(row: Row, shares: Shares): string {
  const parts = [...shares].map(([source, gain]) => `${kBoundSources[source] ?? source} ${number(gain)}`);
  return `lower bound ${number(row.bound)}; of it ${parts.join(", ")}`;
}

function memoryAt(run: Run, time: number): string {
  const at = rowAt(run.counts, time);
  if (!at) return "nothing known yet";
  const parts = kMemory.map((kind, i) => `${kMemoryNames[kind]} ${megabytes(at.memory[i])}`);
  return `${megabytes(at.process)}; of it ${parts.join(", ")}`;
}
