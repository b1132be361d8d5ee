// SPDX-License-Identifier: MIT
// Links to a moment and a robot or a task: #t=37&agent=a4. A link from a live display contains no moment,
// because a live display advances by itself.

import type { Player } from "./player";
import type { PageState } from "./stage";

type Linked = PageState & { readonly player: Player & { readonly live?: boolean } };

const kSettled = 300; // milliseconds without a change, after which the address is updated

export function readLink(app: Linked, hash: string): void {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const time = Number(parameters.get("t"));
  if (parameters.has("t") && Number.isFinite(time)) app.player.go(time);
  const agent = app.model.agents.findIndex((a) => a.id === parameters.get("agent"));
  const task = app.model.tasks.findIndex((t) => t.id === parameters.get("task"));
  if (task >= 0 && agent < 0) app.chooseTask(task);
  else app.choose(agent >= 0 ? agent : app.chosen);
}

export function linkOf(app: Linked): string {
  const parameters = new URLSearchParams();
  if (!app.player.live) parameters.set("t", String(Math.round(app.player.time)));
  if (app.chosen >= 0) parameters.set("agent", app.model.agents[app.chosen].id);
  if (app.chosenTask >= 0) parameters.set("task", app.model.tasks[app.chosenTask].id);
  return "#" + parameters.toString();
}

// Applies the address now and whenever it changes. Updates it to the current state after kSettled without a
// change, and therefore not in every frame while the plan plays.
export function linkPage(app: Linked & { onChange(listener: () => void): void }): void {
  let timer = 0;
  app.onChange(() => {
    clearTimeout(timer);
    timer = window.setTimeout(() => history.replaceState(null, "", linkOf(app)), kSettled);
  });
  readLink(app, location.hash);
  addEventListener("hashchange", () => {
    if (location.hash !== linkOf(app)) readLink(app, location.hash);
  });
}
