// SPDX-License-Identifier: MIT
// State of the page: the execution (Drive), the moment shown, and the selection.

import type { TaskFacts } from "../page/facts";
import type { Model } from "../page/model";
import type { PageState } from "../page/stage";
import type { Drive } from "./drive";
import type { Order } from "./order";
import { DrivePlayer } from "./player";

export class DriveApp implements PageState {
  readonly player: DrivePlayer;
  readonly tasks: TaskFacts[]; // times in seconds of the execution
  chosen = -1;
  chosenTask = -1;
  following = false;
  labels = true;
  private readonly listeners: (() => void)[] = [];

  constructor(
    readonly model: Model, readonly order: Order, public drive: Drive,
    isFollowed: boolean, // whether the log may still grow
  ) {
    this.player = new DrivePlayer(isFollowed);
    this.tasks = model.tasks.map(({ agents }) => ({ agents, times: [], begin: Infinity }));
    this.setDrive(drive);
  }

  // Replaces the data of the execution, after the log has grown or was replaced.
  setDrive(drive: Drive): void {
    this.drive = drive;
    this.player.end = drive.end;
    for (const task of this.tasks) {
      task.times = [];
      task.begin = Infinity;
    }
    this.model.agents.forEach((_, agent) => {
      for (const { task, action } of this.order.visits(agent)) {
        const time = this.visitTime(agent, action);
        if (time < Infinity) this.tasks[task].times.push(time);
      }
    });
    for (const task of this.tasks) {
      task.times.sort((a, b) => a - b);
      task.begin = task.times[0] ?? Infinity;
    }
    this.changed();
  }

  // Returns the time at which the robot completed an action (-1: the start, at time 0), in seconds; Infinity
  // if the log does not contain it yet.
  visitTime(agent: number, action: number): number {
    return action < 0 ? 0 : this.drive.completedAt[agent][action] ?? Infinity;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  choose(agent: number): void {
    this.chosen = agent;
    this.chosenTask = -1;
    if (agent < 0) this.following = false;
    this.changed();
  }

  chooseTask(task: number): void {
    this.chosenTask = task;
    this.chosen = -1;
    this.following = false;
    this.changed();
  }

  go(time: number): void {
    this.player.go(time);
    this.changed();
  }
}
