// SPDX-License-Identifier: MIT
// Paths and turns, stored as runs of equal steps instead of one number per time.

import type { Angle } from "./model";

// A path. In run i, each step from times[i] to times[i + 1] adds deltas[i] to the place. If jumps[i] is 1,
// the run is a single step to places[i + 1], which need not be possible in the world.
export class Track {
  constructor(
    readonly times: Int32Array, // start of each run, then the end of the last one
    readonly places: Int32Array, // place at each of `times`
    readonly deltas: Int32Array, // by run: change of place per step
    readonly jumps: Uint8Array,
  ) {}

  // Whether the plan has no path for the agent.
  get isEmpty(): boolean {
    return this.times.length === 0;
  }
  // The last time of the path. From then on the agent stays.
  get end(): number {
    return this.isEmpty ? 0 : this.times[this.times.length - 1];
  }
  get runs(): number {
    return this.deltas.length;
  }

  // Returns the run of the step from `time` to `time` + 1, or the number of runs if the path has ended.
  // Searches from run `near`.
  run(time: number, near = 0): number {
    const times = this.times;
    let low = near < this.runs && times[near] <= time ? near : 0;
    if (low + 1 <= this.runs && time < times[low + 1]) return low;
    // Successive calls usually proceed from one run to the next.
    if (low + 2 <= this.runs && time < times[low + 2]) return low + 1;
    let high = this.runs;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  // Returns the start and the place after each move, in order, without waits.
  visited(): number[] {
    const all: number[] = [];
    if (!this.isEmpty) all.push(this.places[0]);
    for (let run = 0; run < this.runs; ++run) {
      if (this.deltas[run] === 0) continue;
      const steps = this.times[run + 1] - this.times[run];
      for (let k = 1; k <= steps; ++k) all.push(this.places[run] + k * this.deltas[run]);
    }
    return all;
  }

  // Returns the first time from `begin` on at which the agent is on `place`; Infinity: never.
  firstTimeOn(place: number, begin: number): number {
    if (this.isEmpty) return Infinity;
    for (let run = this.run(begin); run < this.runs; ++run) {
      const least = Math.max(begin, this.times[run]);
      const [ahead, delta] = [place - this.places[run], this.deltas[run]];
      if (delta === 0 ? ahead !== 0 : ahead % delta !== 0) continue;
      const time = delta === 0 ? least : this.times[run] + ahead / delta;
      if (time >= least && time <= this.times[run + 1]) return time;
    }
    return place === this.places[this.runs] ? Math.max(begin, this.end) : Infinity;
  }

  place(time: number, near = 0): number {
    if (time >= this.end) return this.places[this.runs];
    if (time <= 0) return this.places[0];
    const run = this.run(time, near);
    return this.places[run] + this.deltas[run] * (time - this.times[run]);
  }
}

// The angle, over time, of an agent that needs time to turn. Stored as runs, as in Track.
export class TurnTrack {
  constructor(
    readonly times: Int32Array,
    readonly angles: Int32Array, // at `times`; not reduced modulo 4 turnSteps, so that a turn is monotonic
    readonly deltas: Int8Array,
    readonly directions: Int8Array, // at `times`: see Angle
    readonly jumps: Uint8Array,
    readonly turnSteps: number,
  ) {}

  get end(): number {
    return this.times.length === 0 ? 0 : this.times[this.times.length - 1];
  }
  get runs(): number {
    return this.deltas.length;
  }

