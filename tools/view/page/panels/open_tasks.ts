// SPDX-License-Identifier: MIT
// Filter of the list of tasks: the number of tasks that are open at the time shown, and whether the list has only
// these. A task is open until as many robots have visited it as it needs.

import type { App } from "../app";
import { el, setText } from "../dom";
import { doneTime } from "../facts";

export class OpenTasks {
  readonly filters: HTMLElement;
  private readonly count = el("span", { class: "faint" });
  private readonly only: HTMLButtonElement;
  private readonly done: number[][]; // by plan and task: time from which on it is done; Infinity: never
  private open = ""; // the number of open tasks of each plan
  private onlyOpen = false;

  constructor(private readonly app: App, private readonly changed: () => void) {
    const { tasks } = app.model;
    this.done = app.viewed.map(({ facts }) => tasks.map((task, i) => doneTime(task, facts.tasks[i])));
    this.only = el("button", { type: "button", "aria-pressed": "false", click: () => this.toggle() }, "only open");
    this.filters = el("div", { class: "filter" }, this.only, this.count);
    this.update();
  }

  // Updates the number. Returns whether the list changes.
  update(): boolean {
    const { time } = this.app.player;
    const counts = this.done.map((done) =>
      done.reduce((count, at) => (at > time ? count + 1 : count), 0).toLocaleString("en"));
    const open = counts.join(" / ");
    if (open === this.open) return false;
    this.open = open;
    setText(this.count, `${open} of ${this.app.model.tasks.length.toLocaleString("en")} open now`);
    return this.onlyOpen;
  }

  // Returns whether the list has the task: with the filter, only if it is open in one of the plans.
  shows(task: number): boolean {
    return !this.onlyOpen || this.done.some((done) => done[task] > this.app.player.time);
  }

  private toggle(): void {
    this.onlyOpen = !this.onlyOpen;
    this.only.setAttribute("aria-pressed", String(this.onlyOpen));
    this.changed();
  }
}
