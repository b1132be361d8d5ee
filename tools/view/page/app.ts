// SPDX-License-Identifier: MIT
// State of the page: plans, the moment shown, and the selected robot or task. Panels read the state, change
// it through its methods, and are notified of every change except the advance of time during playback.

import { Checker, type Violation } from "./check";
import { compare, type Comparison } from "./compare";
import { planFacts, type PlanFacts } from "./facts";
import type { Heat } from "./heat";
import type { Model, Plan } from "./model";
import { Player } from "./player";
import { Waits } from "./waiting";

export interface PlanView {
  plan: Plan;
  facts: PlanFacts;
  checker: Checker;
  waits: Waits;
}

export class App {
  readonly player: Player;
  readonly viewed: PlanView[]; // the plans that have paths, with the facts about each; at most two
  chosen = -1; // the selected robot; -1: none
  chosenTask = -1;
  following = false;
  heat: Heat = "none";
  labels = true;
  private readonly listeners: (() => void)[] = [];
  private compared: Comparison | null = null;

  constructor(readonly model: Model) {
    this.viewed = model.plans
      .filter((plan) => plan.agents.length > 0)
      .slice(0, 2)
      .map((plan) => view(model, plan));
    this.player = new Player(Math.max(0, ...this.viewed.map((v) => v.plan.end)));
  }

  // Returns the comparison of the two plans, or null if there are fewer.
  get comparison(): Comparison | null {
    if (this.viewed.length < 2) return null;
    this.compared ??= compare(this.model, this.viewed[0], this.viewed[1]);
    return this.compared;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  // Continues the computations that take longer than a frame, for about this time: first the search for
  // violations, then the search for the causes of waits.
  work(milliseconds: number): void {
    const task = this.viewed.find(({ checker }) => !checker.done)?.checker ??
      this.viewed.find(({ waits }) => !waits.done)?.waits;
    if (!task) return;
    // The results are painted (as heat) and listed.
    if (task.step(milliseconds)) this.changed();
  }

  choose(agent: number): void {
    this.chosen = agent;
    this.chosenTask = -1;
    if (agent < 0) this.following = false;
    this.changed();
  }

  chooseTask(task: number): void {
    this.chosenTask = task;
    this.chosen = -1;
    this.following = false;
    this.changed();
  }

  go(time: number): void {
    this.player.go(time);
    this.changed();
  }

  // Goes to the time of an event, pauses there and selects the robot of the event.
  show(time: number, agent: number): void {
    this.player.playing = false;
    this.player.go(time);
    this.choose(agent);
  }

  set(change: Partial<Pick<App, "following" | "heat" | "labels">>): void {
    Object.assign(this, change);
    this.changed();
  }
}

function view(model: Model, plan: Plan): PlanView {
  const facts = planFacts(model, plan);
  return { plan, facts, checker: new Checker(model, plan), waits: new Waits(model, plan, facts) };
}

// Returns the violations in which a robot is involved, or all violations if `agent` is -1.
export function violationsOf(viewed: PlanView, agent: number): Violation[] {
  const all = viewed.checker.violations;
  return agent < 0 ? all : all.filter((violation) => violation.agents.includes(agent));
}
