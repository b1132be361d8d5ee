// SPDX-License-Identifier: MIT
// Writes text on a canvas with a rim, usually in the colour of the floor, so that it is readable on any
// background.

import { cutInTheMiddle } from "./names";

const kLeastSqueezed = 0.75; // of the width of a text; narrower text is hard to read

// Shortens a text, measured by `widthOf`, until it fits into `width` when it is squeezed.
export function fitted(text: string, width: number, widthOf: (text: string) => number): string {
  let fits = text;
  for (let most = text.length - 1; most > 0 && kLeastSqueezed * widthOf(fits) > width; --most)
    fits = cutInTheMiddle(text, most);
  return fits;
}

// `width`: the text is squeezed to this width if it is wider.
export function outlined(
  c: CanvasRenderingContext2D, text: string, x: number, y: number, color: string, rim: string, width?: number,
): void {
  c.lineJoin = "round";
  c.lineWidth = 3;
  c.strokeStyle = rim;
  c.strokeText(text, x, y, width);
  c.fillStyle = color;
  c.fillText(text, x, y, width);
}
