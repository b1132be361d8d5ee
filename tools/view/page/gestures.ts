// SPDX-License-Identifier: MIT
// Converts wheel, drag, pinch and click on a view to camera movements and clicks.

import type { Camera } from "./camera";

export interface GestureListener {
  moved(): void; // the camera has moved
  clicked(x: number, y: number): void; // in pixels of the view
}

const kClickSlack = 4; // pixels that the pointer may move during a click

export function listen(view: HTMLElement, camera: Camera, listener: GestureListener): void {
  const fingers = new Map<number, { x: number; y: number }>();
  let slipped = 0;

  const at = (event: MouseEvent) => {
    const box = view.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { length: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };

  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    const { x, y } = at(event);
    camera.zoom(Math.exp(-Math.max(-60, Math.min(60, event.deltaY)) * 0.006), x, y);
    listener.moved();
  }, { passive: false });

  view.addEventListener("pointerdown", (event) => {
    view.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    if (fingers.size === 1) slipped = 0;
  });
  view.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    const old = fingers.size === 2 ? spread() : null;
    fingers.set(event.pointerId, now);
    if (old) {
      const wide = spread();
      camera.pan(wide.x - old.x, wide.y - old.y);
      if (old.length > 0) camera.zoom(wide.length / old.length, wide.x, wide.y);
      slipped = Infinity;
    } else if (fingers.size === 1) {
      slipped += Math.hypot(now.x - before.x, now.y - before.y);
      if (slipped > kClickSlack) camera.pan(now.x - before.x, now.y - before.y);
    }
    listener.moved();
  });
  const lift = (event: PointerEvent) => {
    if (!fingers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && slipped <= kClickSlack && fingers.size === 0) {
      const { x, y } = at(event);
      listener.clicked(x, y);
    }
  };
  view.addEventListener("pointerup", lift);
  view.addEventListener("pointercancel", lift);
}
