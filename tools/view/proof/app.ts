// SPDX-License-Identifier: MIT
// State of the page: the selected statement of the certificate (a lemma or the theorem), the selected step of
// its proof, and the unfolded steps.

import type { Model } from "../page/model";
import type { PageState } from "../page/stage";
import { constraintOf, type Certificate, type Statement, type Step } from "./certificate";

const kFirstRows = 60; // approximate number of visible steps at first

export class ProofApp implements PageState {
  readonly player = { time: 0 }; // the map always shows time 0, with all agents at their starts
  readonly labels = true;
  following = false;
  chosenTask = -1;
  statement: Statement;
  step: Step;
  readonly open = new Set<Step>(); // unfolded steps
  marked = -1; // the agent selected on the map; -1: none
  private readonly listeners: (() => void)[] = [];

  constructor(readonly model: Model, readonly certificate: Certificate) {
    this.statement = certificate.theorem;
    this.step = this.statement.root;
    for (const statement of [...certificate.lemmas, certificate.theorem]) this.openFirst(statement);
  }

  // Unfolds the first steps of a proof, level by level, until about kFirstRows are visible.
  private openFirst({ root }: Statement): void {
    const level = [root];
    for (let i = 0; i < level.length && level.length < kFirstRows; ++i) {
      if (level[i].children.length > 0) this.open.add(level[i]);
      level.push(...level[i].children);
    }
  }

  get chosen(): number {
    return this.marked >= 0 ? this.marked : this.agents[0] ?? -1;
  }

  // Returns the agents that the selected step refers to.
  get agents(): number[] {
    const { step, statement, certificate } = this;
    const constraint = constraintOf(step);
    const all = step.sides.length > 0 ? step.sides.map(({ agent }) => agent)
      : step.lemmas.length > 0 ? step.lemmas.flatMap((lemma) => certificate.lemmas[lemma].agents)
        : constraint ? [constraint.agent] : statement.number >= 0 ? statement.agents : [];
    return [...new Set(all)];
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  show(statement: Statement): void {
    this.statement = statement;
    this.select(statement.root);
  }

  // Selects a step and unfolds all steps above it.
  select(step: Step): void {
    this.step = step;
    this.marked = this.chosenTask = -1;
    for (let at = step.above; at; at = at.step.above) this.open.add(at.step);
    this.changed();
  }

  // Folds or unfolds a step. If folding hides the selected step, selects the folded step instead.
  unfold(step: Step, isOpen: boolean): void {
    if (isOpen) this.open.add(step);
    else this.open.delete(step);
    if (!isOpen && isBelow(this.step, step)) this.select(step);
    else this.changed();
  }

  unfoldAll(isOpen: boolean): void {
    for (const step of this.statement.steps) {
      if (isOpen && step.children.length > 0) this.open.add(step);
      else this.open.delete(step);
    }
    if (!isOpen) this.step = this.statement.root;
    this.changed();
  }

  // Returns the visible steps, one per row, in depth-first order.
  get rows(): Step[] {
    const rows: Step[] = [];
    const left = [this.statement.root];
    while (left.length > 0) {
      const step = left.pop()!;
      rows.push(step);
      if (this.open.has(step)) left.push(...[...step.children].reverse());
    }
    return rows;
  }

  choose(agent: number): void {
    this.marked = agent;
    this.chosenTask = -1;
    this.changed();
  }

  chooseTask(task: number): void {
    this.chosenTask = task;
    this.marked = -1;
    this.changed();
  }
}

function isBelow(step: Step, other: Step): boolean {
  for (let at = step.above; at; at = at.step.above) if (at.step === other) return true;
  return false;
}
