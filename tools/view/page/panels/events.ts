// SPDX-License-Identifier: MIT
// The list of events, filtered by kind and robot.

import type { App } from "../app";
import { el, setText } from "../dom";
import { eventsOf, type EventKind, type PlanEvent } from "../events";
import type { Row } from "./rows";

const kKinds: [EventKind | "all", string][] = [
  ["all", "all events"],
  ["wrong", "problems"],
  ["wait", "long waits"],
  ["task", "completed tasks"],
  ["rest", "robots coming to rest"],
];

export class Events {
  readonly filters: HTMLElement;
  private readonly kind: HTMLSelectElement;
  private readonly only: HTMLButtonElement;
  private chosen = -1;
  private onlyChosen = false;
  private known: PlanEvent[] | null = null;

  constructor(private readonly app: App, private readonly changed: () => void) {
    this.kind = el("select", { "aria-label": "Kind of events", change: () => changed() },
      ...kKinds.map(([value, text]) => el("option", { value }, text)));
    this.only = el("button", { type: "button", click: () => this.toggle() });
    this.only.hidden = true;
    this.filters = el("div", { class: "filter" }, this.kind, this.only);
  }

  // Sets the selected robot. Returns whether the list changes; if not, the caller keeps the elements and
  // their focus.
  choose(robot: number): boolean {
    if (robot === this.chosen) return false;
    this.chosen = robot;
    this.only.hidden = robot < 0;
    if (robot >= 0) setText(this.only, `only robot ${this.app.model.agents[robot].name}`);
    return this.onlyChosen;
  }

  // Discards the list of events, because more events are known now.
  forget(): void {
    this.known = null;
  }

  private toggle(): void {
    this.onlyChosen = !this.onlyChosen;
    this.changed();
  }

  rows(query: string): Row[] {
    const { chosen } = this;
    this.only.setAttribute("aria-pressed", String(this.onlyChosen));
    this.known ??= eventsOf(this.app);
    const kind = this.kind.value;
    return this.known
      .filter((event) => kind === "all" || event.kind === kind)
      .filter((event) => !this.onlyChosen || chosen < 0 || event.agents.includes(chosen))
      .filter((event) => query === "" || event.text.toLowerCase().includes(query))
      .map((event) => this.row(event));
  }

  private row(event: PlanEvent): Row {
    const { app } = this;
    const { task = -1 } = event;
    const [agent = -1] = event.agents;
    return {
      key: event.text.toLowerCase(),
      text: event.text,
      note: () => `step ${event.time}`,
      bad: event.kind === "wrong",
      act: () => {
        app.show(Math.max(0, event.time), agent);
        if (task >= 0) app.chooseTask(task);
      },
    };
  }
}
