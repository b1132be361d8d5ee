// SPDX-License-Identifier: MIT
// Delay of a robot relative to the plan: the time since its next action should have ended if each step of the
// plan took `seconds_per_step` of the drive log. For a robot that has completed all actions, it is the delay
// of its last action.

import type { DriveApp } from "./app";

// Returns the planned end of the next action or, after all actions, of the last one, in seconds of the
// execution.
export function dueTime({ drive, order }: DriveApp, agent: number, time: number): number {
  const next = Math.min(drive.actionsAt(agent, time) + 1, order.actions(agent));
  return order.planTime(agent, next) * drive.secondsPerStep;
}

// Returns the delay in seconds; 0 if the robot is in time.
export function lateness(app: DriveApp, agent: number, time: number): number {
  const { drive, order } = app;
  const all = order.actions(agent);
  const until = drive.actionsAt(agent, time) < all ? time : app.visitTime(agent, all - 1);
  return Math.max(0, until - dueTime(app, agent, time));
}

export function mostLate(app: DriveApp, time: number): number {
  return app.model.agents.reduce((most, _, agent) => Math.max(most, lateness(app, agent, time)), 0);
}
