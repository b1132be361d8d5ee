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

// What to put on robots, where there is little room: names that all begin alike lose that
// beginning.
export function labelsOf(names: string[], most: number): string[] {
  const common = names.every((name) => name.length <= most) ? "" : commonBeginning(names);
  return names.map((name) => shortened(name.slice(common.length), most));
}

// Whole words of it: up to a number, or to what parts words. "robot-" of robot-17 and robot-170.
function commonBeginning(names: string[]): string {
  if (names.length < 2) return "";
  let common = names[0];
  for (const name of names)
    while (!name.startsWith(common) || name === common) common = common.slice(0, -1);
  common = common.replace(/[0-9]+$/, "");
  if (names.every((name) => /^[0-9]/.test(name.slice(common.length)))) return common;
  return common.replace(/[\p{L}\p{N}]+$/u, "");
}

// By characters, not by their halves.
export function shortened(text: string, most: number): string {
  if (text.length <= most) return text;
  return `${[...text.slice(0, 2 * most)].slice(0, most - 1).join("")}…`;
}
