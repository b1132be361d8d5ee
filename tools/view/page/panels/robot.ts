// SPDX-License-Identifier: MIT
// The robot chosen: what it does now, its visits in order, its waits and whom it lets pass; of two
// plans, how they differ.

import { violationsOf, type App, type Viewed } from "../app";
import type { Difference } from "../compare";
import { el, plural, setText } from "../dom";
import { waitText } from "../events";
import { Doing, visitsOf, type Span, type Visit } from "../facts";
import { signed } from "./differences";
import { head } from "./head";
import { moments, type Moment } from "./moments";
import { momentButton } from "./rows";

export class RobotDetails {
  readonly elements: HTMLElement[];
  private readonly follow: HTMLElement;
  private readonly now: { viewed: Viewed; element: HTMLElement }[] = [];

  constructor(private readonly app: App, private readonly agent: number) {
    const { name, turnSteps } = app.model.agents[agent];
    this.follow = el("button", {
      type: "button", title: "Keep it in the middle (F)", click: () => app.set({ following: !app.following }),
    }, "Follow");
    const turning = turnSteps > 0
      ? [el("p", { class: "faint" }, `A quarter turn takes it ${plural(turnSteps, "step")}.`)] : [];
    this.elements = [head(app, name, this.follow), ...turning, ...this.compared(),
      ...app.viewed.flatMap((viewed) => this.plan(viewed))];
  }

  update(): void {
    this.follow.setAttribute("aria-pressed", String(this.app.following));
    for (const { viewed, element } of this.now) setText(element, this.doingNow(viewed));
  }

  private compared(): HTMLElement[] {
    const { comparison } = this.app;
    if (!comparison) return [];
    const difference = comparison.all.find(({ agent }) => agent === this.agent);
    return [difference ? this.difference(difference)
      : el("p", { class: "faint" }, "It does the same in both plans."), ...this.bothVisits()];
  }

  // In the order of the first plan; when, in each.
  private bothVisits(): HTMLElement[] {
    const [first, second] = this.app.viewed.map((viewed) => this.visits(viewed));
    if (first.length === 0) return [];
    const rows = first.map((visit) => {
      const other = second.find(({ task }) => task === visit.task)!;
      const { name } = this.app.model.tasks[visit.task];
      return el("tr", {}, el("th", { scope: "row", dir: "auto" }, `${visit.task + 1}: ${name}`),
        ...[visit, other].map(({ begin, time }, i) => el("td", {},
          time === Infinity ? el("span", { class: "bad" }, "never") : momentButton(begin, () => this.app.go(begin)),
          first.indexOf(visit) !== second.indexOf(other) && i === 1
            ? el("b", { title: "Its place in the order" }, ` ${ordinal(second.indexOf(other) + 1)}`) : null)));
    });
    const names = this.app.viewed.map(({ plan }) => el("th", { scope: "col", title: plan.name }, plan.name));
    return [el("table", { class: "visits" }, el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Visits"), ...names)),
      el("tbody", {}, ...rows))];
  }

  private difference({ by, orders, parts }: Difference): HTMLElement {
    if (Number.isNaN(by)) return el("p", {}, "One of the plans has no path for it.");
    const order = orders ? " It visits its tasks in another order." : "";
    const more = by === 0 ? "It costs the same in both plans." : `It costs ${signed(by)} in the second plan.`;
    return el("p", {}, `${more}${order} They differ from step `,
      momentButton(parts, () => this.app.go(parts)), " on. Dashed: its path in the other plan.");
  }

  private plan(viewed: Viewed): HTMLElement[] {
    const { model } = this.app;
    const { plan, facts, waits } = viewed;
    const title = this.app.viewed.length > 1 ? [el("h3", {}, plan.name)] : [];
    if (plan.agents[this.agent].track.isEmpty) return [...title, el("p", { class: "bad" }, "It has no path.")];
    const now = el("p", { class: "now" });
    this.now.push({ viewed, element: now });
    const rest = facts.finish[this.agent];
    return [
      ...title,
      now,
      el("p", {}, `Costs ${rest}: at rest from that step on.`),
      ...this.list("Wrong", violationsOf(viewed, this.agent), (wrong) => wrong, "bad"),
      ...(this.app.viewed.length > 1 ? [] : this.list("Visits", this.visits(viewed), (visit) => this.visit(visit))),
      ...this.list("Waits", waits.byAgent[this.agent], (wait) =>
        ({ time: wait.begin, text: waits.done ? waitText(model, wait) : plural(wait.end - wait.begin, "step") })),
    ];
  }

  private visits({ plan }: Viewed): Visit[] {
    const { model } = this.app;
    return visitsOf(model, plan.agents[this.agent], model.agents[this.agent]);
  }

  private list<T>(title: string, things: T[], tell: (thing: T) => Moment, kind = ""): HTMLElement[] {
    return things.length > 0 ? [el("h4", { class: kind }, title), moments(this.app, things, tell)] : [];
  }

  // When it passes, or begins to work.
  private visit({ task, begin, time }: Visit): Moment {
    const { duration, name } = this.app.model.tasks[task];
    const what = `${task + 1}: ${name}`;
    if (time === Infinity) return { time, text: what };
    return { time: begin, text: duration > 0 ? `${what}, at work until ${time}` : what };
  }

  private doingNow(viewed: Viewed): string {
    const step = Math.floor(this.app.player.time);
    const span = viewed.facts.spans[this.agent].find((s) => s.end > step);
    const where = this.app.model.world.place(viewed.plan.agents[this.agent].track.place(step));
    return span ? `Now: ${this.doingText(span)} on ${where}` : "";
  }

  private doingText(span: Span): string {
    switch (span.doing) {
      case Doing.kMoving: return "moving";
      case Doing.kWaiting: return "waiting";
      case Doing.kWorking: return `at work on ${this.app.model.tasks[span.task].name}`;
      default: return "at rest";
    }
  }
}

// "2nd"
function ordinal(place: number): string {
  const ends = ["th", "st", "nd", "rd"];
  const last = place % 100 > 10 && place % 100 < 14 ? 0 : place % 10;
  return `${place}${ends[last] ?? "th"}`;
}
