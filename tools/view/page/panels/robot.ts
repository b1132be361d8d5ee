// SPDX-License-Identifier: MIT
// Details of the selected robot: its current activity, its visits in order, and its waits with their causes.

import { violationsOf, type App, type PlanView } from "../app";
import { el, plural, setText } from "../dom";
import { waitText } from "../events";
import { Doing, visitsOf, type Span, type Visit } from "../facts";
import { hasChoice, type Task } from "../model";
import { listed } from "../names";
import { comparedDetails } from "./compared";
import { head } from "./head";
import { moments, type Moment } from "./moments";

export class RobotDetails {
  readonly elements: HTMLElement[];
  private readonly follow: HTMLElement;
  private readonly now: { viewed: PlanView; element: HTMLElement }[] = [];

  constructor(private readonly app: App, private readonly agent: number) {
    const { name, turnSteps } = app.model.agents[agent];
    this.follow = el("button", {
      type: "button", title: "Keep this robot in the middle (F)",
      click: () => app.set({ following: !app.following }),
    }, "Follow");
    const turning = turnSteps > 0
      ? [el("p", { class: "faint" }, `A quarter turn takes ${plural(turnSteps, "step")}.`)] : [];
    this.elements = [head(app, name, this.follow), ...turning, ...comparedDetails(app, agent),
      ...(app.viewed.length > 0 ? app.viewed.flatMap((viewed) => this.plan(viewed))
        : this.asked())];
  }

  // Returns the data of the robot in the instance, for an instance without a plan.
  private asked(): HTMLElement[] {
    const { agents, tasks, world } = this.app.model;
    const { start, goal, goals, tasks: own } = agents[this.agent];
    const line = (text: string) => el("p", {}, text);
    const options = this.options;
    return [
      line(`Starts on ${world.place(start)}.`),
      ...(own.length > 0 ? [line(`Must visit ${own.map((task) => tasks[task].name).join(", ")}.`)] : []),
      ...(options.length > 0 ? [line(`May visit ${listed(options.map(({ name }) => name))}.`)] : []),
      ...(own.length + options.length === 0 ? [line("Has no tasks.")] : []),
      line(goal >= 0 ? `Ends on ${world.place(goal)}.`
        : goals.length > 0 ? `Ends on one of ${listed(goals.map((place) => world.place(place)))}.`
        : own.length > 0 ? "Ends on one of its tasks." : "May end anywhere."),
    ];
  }

  // The tasks that the robot may visit.
  private get options(): Task[] {
    const { agents, tasks } = this.app.model;
    if (!agents[this.agent].hasOptions) return [];
    return tasks.filter((task) => hasChoice(task) && task.agents.includes(this.agent));
  }

  update(): void {
    this.follow.setAttribute("aria-pressed", String(this.app.following));
    for (const { viewed, element } of this.now) setText(element, this.doingNow(viewed));
  }

  private plan(viewed: PlanView): HTMLElement[] {
    const { model } = this.app;
    const { plan, facts, waits } = viewed;
    const title = this.app.viewed.length > 1 ? [el("h3", {}, plan.name)] : [];
    if (plan.agents[this.agent].track.isEmpty)
      return [...title, el("p", { class: "bad" }, "The plan has no path for this robot.")];
    const now = el("p", { class: "now" });
    this.now.push({ viewed, element: now });
    const rest = facts.finish[this.agent];
    return [
      ...title,
      now,
      el("p", {}, `Cost ${rest}: the robot is at rest from that step on.`),
      ...this.choices(viewed),
      ...this.list("Problems", violationsOf(viewed, this.agent), (wrong) => wrong, "bad"),
      ...(this.app.viewed.length > 1 ? []
        : this.list("Visits", this.visits(viewed), (visit) => this.visit(visit))),
      ...this.list("Waits", waits.byAgent[this.agent], (wait) => ({
        time: wait.begin,
        text: waits.done ? waitText(model, wait) : plural(wait.end - wait.begin, "step"),
      })),
    ];
  }

  // Returns the choices of the robot: its destination, and how many of the tasks that it may visit it visits.
  private choices({ facts, plan }: PlanView): HTMLElement[] {
    const { agents, tasks, world } = this.app.model;
    const { goals } = agents[this.agent];
    const end = facts.destinations[this.agent];
    const options = this.options.length;
    const chosen = new Set(plan.agents[this.agent].work.map(({ task }) => task)
      .filter((task) => hasChoice(tasks[task]))).size;
    return [
      ...(goals.length > 0 && end >= 0 ? [el("p", {}, `Ends on ${world.place(end)}, its choice of ` +
        `${plural(goals.length, "possible destination")}.`)] : []),
      ...(options > 0 ? [el("p", {}, `Visits ${chosen.toLocaleString("en")} of ` +
        `${plural(options, "task")} that it may visit.`)] : []),
    ];
  }

  private visits({ plan }: PlanView): Visit[] {
    const { model } = this.app;
    return visitsOf(model, plan.agents[this.agent], model.agents[this.agent]);
  }

  private list<T>(
    title: string, things: T[], describe: (thing: T) => Moment, kind = "",
  ): HTMLElement[] {
    if (things.length === 0) return [];
    return [el("h4", { class: kind }, title), moments(this.app, things, describe)];
  }

  // Returns the entry of a visit. Its time is that of the visit or, if the task has a duration, the start of
  // its execution.
  private visit({ task, begin, time }: Visit): Moment {
    const { duration, name } = this.app.model.tasks[task];
    const what = `${name}${hasChoice(this.app.model.tasks[task]) ? " (by choice)" : ""}`;
    if (time === Infinity) return { time, text: what };
    return { time: begin, text: duration > 0 ? `${what}, at work until ${time}` : what };
  }

  private doingNow(viewed: PlanView): string {
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
