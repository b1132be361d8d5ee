// SPDX-License-Identifier: MIT
// Tests that all colours are defined in palette.json and can be distinguished.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { kDark, kLight } from "../../../tools/view/page/colors";
import palette from "../../../tools/view/palette.json";
import { kMemory } from "../../../tools/view/run/model";
import { kBoundSources } from "../../../tools/view/run/words";

declare const process: { env: Record<string, string> };
const folder = process.env.GROVE_VIEW_SOURCES;
const source = (name: string) => readFileSync(`${folder}/${name}`, "utf8");
const sources = ["page", "page/panels", "run", "drive", "drive/panels", "proof", "proof/panels", "picture"]
  .flatMap((name) => readdirSync(`${folder}/${name}`).map((file) => `${name}/${file}`))
  .filter((name) => /\.(ts|css|cpp|h|in)$/.test(name));

test("palette.json is the only file with colours", () => {
  assert.ok(sources.length > 60);
  for (const name of sources) assert.doesNotMatch(source(name), /#[0-9a-f]{6}|#[0-9a-f]{3}\b|hex\(0x[0-9a-f]/i, name);
});

test("styles and pictures name values of the palette", () => {
  let count = 0;
  for (const name of sources.filter((name) => /\.(css|in)$/.test(name)))
    for (const [, path] of source(name).matchAll(/@([\w.]+)@/g)) {
      const value = path.split(".").reduce((part, key) => part?.[key], palette as any);
      assert.match(String(value), path.startsWith("shapes.") ? /^[0-9.]+$/ : /^#[0-9a-f]+$/, `${name}: ${path}`);
      ++count;
    }
  assert.ok(count > 90);
});

// Returns the relative luminance of a colour according to WCAG, from 0 to 1.
function luminance(color: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16) / 255)
    .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [dark, bright] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (bright + 0.05) / (dark + 0.05);
}

test("text and shapes have contrast", () => {
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

// Matrices for colours as people without one type of cone see them (Vienot, Brettel and Mollon
// 1999), in linear RGB.
const kLack = {
  red: [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]],
  green: [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]],
};

function seen(color: string, lack: keyof typeof kLack): number[] {
  const linear = [1, 3, 5].map((at) => (parseInt(color.slice(at, at + 2), 16) / 255) ** 2.2);
  return kLack[lack].map((row) => Math.max(0, row.reduce((sum, v, i) => sum + v * linear[i], 0)) ** (1 / 2.2));
}

function expectDistinct(colors: string[], name: string): void {
  for (const lack of ["red", "green"] as const) {
    const all = colors.map((color) => seen(color, lack));
    all.forEach((a, i) => all.slice(0, i).forEach((b, j) => {
      const distance = Math.hypot(...a.map((v, k) => v - b[k]));
      assert.ok(distance > 0.12, `${name} without ${lack}: ${colors[i]} and ${colors[j]}: ${distance}`);
    }));
  }
}

test("activities of robots are distinct without red or green", () => {
  for (const colors of [kLight, kDark]) expectDistinct([...colors.doing], colors.name);
});

// Logs of grove-mpi have `tree` instead of `branching`.
test("sources of the bound are distinct without red or green", () => {
  for (const name of ["light", "dark"] as const) {
    const { tree, ...others } = palette.run[name].raised;
    assert.equal(tree, others.branching);
    expectDistinct(Object.values(others), name);
  }
});

test("each source of the bound has a colour in chart and legend", () => {
  const style = source("run/style.css");
  for (const name of Object.keys(kBoundSources))
    for (const element of [".area.", ".entry i."])
      assert.ok(style.includes(`${element}raised-${name} {`), `${element}raised-${name}`);
});

test("each kind of memory has a colour in chart and legend", () => {
  const style = source("run/style.css");
  for (const kind of kMemory)
    for (const element of [".area.", ".entry i."])
      assert.ok(style.includes(`${element}memory-${kind} {`), `${element}memory-${kind}`);
});
