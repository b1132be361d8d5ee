// SPDX-License-Identifier: MIT
// Tests the columns and the log of a drive, and robot positions between two observations.

import assert from "node:assert/strict";
import { test } from "node:test";
import { DriveApp } from "../../../tools/view/drive/app";
import { readDrive } from "../../../tools/view/drive/columns";
import { Drive, kStates, Observations } from "../../../tools/view/drive/drive";
import { lateness, mostLate } from "../../../tools/view/drive/late";
import { Log } from "../../../tools/view/drive/log";
import { DriveNow } from "../../../tools/view/drive/now";
import { Order } from "../../../tools/view/drive/order";
import { DrivePlayer } from "../../../tools/view/drive/player";
import { clockText, doingText, lateSentence, troubleText } from "../../../tools/view/drive/words";
import { readModel } from "../../../tools/view/page/read";

const kModel = JSON.stringify({
  format: "grove view 1", instance: "i", world: { kind: "grid", width: 5, height: 2, free: "10" },
  agents: [{ id: "a", start: 0 }, { id: "b", start: 5 }],
  tasks: [{ id: "t", place: 2, agents: [0] }, { id: "u", place: 0, agents: [0] }],
  plans: [{ name: "p", claims: {}, agents: [
    { cost: 3, path: "@0;3E", tasks: [1, 0] }, { cost: 2, path: "@5;2E", tasks: [] }] }],
});
const kOrder = JSON.stringify({ robots: [
  { ends: [1, 2, 3], waits: [[1, 1, 0]], visits: [[-1, 1], [1, 0]] }, { ends: [1, 2], waits: [], visits: [] }] });
const kHeader = { format: "grove drive 1", order: "o.json", robots: ["a", "b"], seconds_per_step: 1 };

function line(t: number, robot: string, at: [number, number], action: number, state: string, angle?: number) {
  return { t, robot, at, ...(angle === undefined ? {} : { angle }), action, state };
}

function log(...events: object[]): string {
  return events.map((event) => JSON.stringify(event) + "\n").join("");
}

function follow(text: string): Log {
  const model = readModel(kModel);
  const one = new Log(model, Order.read(kOrder, model));
  one.add(text);
  return one;
}

function read(...events: object[]) {
  const model = readModel(kModel);
  const { drive, firstError } = follow(log(kHeader, ...events));
  assert.equal(firstError, "");
  return { model, order: Order.read(kOrder, model), drive };
}

function dice(seed = 1): (below: number) => number {
  let state = seed;
  return (below) => (state = (state * 48271) % 2147483647) % below;
}

test("the last observation is found for times in any order", () => {
  const observations = new Observations();
  const times: number[] = [];
  let time = 0;
  const draw = dice();
  for (let i = 0; i < 500; ++i) {
    observations.add(time, 0, 0, NaN, 0, 0);
    times.push(time);
    time += draw(3);
  }
  for (let i = 0; i < 3000; ++i) {
    const at = i % 3 === 0 ? draw(Math.ceil(time) + 2) : (i % 700) / 2;
    let last = 0;
    times.forEach((t, k) => { if (t <= at) last = k; });
    assert.equal(observations.at(at), last);
  }
});

test("moving robots go straight, standing robots wait", () => {
  const { model, drive } = read(
    line(0, "a", [0, 0], 0, "moving", 350), line(4, "a", [2, 0], 0, "waiting", 10),
    line(9, "a", [3, 0], 1, "done"));
  const now = new DriveNow(model, drive);
  const at = (time: number) => {
    now.update(time);
    return [now.xs[0], now.ys[0]].map((value) => Number(value.toFixed(3)));
  };
  assert.deepEqual(at(0), [0.5, 0.5]);
  assert.deepEqual(at(1), [1, 0.5]);
  assert.ok(Math.abs((now.angles[0] * 180) / Math.PI - 355) < 0.01); // the shorter way round
  assert.deepEqual(at(4), [2.5, 0.5]);
  assert.deepEqual(at(8.5), [2.5, 0.5]);
  assert.deepEqual(at(8.925), [3, 0.5]);
  assert.deepEqual(at(100), [3.5, 0.5]);
  assert.deepEqual([now.xs[1], now.ys[1]], [0.5, 1.5]); // not observed yet, so at its start
});

