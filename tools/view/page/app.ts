// SPDX-License-Identifier: MIT
// State of the page: plans, moment, selected robot. Panels read it, change it by its methods, and
// are notified when anything except time has changed.

import { Checker, type Violation } from "./check";
import { compare, type Comparison } from "./compare";
import { planFacts, type PlanFacts } from "./facts";
import type { Heat } from "./heat";
import type { Model, Plan } from "./model";
import { Player } from "./player";
import { Waits } from "./waiting";

export interface Viewed {
  plan: Plan;
  facts: PlanFacts;
  checker: Checker;
  waits: Waits;
}

export class App {
  readonly player: Player;
  readonly viewed: Viewed[]; // plans with paths, each with its own facts; at most two
  chosen = -1; // a robot
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

  // null unless there are two plans.
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

  // Continues the computations that take longer than a frame, first violations, then waits.
  work(milliseconds: number): void {
    const task = this.viewed.find(({ checker }) => !checker.done)?.checker ??
      this.viewed.find(({ waits }) => !waits.done)?.waits;
    if (!task) return;
    // Waits are painted (heat) and listed.
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

  // Goes to the moment of an event and selects its robot.
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

function view(model: Model, plan: Plan): Viewed {
  const facts = planFacts(model, plan);
  return { plan, facts, checker: new Checker(model, plan), waits: new Waits(model, plan, facts) };
}

// Returns the violations of a robot, or all violations if there is no robot.
export function violationsOf(viewed: Viewed, agent: number): Violation[] {
  const all = viewed.checker.violations;
  return agent < 0 ? all : all.filter((violation) => violation.agents.includes(agent));
}
