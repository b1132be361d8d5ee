// SPDX-License-Identifier: MIT
// A list of moments to jump to, each with what happens then.

import type { App } from "../app";
import { el, plural } from "../dom";
import { momentButton } from "./rows";

const kMost = 200;

export interface Moment {
  time: number; // Infinity: never
  text: string;
  go?: number; // where to jump to, if not to `time`
}

export function moments(app: App, rows: Moment[]): HTMLElement {
  const items = rows.slice(0, kMost).map(({ time, text, go }) =>
    el("li", {},
      Number.isFinite(time)
        ? momentButton(time, () => app.go(Math.max(0, go ?? time))) : el("span", { class: "moment bad" }, "never"),
      " ", el("span", { dir: "auto" }, text)));
  const rest = rows.length - kMost;
  if (rest > 0) items.push(el("li", { class: "faint" }, `and ${plural(rest, "more")}`));
  return el("ul", { class: "moments" }, ...items);
}
