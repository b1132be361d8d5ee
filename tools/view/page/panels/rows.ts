// SPDX-License-Identifier: MIT
// A row of a list: a button with a text and, at its end, a note that depends on the time shown.

import { el } from "../dom";

export const kMostRows = 300;

export interface Row {
  key: string; // lower-case text that the search field matches
  text: string;
  note: () => string;
  act: () => void;
  bad?: boolean;
  more?: HTMLElement; // element beside the button
}

export function rowElement(row: Row): { element: HTMLElement; note: HTMLElement } {
  const note = el("span", { class: "faint note" });
  const kind = row.bad ? "row bad" : "row";
  const button = el("button", { type: "button", class: kind, click: row.act },
    el("span", { dir: "auto" }, row.text), note);
  const element = row.more ? el("div", { class: "pair" }, button, row.more) : button;
  return { element, note };
}

// Creates a button that goes to a time.
export function momentButton(
  time: number | string, act: () => void, title = `Go to step ${time}`,
): HTMLElement {
  return el("button", { type: "button", class: "moment", title, click: act }, String(time));
}
