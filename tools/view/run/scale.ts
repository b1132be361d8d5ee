// SPDX-License-Identifier: MIT
// Scales: values to positions on a chart, and values for marks.

export interface Scale {
  at(value: number): number; // 0 .. 1
  marks(most: number): number[];
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

// Begins at one millisecond.
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

// The least number >= the argument that is 1, 2 or 5 times a power of ten.
function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  for (const factor of [1, 2, 5]) if (factor * power >= least) return factor * power;
  return 10 * power;
}

// Returns at most `count` of the items, evenly spread, with the first and the last.
export function thin<T>(all: readonly T[], most: number): T[] {
  if (all.length <= most) return [...all];
  const thinned = [];
  for (let i = 0; i < most; ++i)
    thinned.push(all[Math.round((i * (all.length - 1)) / (most - 1))]);
  return thinned;
}
