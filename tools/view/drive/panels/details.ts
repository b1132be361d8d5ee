// SPDX-License-Identifier: MIT
// Panel of the selected robot or task: activity, progress and visits.

import { el, setText } from "../../page/dom";
import { hasChoice } from "../../page/model";
import { head } from "../../page/panels/head";
import { momentButton } from "../../page/panels/rows";
import { needText } from "../../page/panels/task";
import type { DriveApp } from "../app";
import { clockText, doingText, lateSentence, progressText } from "../words";

export class Details {
  readonly element = el("section", { class: "details", "aria-label": "Selection" });
  private readonly now = el("p", { class: "now" });
  private readonly progress = el("p");
  private readonly late = el("p");
  private readonly follow: HTMLElement;
  private shown = "";

  constructor(private readonly app: DriveApp) {
    this.follow = el("button", {
      type: "button", title: "Keep this robot in the middle (F)",
      click: () => {
        app.following = !app.following;
        app.changed();
      },
    }, "Follow");
  }

  update(): void {
    const { chosen, chosenTask, following } = this.app;
    const key = [chosen, chosenTask, this.known()].join();
    if (key !== this.shown) {
      this.shown = key;
      this.element.replaceChildren(...(chosen >= 0 ? this.robot(chosen)
        : chosenTask >= 0 ? this.task(chosenTask) : this.nothing()));
    }
    this.follow.setAttribute("aria-pressed", String(following));
    if (chosen >= 0) this.describe(chosen);
  }

  // Returns the number of visits, by the selected robot or to the selected task, in the log so far.
  private known(): number {
    const { app } = this;
    if (app.chosen >= 0)
      return app.order.visits(app.chosen).filter(({ action }) =>
        app.visitTime(app.chosen, action) < Infinity).length;
    return app.chosenTask >= 0 ? app.tasks[app.chosenTask].times.length : 0;
  }

  private describe(agent: number): void {
    const { app } = this;
    const { time } = app.player;
    const completed = app.drive.actionsAt(agent, time);
    const last = app.order.planTime(agent, app.order.actions(agent));
    setText(this.now, `Now: ${doingText(app, agent, time)}`);
    setText(this.progress, `${progressText(app, agent, time)} actions done: step ` +
      `${app.order.planTime(agent, completed)} of ${last} of the plan.`);
    setText(this.late, lateSentence(app, agent, time));
  }

  private robot(agent: number): HTMLElement[] {
    const { app } = this;
    const visits = app.order.visits(agent).map(({ task, action }) =>
      this.visit(app.visitTime(agent, action), app.model.tasks[task].name));
    return [head(app, app.model.agents[agent].name, this.follow), this.now, this.progress,
      this.late,
      ...(visits.length > 0 ? [el("h4", {}, "Visits"), el("ul", { class: "moments" }, ...visits)] : [])];
  }

  // Lists the robots that must visit the task or, if it has a choice of robots, those that visit it in the plan.
  private task(index: number): HTMLElement[] {
    const { app } = this;
    const task = app.model.tasks[index];
    const visits = task.agents.flatMap((agent) => {
      const visit = app.order.visits(agent).find((v) => v.task === index);
      if (!visit && hasChoice(task)) return [];
      return [this.visit(visit ? app.visitTime(agent, visit.action) : Infinity,
        app.model.agents[agent].name)];
    });
    return [head(app, `${index + 1}: ${task.name}`), el("p", {}, `On ${app.model.world.place(task.place)}.`),
      ...(hasChoice(task) ? [el("p", {}, needText(app.model, task))] : []),
      el("h4", {}, "Visited by"), el("ul", { class: "moments" }, ...visits)];
  }

  private visit(time: number, text: string): HTMLElement {
    const moment = time < Infinity
      ? momentButton(clockText(time), () => this.app.go(time), `Go to ${clockText(time)}`)
      : el("span", { class: "moment faint" }, "–");
    return el("li", {}, moment, " ", el("span", { dir: "auto" }, text));
  }

  private nothing(): HTMLElement[] {
    return [el("p", { class: "faint" },
      "Select a robot or a task: click it, or search for a robot. Press ? for all keys.")];
  }
}
