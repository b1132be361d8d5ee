// SPDX-License-Identifier: MIT
// Writes text on a canvas with a rim, usually in the colour of the floor, so that it is readable on any
// background.

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
