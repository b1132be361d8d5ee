// SPDX-License-Identifier: MIT
// Keyboard control of the plan page and the execution page.

import type { Camera } from "./camera";
import type { Help } from "./panels/help";
import type { Player } from "./player";
import type { PageState } from "./stage";

export interface Keys {
  app: PageState & { readonly player: Player; changed(): void };
  cameras: Camera[];
  search: HTMLElement;
  help: Help;
}

export function listenToKeys({ app, cameras, search, help }: Keys): void {
  const zoom = (factor: number) => {
    for (const camera of cameras) camera.zoom(factor, camera.width / 2, camera.height / 2);
  };
  const pan = (dx: number, dy: number) => {
    app.following = false;
    for (const camera of cameras) camera.pan(dx * 80, dy * 80);
  };
  const { player } = app;
  const next = (by: number) => {
    const count = app.model.agents.length;
    if (count > 0) app.choose((Math.max(app.chosen, by > 0 ? -1 : 0) + by + count) % count);
  };
  const acts: Record<string, () => void> = {
    " ": () => player.toggle(),
    ArrowRight: () => player.step(1),
    ArrowLeft: () => player.step(-1),
    PageDown: () => player.step(10),
    PageUp: () => player.step(-10),
    Home: () => player.go(0),
    End: () => player.go(player.end),
    ".": () => player.faster(1),
    ",": () => player.faster(-1),
    l: () => (player.loop = !player.loop),
    "+": () => zoom(1.25),
    "=": () => zoom(1.25),
    "-": () => zoom(0.8),
    w: () => pan(0, 1),
    s: () => pan(0, -1),
    a: () => pan(1, 0),
    d: () => pan(-1, 0),
    "0": () => {
      app.following = false;
      for (const camera of cameras) camera.fit();
    },
    f: () => (app.following = app.chosen >= 0 && !app.following),
    n: () => next(1),
    p: () => next(-1),
    Escape: () => app.choose(-1),
    "/": () => search.focus(),
    "?": () => help.toggle(),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    if (help.element.open && event.key !== "?") return;
    if (target instanceof HTMLInputElement && target.type === "search") return;
    if (target instanceof HTMLSelectElement) return;
    if (target instanceof HTMLButtonElement && (event.key === " " || event.key === "Enter")) return;
    const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act();
    app.changed();
  });
}
