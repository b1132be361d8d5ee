// SPDX-License-Identifier: MIT
// Dialog that lists all keys and their meanings.

import { el } from "../dom";

const kKeys = (unit: string): [string, string][] => [
  ["space", "play, pause"],
  ["← →", `one ${unit} back, one ${unit} forward`],
  ["page up, page down", `ten ${unit}s back, ten ${unit}s forward`],
  ["home, end", "to the beginning, to the end"],
  [", .", "slower, faster"],
  ["L", "loop on or off"],
  ["+ −", "zoom in, zoom out"],
  ["W A S D", "move the view up, left, down, right"],
  ["0", "show the whole map"],
  ["/", "search for a robot or a task"],
  ["N P", "next robot, previous robot"],
  ["F", "keep the selected robot in the middle"],
  ["Esc", "clear the selection"],
  ["?", "this list"],
];

export class Help {
  readonly element: HTMLDialogElement;

  constructor(unit: string) {
    const rows = kKeys(unit).map(([keys, what]) =>
      el("tr", {}, el("th", { scope: "row" }, keys), el("td", {}, what)));
    const close = el("button", { type: "button", click: () => this.element.close() }, "Close");
    this.element = el("dialog", { "aria-label": "Keys" }, el("h2", {}, "Keys"),
      el("table", {}, el("tbody", {}, ...rows)),
      el("p", { class: "faint" },
        "Zoom with the wheel or two fingers, drag to move the map, click to select."),
      close);
  }

  toggle(): void {
    if (this.element.open) this.element.close();
    else this.element.showModal();
  }
}
