// SPDX-License-Identifier: MIT
// The page of a run. Displays the log, which is embedded in the page or, while the run writes it, comes from the server.

import { el, setText } from "../page/dom";
import { Chart } from "./chart";
import { boundChart, boundSourcesOf, endOf, kBoundSign, kMemoryNames, kSigns, memoryChart, nodesChart, sourcesChart } from "./charts";
import { Follower } from "./follow";
import { Log } from "./log";
import { kMemory } from "./model";
import type { Run } from "./model";
import { boundsTable, factsList, momentsList, ranksTable, sourcesTable, splitsTable, workTable } from "./tables";
import { TreeView } from "./tree_view";
import { kBoundSources, kOutcomes, kPlanSources, seconds, verdict } from "./words";

const kShort = 2; // seconds: longer runs have a logarithmic time axis by default

class Page {
  private log = new Log();
  private readonly state = el("p", { class: "state", role: "status" });
  private readonly title = el("h1", {}, "A run of Grove");
  private readonly verdict = el("p", { class: "verdict" });
  private readonly failure = el("p", { class: "failure", role: "alert", hidden: true });
  private readonly charts = { bound: new Chart(), boundSources: new Chart(), nodes: new Chart(), memory: new Chart() };
  private readonly tree = new TreeView();
  private readonly places = {
    sources: el("div"), boundSources: el("div"), bounds: el("div"), splits: el("div"), work: el("div"), ranks: el("div"),
    moments: el("div"), facts: el("div"), noTree: el("p", { class: "faint" }),
  };
  private readonly time = el("button", { type: "button", click: () => this.toggleTime() }, "logarithmic time");
  private readonly sections: Record<string, HTMLElement> = {};
  private isLogarithmic: boolean | null = null; // null: depends on the length of the run
  private lastSign = performance.now();

  constructor(private readonly isLive: boolean) {
    const section = (name: string, title: string, ...content: (Node | string)[]) =>
      this.sections[name] = el("section", {}, el("h2", {}, title), ...content);
    document.body.append(
      el("header", {}, this.title, this.verdict, this.state, this.failure),
      el("main", {},
        section("bound", "Quality of the plan", legend("bound"), this.charts.bound.element, this.time,
          el("div", { class: "pair" }, this.places.sources, this.places.bounds)),
        section("boundSources", "Sources of the bound", this.places.boundSources, this.charts.boundSources.element),
        section("tree", "The search tree", treeLegend(), this.tree.element),
        section("noTree", "The search tree", this.places.noTree),
        section("work", "Effort of the search", el("div", { class: "pair" }, this.places.splits, this.places.work)),
        section("nodes", "Nodes", legend("nodes"), this.charts.nodes.element),
        section("memory", "Memory", legend("memory"), this.charts.memory.element),
        section("ranks", "Ranks", this.places.ranks),
        section("moments", "Events", this.places.moments),
        section("facts", "The run", this.places.facts)));
    window.addEventListener("resize", () => this.paint());
    setInterval(() => this.showState(), 1000);
  }

  begin(): void {
    this.log = new Log();
    this.failure.hidden = true;
  }

  add(text: string): void {
    this.lastSign = performance.now();
    try {
      this.log.add(text);
    } catch (error) {
      this.failure.hidden = false;
      setText(this.failure, `The log cannot be read: ${error instanceof Error ? error.message : String(error)}`);
    }
    this.show();
  }

  showState(isAnswering = true): void {
    if (this.log.run.summary) return setText(this.state, "The run has ended.");
    if (!this.isLive)
      return setText(this.state, "The log is incomplete: the run had not ended, or it was killed.");
    const ago = (performance.now() - this.lastSign) / 1000;
    setText(this.state, !isAnswering ? "The server no longer responds."
      : !this.log.run.header ? "Waiting for the log to begin."
      : ago < 2 ? "Live." : `Live; last update ${seconds(Math.round(ago))} ago.`);
  }

  private show(): void {
    const { run } = this.log;
    this.showState();
    for (const section of Object.values(this.sections)) section.hidden = run.header === null;
    if (!run.header) return;
    const name = run.header.instance.split("/").pop()!;
    setText(this.title, name);
    document.title = `${name}: a run of Grove`;
    setText(this.verdict, verdict(run));
    this.fill();
    this.paint();
  }

