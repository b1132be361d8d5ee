// SPDX-License-Identifier: MIT
// The list of events: which kinds, and whose.

import type { App } from "../app";
import { el, setText } from "../dom";
import { eventsOf, type EventKind, type PlanEvent } from "../events";
import type { Row } from "./rows";

const kKinds: [EventKind | "all", string][] = [
  ["all", "all events"],
  ["wrong", "what is wrong"],
  ["wait", "long waits"],
  ["task", "tasks done"],
  ["rest", "robots at rest"],
];

export class Events {
  readonly filters: HTMLElement;
  private readonly kind: HTMLSelectElement;
  private readonly only: HTMLButtonElement;
  private onlyChosen = false;
  private known: PlanEvent[] | null = null;

  constructor(private readonly app: App, private readonly changed: () => void) {
    this.kind = el("select", { "aria-label": "Which events", change: () => changed() },
      ...kKinds.map(([value, text]) => el("option", { value }, text)));
    this.only = el("button", { type: "button", click: () => this.toggle() });
    this.filters = el("div", { class: "filter" }, this.kind, this.only);
  }

  // More has been found out.
  forget(): void {
    this.known = null;
  }

  private toggle(): void {
    this.onlyChosen = !this.onlyChosen;
    this.changed();
  }

  rows(query: string): Row[] {
    const { app } = this;
    const { chosen } = app;
    this.only.hidden = chosen < 0;
    if (chosen >= 0) setText(this.only, `only of ${app.model.agents[chosen].name}`);
    this.only.setAttribute("aria-pressed", String(this.onlyChosen));
    this.known ??= eventsOf(app);
    const kind = this.kind.value;
    return this.known
      .filter((event) => kind === "all" || event.kind === kind)
      .filter((event) => !this.onlyChosen || chosen < 0 || event.agents.includes(chosen))
      .filter((event) => query === "" || event.text.toLowerCase().includes(query))
      .map((event) => this.row(event));
  }

  private row(event: PlanEvent): Row {
    const { app } = this;
    const [agent = -1] = event.agents;
    return {
      key: event.text.toLowerCase(),
      text: event.text,
      note: () => `step ${event.time}`,
      bad: event.kind === "wrong",
      act: () => app.show(Math.max(0, event.time), agent),
    };
  }
}
