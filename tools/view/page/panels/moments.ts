// SPDX-License-Identifier: MIT
// A list of events, each with a button that goes to its time.

import type { App } from "../app";
import { el } from "../dom";
import { momentButton } from "./rows";

const kMost = 200;

export interface Moment {
  time: number; // Infinity: never
  text: string;
}

// Creates the list. Calls `describe` only for the items that it shows.
export function moments<T>(app: App, things: T[], describe: (thing: T) => Moment): HTMLElement {
  const items = things.slice(0, kMost).map(describe).map(({ time, text }) =>
    el("li", {},
      Number.isFinite(time)
        ? momentButton(time, () => app.go(Math.max(0, time)))
        : el("span", { class: "moment bad" }, "never"),
      " ", el("span", { dir: "auto" }, text)));
  const rest = things.length - kMost;
  if (rest > 0) items.push(el("li", { class: "faint" }, `and ${rest.toLocaleString("en")} more`));
  return el("ul", { class: "moments" }, ...items);
}
