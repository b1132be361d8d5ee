// SPDX-License-Identifier: MIT
// Details of the selected robot or task, or a hint on how to select one.

import type { App } from "../app";
import { el } from "../dom";
import { head } from "./head";
import { RobotDetails } from "./robot";
import { taskDetails } from "./task";

export class Details {
  readonly element = el("section", { class: "details", "aria-label": "Selection" });
  private shown = "";
  private robot: RobotDetails | null = null;

  constructor(private readonly app: App) {}

  update(): void {
    const { chosen, chosenTask, viewed } = this.app;
    const known = viewed.map(({ checker, waits }) => `${checker.done} ${waits.done}`);
    const key = [chosen, chosenTask, ...known].join();
    if (key !== this.shown) {
      this.shown = key;
      this.robot = chosen >= 0 ? new RobotDetails(this.app, chosen) : null;
      this.element.replaceChildren(...this.robot?.elements ?? this.others(chosenTask));
    }
    this.robot?.update();
  }

  private others(task: number): HTMLElement[] {
    if (task >= 0)
      return [head(this.app, taskTitle(this.app, task)), ...taskDetails(this.app, task)];
    return [el("p", { class: "faint" },
      "Select a robot or a task: click it, or search for its id. Press ? for all keys.")];
  }
}

function taskTitle(app: App, task: number): string {
  return app.model.tasks[task].name;
}
