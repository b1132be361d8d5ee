// SPDX-License-Identifier: MIT
// The page's canvases, its style and the pictures of C++ have the same colours and measures.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { kDark, kLight, type Colors } from "../../../tools/view/page/colors";

declare const process: { env: Record<string, string> };
const source = (name: string) => readFileSync(`${process.env.GROVE_VIEW_SOURCES}/${name}`, "utf8");
const drawing = source("picture/drawing.cpp") + source("picture/shapes.h");

test("pictures are in the colours of the light page", () => {
  const found = [...drawing.matchAll(/^constexpr Color k(\w+) = hex\(0x([0-9a-f]{6})\);/gm)];
  assert.ok(found.length >= 12);
  for (const [, name, value] of found) {
    const key = (name[0].toLowerCase() + name.slice(1)) as keyof Colors;
    assert.equal(`#${value}`, kLight[key], name);
  }
  const doing = /kDoing\{([^}]*)\}/.exec(drawing)![1];
  assert.deepEqual([...doing.matchAll(/0x([0-9a-f]{6})/g)].map((m) => `#${m[1]}`), kLight.doing);
});

// What each variable of the style is on the canvases.
const style: [string, (c: Colors) => string][] = [
  ["moving", (c) => c.doing[0]], ["waiting", (c) => c.doing[1]], ["working", (c) => c.doing[2]],
  ["resting", (c) => c.doing[3]], ["collision", (c) => c.collision], ["chosen", (c) => c.chosen],
  ["text", (c) => c.text], ["task", (c) => c.taskOpen], ["task-begun", (c) => c.taskBegun],
  ["task-done", (c) => c.taskDone], ["task-line", (c) => c.task],
];

test("the legend is in the colours of the canvases", () => {
  const [light, dark] = source("page/style.css").split("prefers-color-scheme: dark");
  for (const [text, colors] of [[light, kLight], [dark, kDark]] as const)
    for (const [name, color] of style)
      assert.equal(new RegExp(`--${name}: (#[0-9a-f]{6});`).exec(text)?.[1], color(colors), `${colors.name} ${name}`);
});

test("robots, tasks, destinations and roads have the same measures in pictures", () => {
  const page = ["world", "robots", "scenery", "tasks_canvas"].map((name) => source(`page/${name}.ts`)).join("\n");
  for (const name of ["kBend", "kMargin", "kRadius", "kGoalRadius", "kTaskRadius", "kRoomOfName", "kMostStacked"]) {
    const value = (text: string, pattern: string) =>
      Number(new RegExp(`${pattern} ${name} = ([0-9.]+);`).exec(text)?.[1]);
    assert.ok(value(page, "const") > 0, name);
    assert.equal(value(drawing, "constexpr (?:double|int)"), value(page, "const"), name);
  }
});

// Of a colour: how bright it is, from 0 to 1, as WCAG has it.
function luminance(color: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16) / 255)
    .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [dark, bright] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (bright + 0.05) / (dark + 0.05);
}

test("what is to be told apart has contrast", () => {
  for (const colors of [kLight, kDark]) {
    assert.ok(contrast(colors.text, colors.floor) > 7, `${colors.name}: text`);
    for (const color of [colors.doing[0], colors.collision])
      assert.ok(contrast(color, colors.onRobot) > 4.5, `${colors.name}: ids on ${color}`);
    for (const color of colors.doing.slice(1))
      assert.ok(contrast(color, colors.onPale) > 4.5, `${colors.name}: ids on ${color}`);
    assert.ok(contrast(colors.faint, colors.floor) > 4.5, `${colors.name}: faint text`);
    for (const color of [...colors.doing.slice(0, 1), colors.collision, colors.chosen, colors.wall, colors.task])
      if (!(colors.name === "dark" && color === colors.wall))
        assert.ok(contrast(color, colors.floor) > 3, `${colors.name}: ${color} on the floor`);
  }
});

// Colours as those see them who lack one kind of cone (Vienot, Brettel and Mollon 1999), linear rgb.
const kLack = {
  red: [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]],
  green: [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]],
};

function seen(color: string, lack: keyof typeof kLack): number[] {
  const linear = [1, 3, 5].map((at) => (parseInt(color.slice(at, at + 2), 16) / 255) ** 2.2);
  return kLack[lack].map((row) => Math.max(0, row.reduce((sum, v, i) => sum + v * linear[i], 0)) ** (1 / 2.2));
}

test("who sees no red or no green tells apart what robots do", () => {
  for (const colors of [kLight, kDark])
    for (const lack of ["red", "green"] as const) {
      const all = colors.doing.map((color) => seen(color, lack));
      all.forEach((a, i) => all.slice(0, i).forEach((b, j) => {
        const distance = Math.hypot(...a.map((v, k) => v - b[k]));
        assert.ok(distance > 0.12, `${colors.name} without ${lack}: ${colors.doing[i]} and ${colors.doing[j]}: ${distance}`);
      }));
    }
});
