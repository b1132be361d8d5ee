// SPDX-License-Identifier: MIT
// Reads the log of a run. The log may still grow. The parser is strict, except that it ignores unknown events.
// Errors name the line.

import { parse, Value } from "../page/json";
import type { Counts, Header, Outcome, Rank, Row, Run, Summary, TreeNode } from "./model";
import { kMemory } from "./model";
import * as renamed from "./renamed";
import { current } from "./renamed";

const kMost = Number.MAX_SAFE_INTEGER;
const kOutcomes = ["split", "bound_raised", "plan", "pruned"];

export class Log {
  readonly run: Run = {
    header: null, rows: [], counts: [], roots: [], expanded: [], moments: [], summary: null,
  };
  private readonly nodes = new Map<number, TreeNode>(); // by number: nodes that are not expanded yet
  private rest = ""; // the incomplete last line
  private lines = 0;

  // Reads new text. Throws an error that names the first invalid line.
  add(text: string): void {
    const lines = (this.rest + text).split("\n");
    this.rest = lines.pop()!;
    for (const line of lines) {
      ++this.lines;
      if (line.trim() === "") continue;
      try {
        this.event(parse(line));
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        throw new Error(`line ${this.lines}: ${why}`);
      }
    }
  }

  private event(data: Value): void {
    const kind = data.key("event").text();
    if (!this.run.header && kind !== "header") data.key("event").fail("'header' first");
    switch (kind) {
      case "header":
        this.run.header = readHeader(data);
        break;
      case "incumbent":
      case "bound":
      case "tree":
      case "progress":
        this.run.rows.push(readRow(kind, data));
        break;
      case "counts":
        this.run.counts.push(readCounts(data));
        break;
      case "root":
        this.addRoot(data);
        break;
      case "node":
        this.expand(data);
        break;
      case "summary":
        this.run.summary = readSummary(data);
        break;
      case "note":
      case "warning":
      case "infeasible":
        this.addMoment(kind, data, data.key("text").text());
        break;
      case "resumed":
        this.addMoment(kind, data, `continues after ${data.key("seconds_before").number()} s of earlier runs`);
        break;
      case "checkpoint":
        this.addMoment(kind, data, checkpointText(data));
        break;
    }
  }

  private addMoment(kind: string, data: Value, text: string): void {
    const time = data.key("time_s");
    this.run.moments.push({ time: time.isThere ? time.number() : null, kind, text });
  }

  private addRoot(data: Value): void {
    const root = readNode(data, null, data.key("tree").integer(0, kMost));
    this.nodes.set(root.number, root);
    this.run.roots.push(root);
  }

  private expand(data: Value): void {
    const node = this.nodes.get(data.key("node").integer(0, kMost)) ??
      data.key("node").fail("a node that was made before and is not expanded");
    this.nodes.delete(node.number);
    const outcome = current(renamed.kOutcomes, data.key("outcome").text());
    if (!kOutcomes.includes(outcome)) data.key("outcome").fail(kOutcomes.join(", "));
    node.expanded = {
      order: this.run.expanded.length + 1,
      time: data.key("time_s").number(),
      worker: data.key("worker").integer(0, kMost),
      outcome: outcome as Outcome,
      conflict: textOr(data.key("conflict"), ""),
      split: current(renamed.kSplits, textOr(data.key("split"), "")),
      planCost: outcome === "plan" ? data.key("cost").number() : 0,
    };
    this.run.expanded.push(node);
    for (const value of data.key("children").list()) {
      const child = readNode(value, node, node.tree);
      if (this.nodes.has(child.number)) value.key("node").fail("a number of its own");
      this.nodes.set(child.number, child);
      node.children.push(child);
    }
  }
}

function readHeader(data: Value): Header {
  return {
    version: data.key("version").text(),
    machine: data.key("machine").text(),
    options: data.key("options").text(),
    method: data.key("method").text(),
    threads: data.key("threads").text(),
    instance: data.key("instance").text(),
    agents: data.key("agents").integer(0, kMost),
    tasks: data.key("tasks").integer(0, kMost),
  };
}

function readRow(kind: Row["kind"], data: Value): Row {
  const raisedBy = data.key("raised_by");
  return {
    kind,
    time: data.key("time_s").number(),
    nodes: data.key("nodes").number(),
    open: data.key("open").number(),
    bound: data.key("lower_bound").number(),
    incumbent: numberOrNull(data.key("incumbent")),
    memory: data.key("memory_mb").number(),
    source: current(renamed.kPlanSources, textOr(data.key("source"), "")),
    raisedBy: raisedBy.isThere ? readNumbers(raisedBy, renamed.kBoundSources) : new Map<string, number>(),
  };
}

function readCounts(data: Value): Counts {
  const memory = data.key("memory_mb");
  const ranks = data.key("ranks");
  const time = data.key("time_s").number();
  const counts = readNumbers(data.key("counts"), renamed.kCounters);
  const kinds = readNumbers(memory, renamed.kMemory);
  return {
    time,
    counts,
    process: memory.key("process").number(),
    memory: kMemory.map((kind) => kinds.get(kind) ?? memory.key(kind).number()),
    ranks: ranks.isThere ? readRanks(ranks) : [],
  };
}

function readRanks(data: Value): Rank[] {
  const count = data.key("nodes").list().length;
  const column = (name: string) => data.key(name).list(count).map(numberOrNull);
  const [nodes, open, bound] = [column("nodes"), column("open"), column("lower_bound")];
  const [memory, calls] = [column("memory_mb"), column("low_level_calls")];
  return nodes.map((_, i) => ({
    nodes: nodes[i], open: open[i], bound: bound[i], memory: memory[i], calls: calls[i],
  }));
}

function readNode(data: Value, parent: TreeNode | null, tree: number): TreeNode {
  return {
    number: data.key("node").integer(0, kMost),
    tree,
    parent,
    depth: parent ? parent.depth + 1 : 0,
    bound: data.key("bound").number(),
    cost: data.key("cost").number(),
    conflicts: numberOrNull(data.key("conflicts")),
    constraint: textOr(data.key("constraint"), textOr(data.key("demand"), "")),
    children: [],
    expanded: null,
  };
}

function readSummary(data: Value): Summary {
  const stats = data.key("stats");
  const seconds = stats.key("wall_s");
  return {
    status: data.key("status").text(),
    cost: numberOrNull(data.key("cost")),
    bound: data.key("lower_bound").number(),
    planFile: data.key("plan_file").isNull ? "was not written" : data.key("plan_file").text(),
    seconds: seconds.isThere ? seconds.number() : null,
    stats: readNumbers(stats, renamed.kCounters),
  };
}

// Returns the members that are numbers, by their current names.
function readNumbers(data: Value, names: Record<string, string>): Map<string, number> {
  const all = new Map<string, number>();
  for (const name of data.names())
    if (data.key(name).isNumber) all.set(current(names, name), data.key(name).number());
  return all;
}

function checkpointText(data: Value): string {
  const failure = data.key("failure");
  if (failure.isThere) return `no checkpoint: ${failure.text()}`;
  return `checkpoint of ${data.key("nodes").number()} nodes in ${data.key("took_s").number()} s`;
}

function numberOrNull(value: Value): number | null {
  return value.isThere && !value.isNull ? value.number() : null;
}

function textOr(value: Value, other: string): string {
  return value.isThere ? value.text() : other;
}
