// SPDX-License-Identifier: MIT
// Ids as displayed: whatever an id contains, it stays on one line and does not affect the text around it.

const kLongest = 60;
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;
const kRightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;

// Invisible characters, and those that change the direction of text, are shown as boxes. Names written
// from right to left do not reorder the sentence around them.
export function nameOf(id: string): string {
  const plain = id.replace(kUnseen, "▯");
  const cut = shortened(plain, kLongest);
  if (cut === "") return "(no name)";
  return kRightToLeft.test(cut) ? `\u2068${cut}\u2069` : cut;
}

// Labels for robots, where space is small: a beginning that all names share is removed.
export function labelsOf(names: string[], most: number): string[] {
  const common = names.every((name) => name.length <= most) ? "" : commonBeginning(names);
  return names.map((name) => shortened(name.slice(common.length), most));
}

// The shared beginning in whole words, up to a number or a separator: "robot-" of robot-17 and robot-170.
function commonBeginning(names: string[]): string {
  if (names.length < 2) return "";
  let common = names[0];
  for (const name of names)
    while (!name.startsWith(common) || name === common) common = common.slice(0, -1);
  common = common.replace(/[0-9]+$/, "");
  if (names.every((name) => /^[0-9]/.test(name.slice(common.length)))) return common;
  return common.replace(/[\p{L}\p{N}]+$/u, "");
}

// Cuts between characters, not within surrogate pairs.
export function shortened(text: string, most: number): string {
  if (text.length <= most) return text;
  return `${[...text.slice(0, 2 * most)].slice(0, most - 1).join("")}…`;
}
