// SPDX-License-Identifier: MIT
// The line at the top: instance, progress of the execution, and whether the display is live.

import { el, plural, setText } from "../../page/dom";
import type { DriveApp } from "../app";
import { mostLate } from "../late";
import { counts, lateText } from "../words";

export class Strip {
  readonly element: HTMLElement;
  private readonly state = el("span", { class: "state", role: "status" });
  private readonly counts = el("span", { class: "claim" });
  private readonly help = el("strong", { class: "bad" });
  private readonly failure = el("span", { class: "bad", role: "alert" });
  private isAnswering = true;

  constructor(private readonly app: DriveApp) {
    const { model } = app;
    this.element = el("header", { class: "strip" },
      el("h1", {}, `${model.instance}: an execution`),
      el("span", { class: "faint" },
        `${plural(model.agents.length, "robot")}, ${plural(model.tasks.length, "task")}`),
      this.state, this.counts, this.help, this.failure);
  }

  answers(isAnswering: boolean): void {
    this.isAnswering = isAnswering;
  }

  fail(why: string): void {
    setText(this.failure, why);
  }

  update(): void {
    const { app } = this;
    const { done, waiting, help } = counts(app, app.player.time);
    setText(this.state, this.stateNow());
    const late = lateText(mostLate(app, app.player.time));
    setText(this.counts, `${done} of ${app.model.agents.length} done, ${waiting} waiting` +
      (late && `, up to ${late}`));
    setText(this.help, help > 0 ? `⚠ ${help} ${help === 1 ? "needs" : "need"} help` : "");
    this.element.classList.toggle("live", app.player.live);
  }

  private stateNow(): string {
    const { drive, player } = this.app;
    if (drive.isOver) return "The execution has ended.";
    if (!player.isFollowed) return "The log ends before all robots are done.";
    if (!this.isAnswering) return "The server no longer responds.";
    if (drive.order === "") return "Waiting for the execution to start.";
    return player.live ? "Live." : "The execution continues; this is an earlier moment.";
  }
}
