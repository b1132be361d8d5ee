// SPDX-License-Identifier: MIT
// An id as it is shown: whatever it holds, it stays on its line, in its place and within measure.

const kLongest = 60;
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;
const kRightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;

// Characters that nobody sees, and those that turn the text around them, are shown as boxes; names
// written from right to left do not reorder the sentence they are in.
export function nameOf(id: string): string {
  const plain = id.replace(kUnseen, "▯");
  const cut = shortened(plain, kLongest);
  if (cut === "") return "(no name)";
  return kRightToLeft.test(cut) ? `\u2068${cut}\u2069` : cut;
}

// By characters, not by their halves.
export function shortened(text: string, most: number): string {
  if (text.length <= most) return text;
  return `${[...text.slice(0, 2 * most)].slice(0, most - 1).join("")}…`;
}
