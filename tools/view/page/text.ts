// SPDX-License-Identifier: MIT
// Text on a canvas that is readable on any background: it has a rim in the colour of the floor.

export function outlined(
  c: CanvasRenderingContext2D, text: string, x: number, y: number, color: string, rim: string,
): void {
  c.lineJoin = "round";
  c.lineWidth = 3;
  c.strokeStyle = rim;
  c.strokeText(text, x, y);
  c.fillStyle = color;
  c.fillText(text, x, y);
}
