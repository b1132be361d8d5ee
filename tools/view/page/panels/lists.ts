// SPDX-License-Identifier: MIT
// Robots, tasks and events, with one field to search them all by id.

import type { App } from "../app";
import { el, plural, setText } from "../dom";
import { progressText } from "./robot";

type Tab = "events" | "tasks" | "robots";
const kTabs: Tab[] = ["events", "tasks", "robots"];
const kMostRows = 300;

interface Row {
  key: number;
  text: string;
  note: () => string;
  act: () => void;
  bad?: boolean;
}

export class Lists {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly body = el("div", { class: "rows" });
  private readonly buttons = new Map<Tab, HTMLButtonElement>();
  private tab: Tab;
  private notes: { element: HTMLElement; row: Row }[] = [];
  private eventCount = -1;

  constructor(private readonly app: App) {
    this.tab = app.model.tasks.length > 0 ? "tasks" : "robots";
    this.search = el("input", {
      type: "search", placeholder: "Search robots and tasks ( / )",
      "aria-label": "Search robots and tasks by id", input: () => this.fill(),
      keydown: (event) => this.key(event as KeyboardEvent),
    });
    for (const tab of kTabs)
      this.buttons.set(tab, el("button", { type: "button", role: "tab", click: () => this.turnTo(tab) },
        tab[0].toUpperCase() + tab.slice(1)));
    this.element = el("section", { class: "lists" }, this.search,
      el("div", { class: "tabs", role: "tablist" }, ...this.buttons.values()), this.body);
    this.fill();
  }

  update(): void {
    const count = this.app.viewed.reduce((sum, v) => sum + v.checker.violations.length, 0);
    if (count !== this.eventCount) {
      this.eventCount = count;
      setText(this.buttons.get("events")!, count > 0 ? `Events ⚠ ${count.toLocaleString("en")}` : "Events");
      if (this.tab === "events") this.fill();
    }
    for (const { element, row } of this.notes) setText(element, row.note());
  }

  private turnTo(tab: Tab): void {
    this.tab = tab;
    this.fill();
  }

  // The first of what was found.
  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      this.search.value = "";
      this.search.blur();
      this.fill();
    }
    if (event.key === "Enter") this.rows()[0]?.act();
    event.stopPropagation();
  }

  private fill(): void {
    for (const [tab, button] of this.buttons)
      button.setAttribute("aria-selected", String(tab === this.tab && this.search.value === ""));
    const rows = this.rows();
    this.notes = [];
    this.body.replaceChildren(...rows.slice(0, kMostRows).map((row) => this.rowElement(row)));
    if (rows.length > kMostRows)
      this.body.append(el("p", { class: "faint" }, `and ${plural(rows.length - kMostRows, "more")}: search for them`));
    if (rows.length === 0) this.body.append(el("p", { class: "faint" }, "nothing of that kind"));
    this.update();
  }

  private rowElement(row: Row): HTMLElement {
    const note = el("span", { class: "faint note" });
    this.notes.push({ element: note, row });
    return el("button", { type: "button", class: row.bad ? "row bad" : "row", click: row.act },
      el("span", {}, row.text), note);
  }

  private rows(): Row[] {
    const query = this.search.value.trim().toLowerCase();
    if (query !== "") {
      const found = (text: string) => text.toLowerCase().includes(query);
      const rows = [...this.robots(), ...this.tasks()].filter((row) => found(row.text));
      return rows.sort((a, b) => a.text.length - b.text.length);
    }
    return this.tab === "events" ? this.events() : this.tab === "tasks" ? this.tasks() : this.robots();
  }

  private robots(): Row[] {
    const { app } = this;
    return app.model.agents.map((agent, index) => ({
      key: index,
      text: agent.id,
      note: () => app.viewed.map((v) => `rests from ${v.facts.finish[index]}`).join("; "),
      act: () => app.choose(index),
    }));
  }

  private tasks(): Row[] {
    const { app } = this;
    return app.model.tasks.map((task, index) => ({
      key: index,
      text: `${index + 1}: ${task.id}`,
      note: () => progressText(app, index),
      act: () => app.chooseTask(index),
    }));
  }

  private events(): Row[] {
    const { app } = this;
    const rows: Row[] = [];
    app.viewed.forEach((viewed) => {
      const name = app.viewed.length > 1 ? `${viewed.plan.name}: ` : "";
      for (const wrong of viewed.checker.violations)
        rows.push({
          key: wrong.time, text: name + wrong.text, note: () => `step ${wrong.time}`, bad: true,
          act: () => {
            app.go(wrong.time);
            if (wrong.agents.length > 0) app.choose(wrong.agents[0]);
          },
        });
      viewed.facts.tasks.forEach((task, index) => {
        const time = task.times[task.times.length - 1];
        if (!Number.isFinite(time)) return;
        rows.push({
          key: time, text: `${name}${app.model.tasks[index].id} is done`, note: () => `step ${time}`,
          act: () => app.go(time),
        });
      });
      viewed.facts.finish.forEach((time, agent) => rows.push({
        key: time, text: `${name}${app.model.agents[agent].id} comes to rest`, note: () => `step ${time}`,
        act: () => app.go(time),
      }));
    });
    return rows.sort((a, b) => Number(b.bad ?? false) - Number(a.bad ?? false) || a.key - b.key);
  }
}
