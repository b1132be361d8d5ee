// SPDX-License-Identifier: MIT
// How late robots are against the plan: by how much their next action should have ended before, if
// each of the plan's steps took as long as the drive's log says; of one that is done, the last one.

import type { DriveApp } from "./app";

// When the plan has the action end that counts, in seconds of the drive.
export function dueTime({ drive, order }: DriveApp, agent: number, time: number): number {
  const next = Math.min(drive.actionsAt(agent, time) + 1, order.actions(agent));
  return order.planTime(agent, next) * drive.secondsPerStep;
}

// In seconds; 0: in time.
export function lateness(app: DriveApp, agent: number, time: number): number {
  const { drive, order } = app;
  const all = order.actions(agent);
  const until = drive.actionsAt(agent, time) < all ? time : app.visitTime(agent, all - 1);
  return Math.max(0, until - dueTime(app, agent, time));
}

export function mostLate(app: DriveApp, time: number): number {
  return app.model.agents.reduce((most, _, agent) => Math.max(most, lateness(app, agent, time)), 0);
}
