// SPDX-License-Identifier: MIT
// What is shown: which plans, which moment, which robot. Panels read it, change it by its methods,
// and are told when something other than time has changed.

import { planFacts, type PlanFacts } from "./facts";
import type { Model, Plan } from "./model";
import { Player } from "./player";
import { Checker, type Violation } from "./check";

export interface Viewed {
  plan: Plan;
  facts: PlanFacts;
  checker: Checker;
}

export type Heat = "none" | "traffic" | "waits" | "yields";

export class App {
  readonly player: Player;
  readonly viewed: Viewed[]; // those with paths, each with its own facts
  chosen = -1; // a robot
  chosenTask = -1;
  following = false;
  heat: Heat = "none";
  labels = true;
  private readonly listeners: (() => void)[] = [];

  constructor(readonly model: Model) {
    this.viewed = model.plans
      .filter((plan) => plan.agents.length > 0)
      .map((plan) => ({ plan, facts: planFacts(model, plan), checker: new Checker(model, plan) }));
    this.player = new Player(Math.max(0, ...this.viewed.map((v) => v.plan.end)));
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
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

  set(change: Partial<Pick<App, "following" | "heat" | "labels">>): void {
    Object.assign(this, change);
    this.changed();
  }
}

// The violations that concern a robot; all for none.
export function violationsOf(viewed: Viewed, agent: number): Violation[] {
  const all = viewed.checker.violations;
  return agent < 0 ? all : all.filter((violation) => violation.agents.includes(agent));
}
