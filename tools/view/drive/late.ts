// SPDX-License-Identifier: MIT
// Delay of robots relative to the plan: the time since the next action should have ended, if each step of
// the plan took the time that the log of the drive states. For a robot that is done: the delay of its
// last action.

import type { DriveApp } from "./app";

// Planned end of this action, in seconds of the drive.
export function dueTime({ drive, order }: DriveApp, agent: number, time: number): number {
  const next = Math.min(drive.actionsAt(agent, time) + 1, order.actions(agent));
  return order.planTime(agent, next) * drive.secondsPerStep;
}

// Delay in seconds; 0: in time.
export function lateness(app: DriveApp, agent: number, time: number): number {
  const { drive, order } = app;
  const all = order.actions(agent);
  const until = drive.actionsAt(agent, time) < all ? time : app.visitTime(agent, all - 1);
  return Math.max(0, until - dueTime(app, agent, time));
}

export function mostLate(app: DriveApp, time: number): number {
  return app.model.agents.reduce((most, _, agent) => Math.max(most, lateness(app, agent, time)), 0);
}
