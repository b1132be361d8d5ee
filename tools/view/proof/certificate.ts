// SPDX-License-Identifier: MIT
// Parses certificates (docs/proof.md): the lemmas and the theorem, each with the tree of its proof. `grove
// view` has already checked each line against the instance.

import type { Model } from "../page/model";

export type Kind = "bar" | "move" | "norest" | "rest" | "pass" | "stop" | "nostop";

export interface Constraint {
  agent: number;
  kind: Kind;
  places: number[]; // `move` and `pass`: from, to; `stop` and `nostop`: none; others: one place
  begin: number; // equal to `end` for constraints with a single time
  end: number; // Infinity: forever
  stop: number; // position in the order of the agent's stops, from 0; -1: none
  task: number;
}

export interface Row {
  kind: "place" | "edge" | "finish";
  numbers: number[];
  multiplier: number; // in 1024ths of a step
}

// A node of a proof tree. It proves the statement under additional constraints: one side of each split above
// it, on the way from the root.
export interface Step {
  line: number;
  kind: "leaf" | "split" | "later" | "joint" | "prices" | "formula";
  lemmas: number[]; // indices of the lemmas that it uses
  sides: Constraint[]; // the two constraints of `split` and `later`; empty for other steps
  children: Step[]; // one per side
  rows: Row[];
  cores: number; // of `formula`
  above: { step: Step; side: number } | null;
  depth: number;
  leaves: number; // number of steps without children in the subtree of this step
}

export interface Statement {
  number: number; // index of the lemma; -1: the theorem
  bound: number; // lower bound on the sum of the agents' costs; Infinity: there is no plan
  agents: number[];
  constraints: Constraint[];
  root: Step;
  steps: Step[]; // all steps, in the order of the file
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

  // Goes to the next line and returns its first word.
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

  // Returns the next word, which is a number less than `below`, or "inf" if `below` is infinite.
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

  // Parses a lemma. Returns the first word of the line after it.
  private readLemma(): string {
    const { lines } = this;
    const bound = lines.integer();
    const agents: number[] = [];
    while (lines.hasMore) agents.push(this.agent());
    const constraints: Constraint[] = [];
    let first = lines.next();
    for (; first === "demand"; first = lines.next()) constraints.push(this.constraint());
    this.lemmas.push(this.statement(this.lemmas.length, bound, agents, constraints, first));
    return lines.next();
  }

  // Parses the proof of a statement. `first`: the first word of the root step. Without recursion, because a
  // proof can be as deep as it is long.
  private statement(
    number: number, bound: number, agents: number[], constraints: Constraint[], first: string,
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
    return { number, bound, agents, constraints, root, steps };
  }

  private step(kind: string, above: Step["above"]): Step {
    const { lines } = this;
    const step: Step = {
      line: lines.number, kind: "leaf", lemmas: [], sides: [], children: [], rows: [], cores: 0, above,
      depth: above ? above.step.depth + 1 : 0, leaves: 0,
    };
    switch (kind) {
      case "leaf":
        while (lines.hasMore) step.lemmas.push(this.lemma());
        break;
      case "split":
        step.sides = [this.constraint(), this.behindBar()];
        break;
      case "later":
        step.sides = [this.later(), this.later()];
        step.lemmas.push(this.lemma());
        break;
      case "prices":
        for (let word = lines.next(); word !== "end"; word = lines.next()) step.rows.push(this.row(word));
        break;
      case "formula":
        step.cores = this.formula();
        break;
      case "joint":
        break;
      default:
        return lines.fail("leaf, split, later, joint, prices or formula");
    }
    step.kind = kind;
    step.leaves = step.sides.length > 0 ? 0 : 1;
    return step;
  }

  // Skips the lines of a formula. Returns the number of its cores.
  private formula(): number {
    const { lines } = this;
    let cores = 0;
    for (let word = lines.next(); word !== "end"; word = lines.next()) {
      if (word === "core") cores++;
      while (lines.hasMore) lines.word();
    }
    return cores;
  }

  private behindBar(): Constraint {
    if (this.lines.word() !== "|") this.lines.fail("'|'");
    return this.constraint();
  }

  private constraint(): Constraint {
    const { lines } = this;
    const { world, tasks } = this.model;
    const place = () => lines.integer(world.places);
    const constraint: Constraint = {
      agent: this.agent(), kind: "bar", places: [], begin: 0, end: Infinity, stop: -1, task: -1,
    };
    const kind = lines.word();
    switch (kind) {
      case "bar": case "move": case "pass":
        constraint.places.push(place());
        if (kind !== "bar") constraint.places.push(place());
        constraint.begin = lines.integer();
        constraint.end = lines.integer();
        break;
      case "rest": case "norest":
        constraint.places.push(place());
        constraint.begin = constraint.end = lines.integer();
        break;
      case "stop": case "nostop":
        constraint.stop = lines.integer();
        constraint.task = lines.integer(tasks.length);
        break;
      default:
        return lines.fail("a kind of constraint");
    }
    constraint.kind = kind;
    return constraint;
  }

  // Parses "A T": agent A has a destination and does not come to rest there by time T.
  private later(): Constraint {
    const agent = this.agent();
    const time = this.lines.integer();
    const { goal } = this.model.agents[agent];
    if (goal < 0) this.lines.fail("agents with goals");
    return { agent, kind: "norest", places: [goal], begin: time, end: time, stop: -1, task: -1 };
  }

  private row(kind: string): Row {
    const { lines } = this;
    if (kind !== "place" && kind !== "edge" && kind !== "finish") return lines.fail("a row of multipliers");
    const numbers: number[] = [];
    while (lines.hasMore) numbers.push(lines.integer());
    const most = kind === "finish" ? this.model.agents.length : this.model.world.places;
    const named = kind === "place" ? [0] : kind === "edge" ? [0, 1] : [0, 2];
    if (named.some((i) => !(numbers[i] < most))) lines.fail("existing places and agents");
    return { kind, multiplier: numbers.pop()!, numbers };
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

// Returns the constraint that leads to a step from the step above it; null for the root.
export function constraintOf({ above }: Step): Constraint | null {
  return above && above.step.sides[above.side];
}

// Returns the constraints in force at a step in addition to those of the statement, in order from the root.
export function constraintsAt(step: Step): Constraint[] {
  const constraints: Constraint[] = [];
  for (let at: Step | null = step; at; at = at.above && at.above.step) {
    const constraint = constraintOf(at);
    if (constraint) constraints.push(constraint);
  }
  return constraints.reverse();
}

// Returns all statements whose proofs use this lemma.
export function usersOf({ lemmas, theorem }: Certificate, lemma: number): Statement[] {
  return [...lemmas, theorem].filter(({ steps }) => steps.some((step) => step.lemmas.includes(lemma)));
}
