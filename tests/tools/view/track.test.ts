// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { readAngle, readTrack, readTurns, stepsOnGrid } from "../../../tools/view/page/track";

const kColumns = 100;
const kPlaces = 10_000;
const steps = stepsOnGrid(kColumns);

// Returns a reproducible random generator (a linear congruential one).
function dice(seed: number): (bound: number) => number {
  let state = seed >>> 0;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

// Returns a random path as text, and its place at each step.
function randomPath(seed: number): { text: string; places: number[] } {
  const roll = dice(seed);
  const places = [5050];
  let text = "@5050;";
  for (let run = roll(30); run > 0; --run) {
    const letter = "ENSW.@"[roll(6)];
    const count = 1 + roll(4);
    let place = places[places.length - 1];
    if (letter === "@") {
      place = roll(kPlaces);
      text += `@${place};`;
      places.push(place);
      continue;
    }
    if (place + 4 * steps.get(letter)! < 0 || place + 4 * steps.get(letter)! >= kPlaces) continue;
    text += count === 1 ? letter : `${count}${letter}`;
    for (let k = 0; k < count; ++k) places.push((place += steps.get(letter)!));
  }
  return { text, places };
}

test("a track has the places of its text", () => {
  for (let seed = 0; seed < 500; ++seed) {
    const { text, places } = randomPath(seed);
    const track = readTrack(text, steps, kPlaces);
    assert.equal(track.end, places.length - 1);
    for (let time = -1; time < places.length + 3; ++time) {
      const expected = places[Math.min(Math.max(time, 0), places.length - 1)];
      assert.equal(track.place(time), expected, `${text} at ${time}`);
      assert.equal(track.place(time, track.run(Math.max(0, time - 1))), expected);
    }
  }
});

test("the first time on a place is found", () => {
  for (let seed = 0; seed < 300; ++seed) {
    const { text, places } = randomPath(seed);
    const track = readTrack(text, steps, kPlaces);
    for (const place of [...places, 17])
      for (const begin of [0, 1, places.length >> 1, places.length - 1, places.length, places.length + 5]) {
        let expected = places.findIndex((p, time) => p === place && time >= begin);
        if (expected < 0) expected = places[places.length - 1] === place ? begin : Infinity;
        assert.equal(track.firstTimeOn(place, begin), expected, `${text}: ${place} from ${begin} on`);
      }
  }
});

test("an empty text is an empty path", () => {
  assert.equal(readTrack("", steps, kPlaces).isEmpty, true);
});

test("wrong paths are refused", () => {
  for (const text of ["E", "@1", "@;", "@-1;", "@10000;", "@1;X", "@1;3", "@1;2@2;", "@0;N", "@1.5;",
    "@1;99999999999E", "@1;20000000.", "@1;e", "@1; E", "@9999;E", "@1;0E", "@1;00."])
    assert.throws(() => readTrack(text, steps, kPlaces), Error, text);
});

test("turns have angle and direction at each time", () => {
  const turns = readTurns("@0;r.2r3.2l", 3); // to E with a pause at 1, then part of a turn and back
  const angles = [0, 1, 1, 2, 3, 3, 3, 3, 2, 1];
  const directions = [0, 1, 1, 1, 0, 0, 0, 0, -1, -1];
  angles.forEach((steps_, time) =>
    assert.deepEqual(turns.at(time), { steps: steps_, direction: directions[time] }, `at ${time}`));
  assert.deepEqual(turns.at(50), { steps: 1, direction: -1 });
  assert.equal(turns.angle(0.5), 0.5);
});

test("turns may go round", () => {
  const turns = readTurns("@0;2l", 1);
  assert.deepEqual(turns.at(1), { steps: 3, direction: 0 });
  assert.deepEqual(turns.at(2), { steps: 2, direction: 0 });
  assert.equal(turns.angle(2), -2);
});

test("turns may begin within a turn", () => {
  const turns = readTurns("@1r;.r", 2);
  assert.deepEqual(turns.at(0), { steps: 1, direction: 1 });
  assert.deepEqual(turns.at(1), { steps: 1, direction: 1 });
  assert.deepEqual(turns.at(2), { steps: 2, direction: 0 });
});

test("wrong angles are refused", () => {
  for (const text of ["", "x", "-1", "4", "1", "0r", "1x", "r"])
    assert.throws(() => readAngle(text, text === "4" ? 1 : 2), Error, text);
});
