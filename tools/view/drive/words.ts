// SPDX-License-Identifier: MIT
// Texts of the execution page.

import type { TimeWords } from "../page/panels/controls";
import { plural } from "../page/dom";
import type { DriveApp } from "./app";
import { kDone, kStates, kWaiting, markOf, needsHelp } from "./drive";
import { dueTime, lateness } from "./late";
import type { Log } from "./log";

const kStateWords = {
  waiting: "waiting", moving: "moving", working: "at work", lifted: "lifted off", lost: "lost",
  done: "done",
};

// Returns minutes and seconds, "4:05", or from one hour on "1:00:07".
export function clockText(seconds: number): string {
  const whole = Math.floor(seconds);
  const two = (number: number) => String(number).padStart(2, "0");
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

export const kSeconds: TimeWords = {
  label: "Time in seconds",
  unit: "second",
  clock: ({ time, end }) => `${clockText(time)} / ${clockText(end)}`,
  spoken: ({ time, end }) => `${clockText(time)} of ${clockText(end)}`,
};

export function stateText(state: number): string {
  return kStateWords[kStates[state]];
}

// Returns the name of the robot for which robot `agent` waits at `time`; empty: none.
export function waitText(app: DriveApp, agent: number, time: number): string {
  const wait = app.order.wait(agent, app.drive.actionsAt(agent, time));
  if (!wait || app.drive.actionsAt(wait.agent, time) > wait.action) return "";
  return app.model.agents[wait.agent].name;
}

// Returns sign and state, such as "moving" or "… waiting for blue".
export function doingText(app: DriveApp, agent: number, time: number): string {
  const state = app.drive.stateAt(agent, time);
  const whom = state === kWaiting ? waitText(app, agent, time) : "";
  return signedText(state) + (whom === "" ? "" : ` for ${whom}`);
}

// Returns the name of a state with its sign, such as "✓ done".
export function signedText(state: number): string {
  return `${markOf(state)} ${stateText(state)}`.trim();
}

// Returns a text such as "0:07 late"; empty if the delay is less than a second.
export function lateText(seconds: number): string {
  return seconds < 1 ? "" : `${clockText(seconds)} late`;
}

// Returns a sentence with the delay of a robot and the planned end of its next or last action; empty if it has
// no actions.
export function lateSentence(app: DriveApp, agent: number, time: number): string {
  const late = lateText(lateness(app, agent, time));
  const all = app.order.actions(agent);
  if (all === 0) return "";
  const which = app.drive.actionsAt(agent, time) < all ? "next" : "last";
  return `${late === "" ? "In time" : late}: at ${app.drive.secondsPerStep} s a step, the plan ` +
    `ends its ${which} action at ${clockText(dueTime(app, agent, time))}.`;
}

export function progressText(app: DriveApp, agent: number, time: number): string {
  return `${app.drive.actionsAt(agent, time)} of ${app.order.actions(agent)}`;
}

export interface Counts {
  done: number;
  waiting: number;
  help: number;
}

export function counts(app: DriveApp, time: number): Counts {
  const all = { done: 0, waiting: 0, help: 0 };
  app.model.agents.forEach((_, agent) => {
    const state = app.drive.stateAt(agent, time);
    if (state === kDone) ++all.done;
    else if (needsHelp(state)) ++all.help;
    else if (state === kWaiting) ++all.waiting;
  });
  return all;
}

// Returns the problem with the followed log; empty: none.
export function troubleText(log: Log): string {
  if (log.skippedLines === 0) return "";
  return log.isNoDrive ? `This is not the log of an execution of this plan: ${log.firstError}`
    : `⚠ ${plural(log.skippedLines, "invalid log line")} skipped; first: ${log.firstError}`;
}
