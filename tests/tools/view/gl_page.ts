// SPDX-License-Identifier: MIT
// A page that paints robots with WebGL and reports the colours at their positions.

import { Camera } from "../../../tools/view/page/camera";
import { kLight } from "../../../tools/view/page/colors";
import { planFacts } from "../../../tools/view/page/facts";
import { Frame } from "../../../tools/view/page/frame";
import { GlRobots } from "../../../tools/view/page/robots_gl";
import { kGrid, model } from "./models";

const kSize = 400;

// A robot that moves to the right, one that turns on its place, and two that collide at time 2.
const shown = model(
  kGrid,
  [{ id: "a", start: 0 }, { id: "b", start: 3, turn: 1, angle: "2" }, { id: "c", start: 8 }, { id: "d", start: 10 }],
  [],
  [{ path: "@0;E" }, { path: "@3;.", turns: "@2;r" }, { path: "@8;E" }, { path: "@10;W" }],
);

function pixels(): Record<string, string> {
  const canvas = document.createElement("canvas");
  canvas.width = kSize;
  canvas.height = (kSize * 3) / 4;
  const [plan] = shown.plans;
  const frame = new Frame(shown, plan, planFacts(shown, plan));
  const robots = GlRobots.on(canvas, shown.world, frame.count);
  if (!robots) return { gl: "none" };
  const camera = new Camera(4, 3, 1);
  camera.resize(canvas.width, canvas.height);
  const seen: Record<string, string> = {};
  const look = (name: string, x: number, y: number) => {
    const gl = canvas.getContext("webgl2")!;
    const at = camera.toView(x, y);
    const pixel = new Uint8Array(4);
    gl.readPixels(Math.round(at.x), canvas.height - 1 - Math.round(at.y), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    seen[name] = [...pixel].join();
  };
  frame.update(0.25);
  robots.paint(camera, frame, kLight, 1);
  look("a moves", 0.75, 0.5);
  look("an empty cell", 2, 0.5);
  look("b turns, pointing down and to the left", 3.5 - 0.38 * Math.sin(Math.PI / 8), 0.5 + 0.38 * Math.cos(Math.PI / 8));
  frame.update(1);
  robots.paint(camera, frame, kLight, 1);
  look("c and d collide", 1.5, 2.5);
  look("their star is larger than a robot", 1.5 + 0.34 * 1.25, 2.5);
  look("a rests", 1.5, 0.5);
  return seen;
}

// Returns the median time that the page's own code takes for a frame with `count` robots, in
// milliseconds; NaN without WebGL.
function milliseconds(count: number): number {
  const side = Math.ceil(Math.sqrt(2 * count));
  const agents = Array.from({ length: count }, (_, i) => ({ id: `a${i}`, start: 2 * i }));
  const many = model({ kind: "grid", width: side, height: side, free: String(side * side) }, agents, [],
    agents.map((agent) => ({ path: `@${agent.start};${"E.W.".repeat(20)}` })));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1000;
  const [plan] = many.plans;
  const frame = new Frame(many, plan, planFacts(many, plan));
  const robots = GlRobots.on(canvas, many.world, count);
  if (!robots) return NaN;
  const camera = new Camera(side, side, 1);
  camera.resize(1000, 1000);
  const times: number[] = [];
  for (let k = 0; k < 60; ++k) {
    const before = performance.now();
    frame.update(k * 0.37);
    robots.paint(camera, frame, kLight, 1);
    times.push(performance.now() - before);
  }
  return times.sort((a, b) => a - b)[30];
}

const result = document.createElement("pre");
result.id = "result";
result.textContent = JSON.stringify({ pixels: pixels(), milliseconds: milliseconds(10_000) });
document.body.append(result);
