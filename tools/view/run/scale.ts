// SPDX-License-Identifier: MIT
// Scales map values to positions on an axis, and choose the values to mark.

export interface Scale {
  at(value: number): number; // position from 0 (least) to 1 (most)
  marks(most: number): number[]; // about `most` values; a logarithmic scale ignores `most`
}

export function linear(least: number, most: number): Scale {
  const span = most > least ? most - least : 1;
  return {
    at: (value) => (value - least) / span,
    marks: (count) => {
      const step = niceStep(span / Math.max(1, count));
      const marks = [];
      for (let k = Math.ceil(least / step); k * step <= least + span * (1 + 1e-9); ++k)
        marks.push(Number((k * step).toPrecision(12)));
      return marks;
    },
  };
}

// A logarithmic time scale in seconds, which starts at one millisecond or later.
export function logarithmic(least: number, most: number): Scale {
  const [from, to] = [Math.log10(Math.max(least, 1e-3)), Math.log10(Math.max(most, 2e-3))];
  const span = to > from ? to - from : 1;
  return {
    at: (value) => Math.max(0, (Math.log10(Math.max(value, 1e-3)) - from) / span),
    marks: () => {
      const marks = [];
      for (let k = Math.ceil(from); k <= to; ++k) marks.push(10 ** k);
      return marks;
    },
  };
}

// Returns the least number >= `least` that is 1, 2 or 5 times a power of ten.
function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  for (const factor of [1, 2, 5]) if (factor * power >= least) return factor * power;
  return 10 * power;
}

// Returns at most `most` of the items, evenly spread, including the first and the last.
export function thin<T>(all: readonly T[], most: number): T[] {
  if (all.length <= most) return [...all];
  const thinned = [];
  for (let i = 0; i < most; ++i)
    thinned.push(all[Math.round((i * (all.length - 1)) / (most - 1))]);
  return thinned;
}
