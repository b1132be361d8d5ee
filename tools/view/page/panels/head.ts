// SPDX-License-Identifier: MIT
// Heading of the details: the name of the selected object, and a button to clear the selection.

import { el, setText } from "../dom";
import type { PageState } from "../stage";

export function head(app: Pick<PageState, "choose">, title: string, ...buttons: HTMLElement[]): HTMLElement {
  const close = el("button", {
    type: "button", "aria-label": "Clear selection", title: "Clear selection (Esc)",
    click: () => app.choose(-1),
  }, "✕");
  const heading = el("h2", { dir: "auto" });
  setText(heading, title);
  return el("div", { class: "head" }, heading, ...buttons, close);
}
