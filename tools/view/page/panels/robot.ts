// SPDX-License-Identifier: MIT
// The robot or task chosen: what it does now, its visits in order, its waits and whom it lets pass.

import { violationsOf, type App, type Viewed } from "../app";
import { el, plural, setText } from "../dom";
import { Doing, visitsBy, visitsOf, waits, type Span } from "../facts";

const kMostRows = 200;

export class Details {
  readonly element = el("section", { class: "details", "aria-live": "off" });
  private shown = "";
  private now: { viewed: Viewed; element: HTMLElement }[] = [];

  constructor(private readonly app: App) {}

  update(): void {
    const { chosen, chosenTask, following } = this.app;
    const key = [chosen, chosenTask, following].join();
    if (key !== this.shown) {
      this.shown = key;
      this.now = [];
      this.element.replaceChildren(
        ...(chosen >= 0 ? this.robot(chosen) : chosenTask >= 0 ? this.task(chosenTask) : this.hint()),
      );
    }
    for (const { viewed, element } of this.now) setText(element, this.doingNow(viewed));
  }

  private hint(): HTMLElement[] {
    return [
      el("p", { class: "faint" }, "Choose a robot or a task: click it, or search for its name."),
      el("p", { class: "faint" },
        "Space plays, arrows step, + and − zoom, F follows the robot, 0 shows everything."),
    ];
  }

  private robot(agent: number): HTMLElement[] {
    const { model } = this.app;
    const { id, turnSteps } = model.agents[agent];
    const follow = el("button", {
      type: "button", "aria-pressed": this.app.following,
      click: () => this.app.set({ following: !this.app.following }),
    }, "Follow");
    const close = el("button", {
      type: "button", "aria-label": "Choose nothing", click: () => this.app.choose(-1),
    }, "✕");
    const head = el("div", { class: "head" }, el("h2", {}, id), follow, close);
    const turning = turnSteps > 0
      ? [el("p", { class: "faint" }, `A quarter turn takes it ${plural(turnSteps, "step")}.`)] : [];
    return [head, ...turning, ...this.app.viewed.flatMap((viewed) => this.plan(viewed, agent))];
  }

  private plan(viewed: Viewed, agent: number): HTMLElement[] {
    const { model } = this.app;
    const { plan, facts } = viewed;
    const now = el("p", { class: "now" });
    this.now.push({ viewed, element: now });
    const several = this.app.viewed.length > 1;
    const visits = visitsOf(model, plan.agents[agent], model.agents[agent]);
    const waited = waits(plan, agent, facts.spans[agent]);
    const wrong = violationsOf(viewed, agent);
    return [
      ...(several ? [el("h3", {}, plan.name)] : []),
      now,
      el("p", {}, `Rests from step ${facts.finish[agent]} on: that is its cost.`),
      ...(wrong.length > 0 ? [el("h4", { class: "bad" }, "Wrong"), this.list(wrong.map((w) => [w.time, w.text]))] : []),
      ...(visits.length > 0 ? [el("h4", {}, "Visits"),
        this.list(visits.map((v) => [v.time, `${v.task + 1}: ${model.tasks[v.task].id}`]))] : []),
      ...(waited.length > 0 ? [el("h4", {}, "Waits"), this.list(waited.map((w) => [w.begin, this.waitText(w)]))] : []),
    ];
  }

  private waitText(wait: { begin: number; end: number; for: number[] }): string {
    const names = wait.for.slice(0, 5).map((other) => this.app.model.agents[other].id);
    const more = wait.for.length > 5 ? " and others" : "";
    const whom = names.length > 0 ? `lets ${names.join(", ")}${more} pass` : "its way is free";
    return `${plural(wait.end - wait.begin, "step")}: ${whom}`;
  }

  private doingNow(viewed: Viewed): string {
    const step = Math.floor(this.app.player.time);
    const span = viewed.facts.spans[this.app.chosen].find((s) => s.end > step);
    const where = this.app.model.world.place(viewed.plan.agents[this.app.chosen].track.place(step));
    return span ? `Now: ${this.doingText(span)} on ${where}` : "";
  }

  private doingText(span: Span): string {
    switch (span.doing) {
      case Doing.kMoving: return "moving";
      case Doing.kWaiting: return "waiting";
      case Doing.kWorking: return `at work on ${this.app.model.tasks[span.task].id}`;
      default: return "at rest";
    }
  }

  private task(index: number): HTMLElement[] {
    const { model } = this.app;
    const task = model.tasks[index];
    const close = el("button", {
      type: "button", "aria-label": "Choose nothing", click: () => this.app.chooseTask(-1),
    }, "✕");
    const rows = this.app.viewed.flatMap((viewed) => {
      const facts = viewed.facts.tasks[index];
      const several = this.app.viewed.length > 1 ? [el("h3", {}, viewed.plan.name)] : [];
      return [...several, this.list(facts.times.map((time, i) => [time, model.agents[facts.agents[i]].id]))];
    });
    return [
      el("div", { class: "head" }, el("h2", {}, `${index + 1}: ${task.id}`), close),
      el("p", { class: "faint" }, `On ${model.world.place(task.place)}` +
        (task.duration > 0 ? `; takes ${plural(task.duration, "step")}` : "")),
      el("h4", {}, task.agents.length > 1 ? "Visited by, in this order" : "Visited by"),
      ...rows,
    ];
  }

  // Moments to jump to.
  private list(rows: [number, string][]): HTMLElement {
    const items = rows.slice(0, kMostRows).map(([time, text]) =>
      el("li", {},
        Number.isFinite(time)
          ? el("button", { type: "button", class: "moment", click: () => this.app.go(Math.max(0, time)) }, String(time))
          : el("span", { class: "moment bad" }, "never"),
        " ", text));
    const rest = rows.length - kMostRows;
    if (rest > 0) items.push(el("li", { class: "faint" }, `and ${plural(rest, "more")}`));
    return el("ul", { class: "moments" }, ...items);
  }
}

export function progressText(app: App, task: number): string {
  const viewed = app.viewed[0];
  const total = app.model.tasks[task].agents.length;
  const visits = viewed ? visitsBy(viewed.facts.tasks[task], app.player.time) : 0;
  return `${visits} of ${total}`;
}
