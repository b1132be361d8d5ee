// SPDX-License-Identifier: MIT
// A certificate (docs/proof.md) as what it says: lemmas and the theorem, each with its tree. That it
// is one of this instance, line by line, `grove view` has seen to.

import type { Model } from "../page/model";

export type Kind = "bar" | "move" | "norest" | "rest" | "pass" | "stop" | "nostop";

export interface Demand {
  agent: number;
  kind: Kind;
  places: number[]; // of moves and passages: from, to; of stops: none
  begin: number; // of those that end by a time, that time
  end: number; // Infinity: for ever
  stop: number; // from 0
  task: number;
}

export interface Row {
  kind: "place" | "edge" | "finish";
  numbers: number[];
  price: number; // in 1024ths of a step
}

// A step of a proof. What it stands under is said by the sides of the steps above it.
export interface Step {
  line: number;
  kind: "leaf" | "split" | "later" | "joint" | "prices";
  lemmas: number[]; // that it names
  sides: Demand[]; // two, or none
  children: Step[]; // likewise
  rows: Row[];
  above: { step: Step; side: number } | null;
  depth: number;
  leaves: number; // at or below it; what is no split is one
}

export interface Statement {
  number: number; // of the lemma; -1: the theorem
  bound: number; // Infinity: there is no way
  agents: number[];
  demands: Demand[];
  root: Step;
  steps: Step[]; // all, in the order of the file
}

export interface Certificate {
  following: boolean;
  lemmas: Statement[];
  theorem: Statement;
}

class Lines {
  private at = 0;
  private words: string[] = [];

  constructor(private readonly lines: string[]) {}

  get number(): number {
    return this.at;
  }

  // The first word of the next line.
  next(): string {
    if (this.at === this.lines.length) this.fail("another line");
    this.words = this.lines[this.at++].split(" ");
    return this.word();
  }

  get hasMore(): boolean {
    return this.words.length > 0;
  }

  word(): string {
    return this.words.shift() ?? this.fail("another word");
  }

  // inf is one.
  integer(below = Infinity): number {
    const word = this.word();
    const value = word === "inf" ? Infinity : /^[0-9]+$/.test(word) ? Number(word) : NaN;
    if (!(value < below || value === below && below === Infinity)) this.fail("a valid number");
    return value;
  }

  fail(expected: string): never {
    throw new Error(`line ${this.at}: expected ${expected}`);
  }
}

export function readCertificate(text: string, model: Model): Certificate {
  return new Reader(text, model).read();
}

class Reader {
  private readonly lines: Lines;
  private readonly lemmas: Statement[] = [];

  constructor(text: string, private readonly model: Model) {
    this.lines = new Lines(text.replace(/\n$/, "").split("\n"));
  }

  read(): Certificate {
    const { lines } = this;
    for (const word of ["grove-proof", "instance"])
      if (lines.next() !== word) lines.fail(`'${word}'`);
    if (lines.next() !== "following") lines.fail("'following'");
    const following = lines.word() === "yes";
    let first = lines.next();
    while (first === "lemma") first = this.readLemma();
    if (first !== "theorem") lines.fail("a lemma, or the theorem");
    const bound = lines.integer();
    const all = this.model.agents.map((_, agent) => agent);
    const theorem = this.statement(-1, bound, all, [], lines.next());
    if (lines.next() !== "end") lines.fail("the end");
    return { following, lemmas: this.lemmas, theorem };
  }

  // The first word behind it.
  private readLemma(): string {
    const { lines } = this;
    const bound = lines.integer();
    const agents: number[] = [];
    while (lines.hasMore) agents.push(this.agent());
    const demands: Demand[] = [];
    let first = lines.next();
    for (; first === "demand"; first = lines.next()) demands.push(this.demand());
    this.lemmas.push(this.statement(this.lemmas.length, bound, agents, demands, first));
    return lines.next();
  }

  // A proof may be as deep as it is long: without recursion.
  private statement(
    number: number, bound: number, agents: number[], demands: Demand[], first: string,
  ): Statement {
    const root = this.step(first, null);
    const steps = [root];
    const open = [root].filter(isOpen);
    while (open.length > 0) {
      const parent = open[open.length - 1];
      const step = this.step(this.lines.next(), { step: parent, side: parent.children.length });
      parent.children.push(step);
      steps.push(step);
      if (!isOpen(parent)) open.pop();
      if (isOpen(step)) open.push(step);
    }
    for (const { above, leaves } of [...steps].reverse()) if (above) above.step.leaves += leaves;
    return { number, bound, agents, demands, root, steps };
  }

