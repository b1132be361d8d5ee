// SPDX-License-Identifier: MIT
// List of robots with activity and progress: all, waiting, late, or those that need help.

import { el, setText } from "../../page/dom";
import { kMostRows, rowElement, type Row } from "../../page/panels/rows";
import type { DriveApp } from "../app";
import { kDone, kWaiting, needsHelp } from "../drive";
import { lateness } from "../late";
import { doingText, lateText, progressText } from "../words";

type Kind = "all" | "waiting" | "late" | "help";

const kKinds: [Kind, string][] = [
  ["all", "All"], ["waiting", "Waiting"], ["late", "Late"], ["help", "Needs help"],
];

export class Robots {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly body = el("div", { class: "rows" });
  private readonly buttons = new Map<Kind, HTMLButtonElement>();
  private kind: Kind = "all";
  private shown = ""; // kind and agents of the displayed rows
  private rows: { agent: number; row: Row; element: HTMLElement; note: HTMLElement }[] = [];

  constructor(private readonly app: DriveApp) {
    this.search = el("input", {
      type: "search", placeholder: "Search robots ( / )", "aria-label": "Search robots by id",
      input: () => this.update(),
      keydown: (event) => this.key(event as KeyboardEvent),
    });
    for (const [kind, text] of kKinds)
      this.buttons.set(kind, el("button", { type: "button", click: () => this.turnTo(kind) }, text));
    this.element = el("section", { class: "lists", "aria-label": "Robots" }, this.search,
      el("div", { class: "tabs" }, ...this.buttons.values()), this.body);
  }

  update(): void {
    const agents = this.agents();
    const key = `${this.kind} ${agents.join()}`;
    if (key !== this.shown) this.fill(agents, key);
    const { time } = this.app.player;
    for (const { agent, row, element, note } of this.rows) {
      setText(note, row.note());
      element.classList.toggle("bad", needsHelp(this.app.drive.stateAt(agent, time)));
      element.setAttribute("aria-pressed", String(agent === this.app.chosen));
    }
  }

  private turnTo(kind: Kind): void {
    this.kind = kind;
    this.update();
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      this.search.value = "";
      this.search.blur();
      this.update();
    }
    if (event.key === "Enter") this.rows[0]?.row.act();
    event.stopPropagation();
  }

  private agents(): number[] {
    const { model } = this.app;
    const query = this.search.value.trim().toLowerCase();
    const found = [...model.agents.keys()].filter((agent) =>
      model.agents[agent].id.toLowerCase().includes(query) && this.isOfKind(agent));
    return this.kind === "late" ? found.sort((a, b) => this.late(b) - this.late(a)) : found;
  }

  private isOfKind(agent: number): boolean {
    const state = this.app.drive.stateAt(agent, this.app.player.time);
    switch (this.kind) {
      case "all": return true;
      case "waiting": return state === kWaiting;
      case "late": return this.late(agent) > 0;
      case "help": return needsHelp(state);
    }
  }

  // Returns the delay in whole seconds, as displayed, so that smaller differences do not reorder the rows.
  private late(agent: number): number {
    return Math.floor(lateness(this.app, agent, this.app.player.time));
  }

  private fill(agents: number[], key: string): void {
    this.shown = key;
    for (const [kind, button] of this.buttons)
      button.setAttribute("aria-pressed", String(kind === this.kind));
    this.rows = agents.slice(0, kMostRows).map((agent) => {
      const row = this.row(agent);
      return { agent, row, ...rowElement(row) };
    });
    this.body.replaceChildren(...this.rows.map(({ element }) => element));
    const rest = agents.length - kMostRows;
    if (rest > 0)
      this.body.append(el("p", { class: "faint" }, `and ${rest.toLocaleString("en")} more: use the search`));
    if (agents.length === 0) this.body.append(el("p", { class: "faint" }, "none"));
  }

  private row(agent: number): Row {
    const { app } = this;
    return {
      key: app.model.agents[agent].id.toLowerCase(),
      text: app.model.agents[agent].name,
      note: () => {
        const { time } = app.player;
        const isDone = app.drive.stateAt(agent, time) === kDone;
        return [doingText(app, agent, time), isDone ? "" : progressText(app, agent, time),
          lateText(lateness(app, agent, time))].filter((text) => text !== "").join(" · ");
      },
      act: () => app.choose(agent),
    };
  }
}
