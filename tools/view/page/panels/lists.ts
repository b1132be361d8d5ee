// SPDX-License-Identifier: MIT
// Lists of tasks, robots, events and differences, with one search field for all of them.

import type { App } from "../app";
import { el, setText } from "../dom";
import { Differences } from "./differences";
import { Events } from "./events";
import { OpenTasks } from "./open_tasks";
import { progressText } from "./task";
import { kMostRows, rowElement, type Row } from "./rows";

type Tab = "tasks" | "robots" | "events" | "differences";

export class Lists {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly top = el("div", { class: "filters" });
  private readonly body = el("div", { class: "rows" });
  private readonly buttons = new Map<Tab, HTMLButtonElement>();
  private readonly events: Events;
  private readonly differences: Differences | null;
  private readonly openTasks: OpenTasks;
  private tab: Tab;
  private rows: Row[] = [];
  private notes: { element: HTMLElement; row: Row }[] = [];
  private found = ""; // state of the searches for violations and waits when the events were listed

  constructor(private readonly app: App) {
    const { comparison, model } = app;
    this.events = new Events(app, () => this.fill());
    this.differences = comparison ? new Differences(app, comparison, () => this.fill()) : null;
    this.openTasks = new OpenTasks(app, () => this.fill());
    this.tab = this.differences ? "differences" : model.tasks.length > 0 ? "tasks" : "robots";
    this.search = el("input", {
      type: "search", placeholder: "Search robots and tasks ( / )",
      "aria-label": "Search robots and tasks by id", input: () => this.fill(),
      keydown: (event) => this.key(event as KeyboardEvent),
    });
    const tabs: Tab[] = ["robots"];
    if (app.viewed.length > 0) tabs.push("events");
    if (model.tasks.length > 0) tabs.unshift("tasks");
    if (this.differences) tabs.unshift("differences");
    for (const tab of tabs)
      this.buttons.set(tab, el("button", { type: "button", click: () => this.turnTo(tab) },
        tab[0].toUpperCase() + tab.slice(1)));
    this.element = el("section", { class: "lists", "aria-label": "Lists" }, this.search,
      el("div", { class: "tabs" }, ...this.buttons.values()), this.top, this.body);
    this.fill();
  }

  update(): void {
    const wrong = this.app.viewed.reduce((sum, v) => sum + v.checker.violations.length, 0);
    const known = this.app.viewed.every((v) => v.waits.done);
    const found = [wrong, known].join();
    if (found !== this.found) {
      this.found = found;
      const button = this.buttons.get("events");
      if (button) setText(button, wrong > 0 ? `Events ⚠ ${wrong.toLocaleString("en")}` : "Events");
      this.events.forget();
      if (this.tab === "events") this.fill();
    }
    if (this.openTasks.update() && this.tab === "tasks") this.fill();
    if (this.tab === "events" && this.events.choose(this.app.chosen)) this.fill();
    for (const { element, row } of this.notes) setText(element, row.note());
  }

  private turnTo(tab: Tab): void {
    this.tab = tab;
    this.search.value = "";
    this.fill();
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      this.search.value = "";
      this.search.blur();
      this.fill();
    }
    if (event.key === "Enter") this.rows[0]?.act();
    event.stopPropagation();
  }

  private get query(): string {
    return this.search.value.trim().toLowerCase();
  }

  private fill(): void {
    for (const [tab, button] of this.buttons)
      button.setAttribute("aria-pressed", String(tab === this.tab));
    const filters = this.filters;
    if (filters === null) this.top.replaceChildren();
    else if (!this.top.contains(filters)) this.top.replaceChildren(filters);
    this.rows = this.query === "" ? this.ofTab() : this.matching(this.query);
    const shown = this.rows.slice(0, kMostRows).map((row) => ({ row, ...rowElement(row) }));
    this.notes = shown.map(({ row, note }) => ({ element: note, row }));
    this.body.replaceChildren(...shown.map(({ element }) => element));
    const rest = this.rows.length - kMostRows;
    if (rest > 0)
      this.body.append(el("p", { class: "faint" }, `and ${rest.toLocaleString("en")} more: use the search`));
    if (this.rows.length === 0) this.body.append(el("p", { class: "faint" }, this.nothing()));
    for (const { element, row } of this.notes) setText(element, row.note());
  }

  private get filters(): HTMLElement | null {
    switch (this.tab) {
      case "events": return this.events.filters;
      case "differences": return this.differences!.filters;
      case "tasks": return this.app.viewed.length > 0 ? this.openTasks.filters : null;
      default: return null;
    }
  }

  private nothing(): string {
    if (this.tab === "tasks" && this.query === "") return "no task is open";
    const isSame = this.tab === "differences" && this.query === "";
    return isSame ? "every robot does the same in both plans" : "no matches";
  }

  private ofTab(): Row[] {
    switch (this.tab) {
      case "tasks": return this.tasks().filter((_, task) => this.openTasks.shows(task));
      case "robots": return this.robots();
      case "events": return this.events.rows("");
      case "differences": return this.differences!.rows();
    }
  }

  // Returns the rows that match, those with shorter ids first, because they match the input better.
  private matching(query: string): Row[] {
    const things = [...this.robots(), ...this.tasks()].filter((row) => row.key.includes(query));
    things.sort((a, b) => a.key.length - b.key.length);
    if (this.tab === "events") return [...this.events.rows(query), ...things];
    if (this.tab !== "differences") return things;
    const different = this.differences!.rows().filter((row) => row.key.includes(query));
    return different.length > 0 ? different : things;
  }

  private robots(): Row[] {
    const { app } = this;
    return app.model.agents.map(({ id, name }, index) => ({
      key: id.toLowerCase(),
      text: name,
      note: () => restText(app, index),
      act: () => app.choose(index),
    }));
  }

  private tasks(): Row[] {
    const { app } = this;
    return app.model.tasks.map(({ id, name }, index) => ({
      key: id.toLowerCase(),
      text: name,
      note: () => progressText(app, index),
      act: () => app.chooseTask(index),
    }));
  }
}

function restText({ viewed }: App, agent: number): string {
  const times = viewed.map(({ facts, plan }) =>
    plan.agents[agent].track.isEmpty ? "no path" : String(facts.finish[agent]));
  return viewed.length > 0 ? `rests from ${times.join(" / ")}` : "";
}