  private step(kind: string, above: Step["above"]): Step {
    const { lines } = this;
    const step: Step = {
      line: lines.number, kind: "leaf", lemmas: [], sides: [], children: [], rows: [], above,
      depth: above ? above.step.depth + 1 : 0, leaves: 0,
    };
    switch (kind) {
      case "leaf":
        while (lines.hasMore) step.lemmas.push(this.lemma());
        break;
      case "split":
        step.sides = [this.demand(), this.behindBar()];
        break;
      case "later":
        step.sides = [this.later(), this.later()];
        step.lemmas.push(this.lemma());
        break;
      case "prices":
        for (let word = lines.next(); word !== "end"; word = lines.next()) step.rows.push(this.row(word));
        break;
      case "joint":
        break;
      default:
        return lines.fail("leaf, split, later, joint or prices");
    }
    step.kind = kind;
    step.leaves = step.sides.length > 0 ? 0 : 1;
    return step;
  }

  private behindBar(): Demand {
    if (this.lines.word() !== "|") this.lines.fail("'|'");
    return this.demand();
  }

  private demand(): Demand {
    const { lines } = this;
    const { world, tasks } = this.model;
    const place = () => lines.integer(world.places);
    const demand: Demand = {
      agent: this.agent(), kind: "bar", places: [], begin: 0, end: Infinity, stop: -1, task: -1,
    };
    const kind = lines.word();
    switch (kind) {
      case "bar": case "move": case "pass":
        demand.places.push(place());
        if (kind !== "bar") demand.places.push(place());
        demand.begin = lines.integer();
        demand.end = lines.integer();
        break;
      case "rest": case "norest":
        demand.places.push(place());
        demand.begin = demand.end = lines.integer();
        break;
      case "stop": case "nostop":
        demand.stop = lines.integer();
        demand.task = lines.integer(tasks.length);
        break;
      default:
        return lines.fail("a kind of constraint");
    }
    demand.kind = kind;
    return demand;
  }

  // "A T" of an agent with a goal: it does not come to rest there by then.
  private later(): Demand {
    const agent = this.agent();
    const time = this.lines.integer();
    const { goal } = this.model.agents[agent];
    if (goal < 0) this.lines.fail("agents with goals");
    return { agent, kind: "norest", places: [goal], begin: time, end: time, stop: -1, task: -1 };
  }

  private row(kind: string): Row {
    const { lines } = this;
    if (kind !== "place" && kind !== "edge" && kind !== "finish") return lines.fail("a row of prices");
    const numbers: number[] = [];
    while (lines.hasMore) numbers.push(lines.integer());
    const most = kind === "finish" ? this.model.agents.length : this.model.world.places;
    const named = kind === "place" ? [0] : kind === "edge" ? [0, 1] : [0, 2];
    if (named.some((i) => !(numbers[i] < most))) lines.fail("existing places and agents");
    return { kind, price: numbers.pop()!, numbers };
  }

  private agent(): number {
    return this.lines.integer(this.model.agents.length);
  }

  private lemma(): number {
    return this.lines.integer(this.lemmas.length);
  }
}

function isOpen({ sides, children }: Step): boolean {
  return children.length < sides.length;
}

// The demand that leads to a step from the one above it; null: there is none.
export function demandOf({ above }: Step): Demand | null {
  return above && above.step.sides[above.side];
}

// What is demanded there beside what the statement demands, from the root down.
export function demandsAt(step: Step): Demand[] {
  const demands: Demand[] = [];
  for (let at: Step | null = step; at; at = at.above && at.above.step) {
    const demand = demandOf(at);
    if (demand) demands.push(demand);
  }
  return demands.reverse();
}

// All statements whose proofs name this lemma.
export function usersOf({ lemmas, theorem }: Certificate, lemma: number): Statement[] {
  return [...lemmas, theorem].filter(({ steps }) => steps.some((step) => step.lemmas.includes(lemma)));
}