  private fill(): void {
    const { run } = this.log;
    const put = (place: HTMLElement, content: HTMLElement | null) =>
      place.replaceChildren(...(content ? [content] : []));
    put(this.places.boundSources, boundSourcesLegend(run));
    put(this.places.sources, sourcesTable(run));
    put(this.places.bounds, boundsTable(run));
    put(this.places.splits, splitsTable(run));
    put(this.places.work, workTable(run));
    put(this.places.facts, factsList(run));
    put(this.places.moments, momentsList(run));
    put(this.places.ranks, ranksTable(run));
    this.sections.boundSources.hidden = !this.places.boundSources.firstChild;
    this.sections.moments.hidden = run.moments.length === 0;
    this.sections.ranks.hidden = !this.places.ranks.firstChild;
    this.sections.tree.hidden = run.roots.length === 0;
    this.sections.noTree.hidden = run.roots.length > 0;
    setText(this.places.noTree, this.places.ranks.firstChild
      ? "The ranks hold the nodes; the log does not list them."
      : "The log does not list nodes. With --log-tree 1000 it lists the first 1000, and this page draws them.");
    this.sections.memory.hidden = run.counts.length === 0;
    if (run.roots.length > 0) this.tree.show(run);
  }

  private paint(): void {
    const { run } = this.log;
    if (run.rows.length === 0) return;
    this.charts.bound.show(boundChart(run, this.isLogarithmicNow()));
    if (!this.sections.boundSources.hidden) this.charts.boundSources.show(sourcesChart(run, false));
    this.charts.nodes.show(nodesChart(run, false));
    this.charts.memory.show(memoryChart(run, false));
    this.time.setAttribute("aria-pressed", String(this.isLogarithmicNow()));
    if (run.roots.length > 0) this.tree.resize();
  }

  private toggleTime(): void {
    this.isLogarithmic = !this.isLogarithmicNow();
    this.paint();
  }

  // Whether the time axis is logarithmic: by default in a long run, because most events are in its first
  // second.
  private isLogarithmicNow(): boolean {
    return this.isLogarithmic ?? endOf(this.log.run) > kShort;
  }
}

function entry(kind: string, text: string): HTMLElement {
  return el("span", { class: "entry" }, el("i", { class: kind }), text);
}

function legend(chart: "bound" | "nodes" | "memory"): HTMLElement {
  const entries = {
    bound: [entry("bound", "lower bound: no plan costs less"), entry("incumbent", "best plan so far"),
      el("span", { class: "entry" }, `${kBoundSign} the bound rose; plans come from:`),
      ...Object.entries(kSigns).map(([source, sign]) =>
        el("span", { class: "entry" }, `${sign} ${kPlanSources[source]}`))],
    nodes: [entry("bound", "expanded"), entry("incumbent", "open")],
    memory: [entry("incumbent", "whole process"),
      ...kMemory.map((kind) => entry(`memory-${kind}`, kMemoryNames[kind]))],
  };
  return el("p", { class: "legend" }, ...entries[chart]);
}

function boundSourcesLegend(run: Run): HTMLElement | null {
  const sources = boundSourcesOf(run);
  if (sources.length === 0) return null;
  return el("p", { class: "legend" }, el("span", { class: "entry" }, "From bottom to top:"),
    ...sources.map((source) => entry(`raised-${source}`, kBoundSources[source])));
}

function treeLegend(): HTMLElement {
  return el("div", {},
    el("p", { class: "faint" }, "Each node stands for all plans that satisfy its constraint and those of the nodes above it. The number is its " +
      "bound: none of these plans costs less. Drag to move, + and - to zoom, arrow keys to go through the tree, n and p to step."),
    el("p", { class: "legend" }, ...Object.entries(kOutcomes).map(([kind, text]) => entry(`node-${kind}`, text)),
      entry("node-open", "not expanded")));
}

function begin(): void {
  const text = document.getElementById("grove-log")!.textContent!;
  const isLive = document.body.hasAttribute("data-follow");
  const page = new Page(isLive);
  if (!isLive) return page.add(text);
  page.showState();
  void new Follower({
    begin: () => page.begin(),
    add: (more) => page.add(more),
    state: (isAnswering) => page.showState(isAnswering),
  }).run();
}

begin();
