// SPDX-License-Identifier: MIT
// What each key does, on request.

import { el } from "../dom";

const kKeys = (unit: string): [string, string][] => [
  ["space", "play, pause"],
  ["← →", `a ${unit} back, a ${unit} on`],
  ["page up, page down", `ten ${unit}s back, ten on`],
  ["home, end", "to the beginning, to the end"],
  [", .", "slower, faster"],
  ["L", "begin again at the end, or not"],
  ["+ −", "look closer, from further away"],
  ["W A S D", "look further up, left, down, right"],
  ["0", "show everything"],
  ["/", "search for a robot or a task"],
  ["N P", "the next robot, the one before"],
  ["F", "follow the robot chosen"],
  ["Esc", "choose nothing"],
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
        "Wheel or two fingers zoom, dragging moves the map; a click chooses."),
      close);
  }

  toggle(): void {
    if (this.element.open) this.element.close();
    else this.element.showModal();
  }
}