test("of lines with one time the last one counts", () => {
  const draw = dice();
  for (let round = 0; round < 200; ++round) {
    const events: { t: number; x: number }[] = [];
    let t = draw(3);
    for (let i = 0; i < 8; ++i) {
      events.push({ t, x: i % 5 });
      t += draw(3); // 0, 1 or 2 seconds after the previous event
    }
    const { model, drive } = read(...events.map((e) => line(e.t, "a", [e.x, 0], 0, "moving")));
    const now = new DriveNow(model, drive);
    for (let time = 0; time <= t + 1; time += 0.25) {
      now.update(time);
      const before = events.filter((e) => e.t <= time).pop() ?? events[0];
      const after = events.find((e) => e.t > time);
      const part = after && after.t > before.t && time > before.t ? (time - before.t) / (after.t - before.t) : 0;
      const expected = 0.5 + before.x + (after ? part * (after.x - before.x) : 0);
      assert.ok(Math.abs(now.xs[0] - expected) < 1e-5, `${JSON.stringify(events)} at ${time}: ${now.xs[0]}`);
    }
  }
});

test("visits and waits have their times and robots", () => {
  const { model, order, drive } = read(
    line(0.5, "a", [0, 0], 0, "moving"), line(1, "a", [1, 0], 1, "waiting"),
    line(2, "b", [0, 1], 0, "lost"), line(6, "b", [1, 1], 1, "moving"), line(8, "a", [2, 0], 2, "moving"));
  const app = new DriveApp(model, order, drive, false);
  assert.deepEqual(app.tasks.map(({ times }) => times), [[8], [0]]);
  assert.equal(doingText(app, 0, 3), "… waiting for b");
  assert.equal(doingText(app, 0, 7), "… waiting");
  assert.equal(doingText(app, 1, 3), "? lost");
  assert.equal(drive.isOver, false);
  assert.equal(order.planTime(0, drive.actionsAt(0, 8)), 2);
});

test("a log may grow in pieces", () => {
  const text = log(kHeader, line(1, "a", [1, 0], 1, "moving"), line(2, "b", [1, 1], 2, "done"));
  const model = readModel(kModel);
  const one = new Log(model, Order.read(kOrder, model));
  for (const character of text) one.add(character);
  assert.deepEqual(one.drive.robots.map(({ count }) => count), [1, 1]);
  assert.equal(one.drive.end, 2);
});

test("wrong lines are skipped and counted", () => {
  const good = line(1, "a", [1, 0], 1, "moving");
  const after = (...events: object[]) => follow(log(kHeader, ...events, { ...good, t: 9 }));
  const wrong = (expected: RegExp, ...events: object[]) => {
    const one = after(...events);
    assert.match(one.firstError, expected);
    assert.equal(one.skippedLines, 1);
    assert.equal(one.drive.end, 9); // lines after the wrong line are read
  };
  wrong(/^line 2: robot: expected a robot that the first line names/, { ...good, robot: "z" });
  wrong(/^line 2: state: expected one of waiting/, { ...good, state: "asleep" });
  wrong(/^line 2: action: expected a whole number from 0 to 3/, { ...good, action: 4 });
  wrong(/^line 2: at: expected a list of 2/, { ...good, at: [1] });
  wrong(/^line 2: at\[0\]: expected a place in the world/, { ...good, at: [1e9, 0] });
  wrong(/^line 3: t: expected seconds from 1 on/, good, { ...good, t: 0.5 });
  wrong(/^line 2: t: expected a number/, { ...good, t: "1" });
  wrong(/^line 2: t: expected seconds from 0 on/, { ...good, t: 1e300 });
  assert.equal(after({ ...good, angle: 1e300 }).skippedLines, 0);
  const two = after({ ...good, t: -1 }, { ...good, action: -1 });
  assert.equal(troubleText(two), "⚠ 2 invalid log lines skipped; first: line 2: t: expected seconds from 0 on");
});

test("a log without its first line is refused", () => {
  const none = (expected: RegExp, text: string) => {
    const one = follow(text + log(line(1, "a", [1, 0], 1, "moving")));
    assert.match(troubleText(one), expected);
    assert.equal(one.skippedLines, 1);
    assert.equal(one.drive.order, "");
  };
  none(/^This is not the log of an execution of this plan: line 1: format/, "{}\n");
  none(/line 1: robots\[0\]: expected a robot of the instance/, log({ ...kHeader, robots: ["z"] }));
  none(/line 1: the data is no JSON/, "{\n");
  assert.equal(troubleText(follow("")), "");
});