  run(time: number): number {
    let low = 0;
    let high = this.runs;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  // Returns the angle for drawing, as in `angles`. `time` need not be whole.
  angle(time: number): number {
    if (time >= this.end) return this.angles[this.runs];
    const run = this.run(Math.floor(time));
    if (this.jumps[run]) return this.angles[run];
    return this.angles[run] + this.deltas[run] * (time - this.times[run]);
  }

  // Returns the angle at a whole step, from 0 to 4 turnSteps - 1.
  heading(time: number): number {
    const around = 4 * this.turnSteps;
    return ((this.angle(time) % around) + around) % around;
  }

  at(moment: number): Angle {
    const time = Math.min(moment, this.end);
    const steps = this.heading(time);
    if (steps % this.turnSteps === 0) return { steps, direction: 0 };
    const run = this.run(time);
    const within = time > this.times[run] && this.deltas[run] !== 0;
    return { steps, direction: within ? this.deltas[run] : this.directions[run] };
  }
}

interface Step {
  letter: string;
  count: number;
  jump: string;
}

const kMostSteps = 1 << 24;

// Parses runs of steps, such as "12E.@17;3N" (README.md).
function* stepsOf(text: string, letters: string): Generator<Step> {
  let count = 0;
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (c >= "0" && c <= "9") {
      count = 10 * count + (c.charCodeAt(0) - 48);
      if (count > kMostSteps) throw new Error("a path is longer than 16 million steps");
    } else if (c === "@" && count === 0) {
      const end = text.indexOf(";", i);
      if (end < 0) throw new Error(`a path ends within '${text.slice(i, i + 12)}'`);
      yield { letter: "@", count: 1, jump: text.slice(i + 1, end) };
      i = end;
    } else if (letters.includes(c)) {
      if (count === 0 && text[i - 1] === "0") throw new Error(`'0${c}' has the count 0`);
      yield { letter: c, count: count === 0 ? 1 : count, jump: "" };
      count = 0;
    } else {
      throw new Error(`a path contains '${c}', which is no step`);
    }
  }
  if (count !== 0) throw new Error("a path ends with a number");
}

// Each function returns, for each letter of a path, the number that a step adds to the place.
export function stepsOnGrid(columns: number): Map<string, number> {
  return new Map([["E", 1], ["W", -1], ["S", columns], ["N", -columns], [".", 0]]);
}
export function stepsOnRoads(): Map<string, number> {
  return new Map([["+", 1], ["-", -1], [".", 0]]);
}

class Runs {
  times: number[] = [];
  values: number[] = [];
  deltas: number[] = [];
  jumps: number[] = [];
  time = 0;
  value = 0;

  add(delta: number, count: number, jump: boolean): void {
    this.times.push(this.time);
    this.values.push(this.value);
    this.deltas.push(delta);
    this.jumps.push(jump ? 1 : 0);
    this.time += count;
    this.value += delta * count;
    if (this.time > kMostSteps) throw new Error("a path is longer than 16 million steps");
  }
  close(): void {
    this.times.push(this.time);
    this.values.push(this.value);
  }
}

function number(text: string, least: number, bound: number): number {
  const value = /^[0-9]{1,10}$/.test(text) ? Number(text) : NaN;
  if (!(value >= least && value < bound))
    throw new Error(`a path is on '${text}', which is no place`);
  return value;
}

export function readTrack(text: string, steps: Map<string, number>, places: number): Track {
  const runs = new Runs();
  let begun = false;
  for (const step of stepsOf(text, [...steps.keys()].join(""))) {
    if (step.letter === "@") {
      const to = number(step.jump, 0, places);
      if (begun) runs.add(to - runs.value, 1, to !== runs.value);
      else runs.value = to;
    } else {
      if (!begun) throw new Error("a path does not say where it begins");
      runs.add(steps.get(step.letter)!, step.count, false);
      if (runs.value < 0 || runs.value >= places) throw new Error("a path leaves the world");
    }
    begun = true;
  }
  if (begun) runs.close();
  return new Track(
    Int32Array.from(runs.times),
    Int32Array.from(runs.values),
    Int32Array.from(runs.deltas),
    Uint8Array.from(runs.jumps),
  );
}

// Parses an angle: "3", or "3r" or "3l" within a turn.
export function readAngle(text: string, turnSteps: number): Angle {
  const match = /^([0-9]{1,7})([rl]?)$/.exec(text);
  const steps = match ? Number(match[1]) : NaN;
  if (!match || !(steps < 4 * turnSteps)) throw new Error(`'${text}' is not a valid angle`);
  const direction = match[2] === "r" ? 1 : match[2] === "l" ? -1 : 0;
  if ((direction === 0) !== (steps % turnSteps === 0)) throw new Error(`'${text}' is not a valid angle`);
  return { steps, direction };
}

export function readTurns(text: string, turnSteps: number): TurnTrack {
  const runs = new Runs();
  const directions: number[] = [];
  let begun = false;
  let direction = 0;
  for (const step of stepsOf(text, "rl.")) {
    if (step.letter === "@") {
      const angle = readAngle(step.jump, turnSteps);
      if (begun) {
        directions.push(direction);
        runs.add(angle.steps - runs.value, 1, true);
      } else {
        runs.value = angle.steps;
      }
      direction = angle.direction;
    } else {
      if (!begun) throw new Error("turns do not say where they begin");
      directions.push(direction);
      const delta = step.letter === "r" ? 1 : step.letter === "l" ? -1 : 0;
      runs.add(delta, step.count, false);
      if (delta !== 0) direction = runs.value % turnSteps === 0 ? 0 : delta;
    }
    begun = true;
  }
  if (begun) {
    directions.push(direction);
    runs.close();
  }
  return new TurnTrack(
    Int32Array.from(runs.times),
    Int32Array.from(runs.values),
    Int8Array.from(runs.deltas.map((d, i) => (runs.jumps[i] ? 0 : d))),
    Int8Array.from(directions),
    Uint8Array.from(runs.jumps),
    turnSteps,
  );
}
