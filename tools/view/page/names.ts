// SPDX-License-Identifier: MIT
// Makes ids displayable: whatever an id contains, it stays on one line and does not affect the text around
// it.

const kLongest = 60;
const kMostListed = 20;
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;
const kRightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;

// Returns the displayed name of an id. Replaces invisible characters, and those that change the direction of
// text, by boxes. Isolates names in right-to-left scripts, so that they do not reorder the sentence around
// them.
export function nameOf(id: string): string {
  const plain = id.replace(kUnseen, "▯");
  const cut = shortened(plain, kLongest);
  if (cut === "") return "(no name)";
  return kRightToLeft.test(cut) ? `\u2068${cut}\u2069` : cut;
}

// Returns labels of at most `most` characters, for places with little space. If a name is longer, removes the
// beginning that all names share.
export function labelsOf(names: string[], most: number): string[] {
  const common = names.every((name) => name.length <= most) ? "" : commonBeginning(names);
  return names.map((name) => shortened(name.slice(common.length), most));
}

// Returns the shared beginning of all names up to a separator or a number, such as "robot-" of robot-17 and
// robot-170.
function commonBeginning(names: string[]): string {
  if (names.length < 2) return "";
  let common = names[0];
  for (const name of names)
    while (!name.startsWith(common) || name === common) common = common.slice(0, -1);
  common = common.replace(/[0-9]+$/, "");
  if (names.every((name) => /^[0-9]/.test(name.slice(common.length)))) return common;
  return common.replace(/[\p{L}\p{N}]+$/u, "");
}

// Cuts a text that is longer than `most`, without splitting a surrogate pair, and appends an ellipsis.
export function shortened(text: string, most: number): string {
  if (text.length <= most) return text;
  return `${[...text.slice(0, 2 * most)].slice(0, most - 1).join("")}…`;
}

// Cuts a text that is longer than `most` in the middle, because ids often differ at the end.
export function cutInTheMiddle(text: string, most: number): string {
  if (text.length <= most) return text;
  const letters = [...text];
  const end = Math.min(letters.length, (most - 1) >> 1);
  const begin = Math.max(0, most - 1 - end);
  return `${letters.slice(0, begin).join("")}…${letters.slice(letters.length - end).join("")}`;
}

// Returns the first names with commas between them, and the number of the others.
export function listed(names: string[]): string {
  const rest = names.length - kMostListed;
  const first = names.slice(0, kMostListed).join(", ");
  return rest > 0 ? `${first} and ${rest.toLocaleString("en")} more` : first;
}
