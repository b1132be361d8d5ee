// SPDX-License-Identifier: MIT
// Tables of a run: sources of plans and bounds, splits, counters, ranks, and events.

import { el, plural } from "../page/dom";
import { kSigns, sharesOf } from "./charts";
import type { Rank, Run } from "./model";
import { kBoundSources, kPlanSources, kSplits, megabytes, number, seconds } from "./words";

const kMostEvents = 200;

function table(head: string[], rows: (string | Node)[][], note = ""): HTMLElement {
  return el("table", {}, ...(note ? [el("caption", {}, note)] : []),
    el("thead", {}, el("tr", {}, ...head.map((name) => el("th", { scope: "col" }, name)))),
    el("tbody", {}, ...rows.map((cells) => el("tr", {}, ...cells.map((cell) => el("td", {}, cell))))));
}

// Returns a number with a bar whose length is relative to the maximum `most`.
function bar(value: number, most: number): HTMLElement {
  const width = most > 0 ? (100 * value) / most : 0;
  return el("span", { class: "bar", style: `--part: ${width.toFixed(1)}%` }, number(value));
}

function countsOf(run: Run): Map<string, number> {
  if (run.summary) return run.summary.stats;
  return run.counts.length > 0 ? run.counts[run.counts.length - 1].counts : new Map<string, number>();
}

// --- sources of plans and bounds ---

export function sourcesTable(run: Run): HTMLElement {
  const plans = new Map<string, { count: number; gain: number }>();
  let before: number | null = null;
  for (const row of run.rows) {
    if (row.kind !== "incumbent" || row.incumbent === null) continue;
    const of = plans.get(row.source) ?? { count: 0, gain: 0 };
    plans.set(row.source, { count: of.count + 1, gain: of.gain + (before === null ? 0 : before - row.incumbent) });
    before = row.incumbent;
  }
  const rows = [...plans].map(([source, { count, gain }]) =>
    [`${kSigns[source] ?? "?"} ${kPlanSources[source] ?? source}`, number(count), number(gain)]);
  return table(["Better plans from", "count", "steps saved"], rows.length > 0 ? rows : [["none yet", "", ""]]);
}

export function boundsTable(run: Run): HTMLElement {
  const shares = sharesOf(run.rows);
  const rows = [...shares[shares.length - 1] ?? []].map(([source, gain]) => [kBoundSources[source] ?? source, number(gain)]);
  return table(["The bound rose by", "steps"], rows.length > 0 ? rows : [["not raised yet", ""]]);
}

// --- effort ---

export function splitsTable(run: Run): HTMLElement {
  const splits = [...countsOf(run)].filter(([name]) => name.startsWith("splits_"))
    .sort((a, b) => b[1] - a[1]);
  const most = splits.length > 0 ? splits[0][1] : 0;
  const rows = splits.map(([name, count]) => {
    const kind = name.slice("splits_".length).replace(/_/g, "-");
    return [el("span", {}, el("b", {}, kind), ` ${kSplits[kind] ?? ""}`), bar(count, most)];
  });
  return table(["Splits", "count"], rows.length > 0 ? rows : [["none", ""]]);
}

export function workTable(run: Run): HTMLElement {
  const counts = countsOf(run);
  const of = (name: string) => counts.get(name) ?? 0;
  const known = (asked: string, had: string) => of(asked) > 0
    ? `${number(of(asked))}, ${Math.round((100 * of(had)) / of(asked))} % from the cache` : "none";
  return table(["Effort", ""], [
    ["Branching: costs of a robot under one more constraint", known("branching_cost_queries", "branching_cost_hits")],
    ["MDDs (all optimal paths of a robot)", known("mdd_queries", "mdd_hits")],
    ["Path searches for one robot", number(of("low_level_calls"))],
    ["Nodes of joint searches for two robots", number(of("pair_expansions"))],
    ["Conflicts avoided at no cost (bypasses)", number(of("bypasses"))],
    ["Steps of the primal search", number(of("primal_steps"))],
    ["Nodes evicted for lack of memory", number(of("nodes_evicted"))],
  ]);
}

// --- ranks ---

type Column = keyof Rank;
const kColumns: [Column, string, (value: number) => string][] = [
  ["nodes", "nodes expanded", number], ["open", "open", number], ["bound", "lower bound", number],
  ["memory", "memory", megabytes], ["calls", "path searches", number],
];

export function ranksTable(run: Run): HTMLElement | null {
  const last = run.counts[run.counts.length - 1];
  if (!last || last.ranks.length === 0) return null;
  const { ranks } = last;
  const most = Math.max(1, ...ranks.map((rank) => rank.nodes ?? 0));
  const rows = ranks.map((rank, i): (string | Node)[] => [String(i), bar(rank.nodes ?? 0, most),
    ...kColumns.slice(1).map(([name, , text]) => rank[name] === null ? "–" : text(rank[name]!))]);
  const spread = kColumns.map(([name, , text]) => spreadText(ranks, name, text));
  const head = el("tr", { class: "spread" }, el("td", {}, "minimum · median · maximum"),
    ...spread.map((text) => el("td", {}, text)));
  const whole = table(["rank", ...kColumns.map(([, name]) => name)], rows, plural(ranks.length, "rank"));
  whole.querySelector("tbody")!.prepend(head);
  return el("div", { class: "scroll", tabindex: 0 }, whole);
}

function spreadText(ranks: Rank[], name: Column, text: (value: number) => string): string {
  const values = ranks.map((rank) => rank[name]).filter((value): value is number => value !== null)
    .sort((a, b) => a - b);
  if (values.length === 0) return "–";
  return [values[0], values[values.length >> 1], values[values.length - 1]].map(text).join(" · ");
}

// --- events ---

export function momentsList(run: Run): HTMLElement | null {
  if (run.moments.length === 0) return null;
  const shown = run.moments.slice(-kMostEvents);
  return el("ul", { class: "moments" }, ...shown.map(({ time, kind, text }) => el("li", { class: kind },
    time === null ? "" : `${seconds(time)} `, el("b", {}, kind), ` ${text}`)));
}

export function factsList(run: Run): HTMLElement {
  const h = run.header!;
  const fact = (name: string, text: string) => [el("dt", {}, name), el("dd", {}, text || "–")];
  return el("dl", {},
    ...fact("Instance", `${h.instance}: ${plural(h.agents, "robot")}, ${plural(h.tasks, "task")}`),
    ...fact("Options", h.options), ...fact("Method", h.method), ...fact("Threads", h.threads),
    ...fact("Machine", h.machine), ...fact("Version", h.version),
    ...(run.summary ? fact("Plan file", run.summary.planFile) : []));
}