const kColumns = {
  order: "o.json", seconds_per_step: 2, states: ["moving", "done"],
  robots: [{ t: [500, 1500], x: [1000, 1500], y: [-250, 250], angle: [350, -351], action: [0, 3], state: [0, 1] },
    { t: [], x: [], y: [], angle: [], action: [], state: [] }],
};

function columns(first: object = {}, all: object = {}) {
  const model = readModel(kModel);
  const robots = [{ ...kColumns.robots[0], ...first }, kColumns.robots[1]];
  return readDrive(JSON.stringify({ ...kColumns, robots, ...all }), model, Order.read(kOrder, model));
}

test("columns of differences are read", () => {
  const drive = columns();
  const [robot] = drive.robots;
  assert.equal(drive.secondsPerStep, 2);
  assert.deepEqual([robot.count, drive.robots[1].count, drive.end], [2, 0, 2]);
  assert.deepEqual([...robot.times.slice(0, 2)], [0.5, 2]);
  assert.deepEqual([...robot.xs.slice(0, 2)], [1.5, 3]); // the centre of cell 1 is at 1.5
  assert.deepEqual([...robot.ys.slice(0, 2)], [0.25, 0.5]);
  assert.ok(Math.abs(robot.angles[0] - (350 * Math.PI) / 180) < 1e-6);
  assert.ok(Number.isNaN(robot.angles[1]));
  assert.deepEqual([...robot.states.slice(0, 2)].map((state) => kStates[state]), ["moving", "done"]);
  assert.deepEqual(drive.completedAt[0], [2, 2, 2]);
});

test("wrong columns are refused with their position", () => {
  assert.throws(() => columns({ x: [1] }), /robots\[0\].x: expected a list of 2/);
  assert.throws(() => columns({ y: [1, 0.5] }), /robots\[0\].y: expected a list of whole numbers/);
  assert.throws(() => columns({ t: [5, -1] }), /robots\[0\].t: expected times in their order/);
  assert.throws(() => columns({ action: [0, 4] }), /robots\[0\].action: expected at most 3/);
  assert.throws(() => columns({ state: [0, 2] }), /robots\[0\].state: expected numbers below 2/);
  assert.throws(() => columns({}, { states: ["asleep", "done"] }), /states\[0\]: expected one of/);
  assert.throws(() => columns({}, { robots: [] }), /robots: expected a list of 2/);
});

test("delays refer to the next action", () => {
  const { model, order, drive } = read(
    line(0, "a", [0, 0], 0, "moving"), line(2.5, "a", [1, 0], 1, "moving"), line(9, "a", [3, 0], 3, "done"));
  const app = new DriveApp(model, order, drive, false);
  assert.deepEqual([0, 1, 2, 3, 6.5, 9, 20].map((time) => lateness(app, 0, time)), [0, 0, 1, 1, 4.5, 6, 6]);
  assert.equal(mostLate(app, 6), 5); // of robot b, which should have ended its first action at 1
  assert.equal(lateSentence(app, 0, 1), "In time: at 1 s a step, the plan ends its next action at 0:01.");
  assert.equal(lateSentence(app, 0, 20), "0:06 late: at 1 s a step, the plan ends its last action at 0:03.");
});

test("live time follows the log until the user goes back", () => {
  const player = new DrivePlayer(true);
  player.end = 100;
  player.advance(0.1);
  assert.equal(player.time, 99);
  for (let i = 0; i < 50; ++i) {
    player.end += 0.1;
    player.advance(0.1);
  }
  assert.ok(Math.abs(player.time - (player.end - 1)) < 0.2);
  for (let i = 0; i < 40; ++i) player.advance(0.1);
  assert.equal(player.time, player.end); // without new lines the time reaches the last one
  player.go(50);
  assert.equal(player.live, false);
  player.advance(1);
  assert.equal(player.time, 50);
  player.toggle();
  player.advance(0.2);
  assert.ok(player.time > 50);
  player.goLive();
  assert.equal(player.live && player.running, true);
  player.toggle();
  assert.equal(player.live || player.running, false);
  player.go(player.end);
  assert.equal(player.live, true);
});

test("times have a readable format", () => {
  assert.deepEqual([0, 59.9, 61, 3661].map(clockText), ["0:00", "0:59", "1:01", "1:01:01"]);
  assert.equal(new Drive(readModel(kModel)).stateAt(0, 5), kStates.indexOf("waiting"));
});
