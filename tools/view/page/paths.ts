// SPDX-License-Identifier: MIT
// Paints the path of the selected robot: the whole path pale, the part ahead strong, and its visits numbered
// in their order. Its path in the other plan is dashed.

import type { Camera } from "./camera";
import type { Colors } from "./colors";
import { visitsOf } from "./facts";
import type { Model, Plan, World } from "./model";
import { outlined } from "./text";
import type { Track } from "./track";

const kMostAhead = 400; // steps of the part ahead
const kLeastNumbered = 9; // pixels per step from which on visits are numbered

interface Known {
  agent: number;
  whole: Path2D; // in world units
  other: Path2D | null;
  orders: Map<number, string>; // by place: the numbers of its visits, "2" or "2, 3"
}

export class Paths {
  private known: Known | null = null;

  constructor(
    private readonly model: Model,
    private readonly viewed: { readonly plan: Plan },
    private readonly other: { readonly plan: Plan } | null,
  ) {}

  paint(
    c: CanvasRenderingContext2D, camera: Camera, agent: number, time: number, colors: Colors,
  ): void {
    const { track } = this.viewed.plan.agents[agent];
    const { whole, other, orders } = this.of(agent);
    const { world } = this.model;
    const width = Math.max(1.5, Math.min(5, 0.12 * world.unit * camera.scale)) / camera.scale;
    c.save();
    c.translate(camera.width / 2 - camera.center.x * camera.scale,
      camera.height / 2 - camera.center.y * camera.scale);
    c.scale(camera.scale, camera.scale);
    c.lineJoin = c.lineCap = "round";
    c.strokeStyle = colors.chosen;
    c.lineWidth = width;
    c.globalAlpha = 0.4;
    c.stroke(whole);
    c.globalAlpha = 0.9;
    if (!track.isEmpty) c.stroke(ahead(track, time, world));
    if (other) {
      c.globalAlpha = 1;
      c.strokeStyle = colors.text;
      c.lineCap = "butt";
      c.lineWidth = 0.6 * width;
      c.setLineDash([3 * width, 2 * width]);
      c.stroke(other);
    }
    c.restore();
    if (world.unit * camera.scale >= kLeastNumbered) this.paintOrders(c, camera, orders, colors);
  }

  // Paints the numbers of visits below and to the left of their places, where nothing else is painted.
  private paintOrders(
    c: CanvasRenderingContext2D, camera: Camera, orders: Map<number, string>, colors: Colors,
  ): void {
    const { world } = this.model;
    const step = world.unit * camera.scale;
    c.font = `700 ${Math.min(14, Math.max(9, 0.3 * step))}px system-ui, sans-serif`;
    c.textAlign = "right";
    c.textBaseline = "top";
    for (const [place, text] of orders) {
      const p = camera.toView(world.xs[place], world.ys[place]);
      outlined(c, text, p.x - 0.22 * step, p.y + 0.18 * step, colors.chosen, colors.floor);
    }
  }

  private of(agent: number): Known {
    if (this.known?.agent === agent) return this.known;
    const { model, viewed } = this;
    const { world } = model;
    const others = this.other?.plan.agents[agent].track;
    const orders = new Map<number, string>();
    visitsOf(model, viewed.plan.agents[agent], model.agents[agent]).forEach(({ task, time }, i) => {
      if (time === Infinity) return;
      const { place } = model.tasks[task];
      const before = orders.get(place);
      orders.set(place, before ? `${before}, ${i + 1}` : String(i + 1));
    });
    this.known = {
      agent, orders,
      whole: outline(viewed.plan.agents[agent].track, world),
      other: others ? outline(others, world) : null,
    };
    return this.known;
  }
}

// Returns the path with each connection once, even if the robot uses it several times or in both directions.
function outline(track: Track, world: World): Path2D {
  const path = new Path2D();
  const taken = new Set<number>();
  const places = track.visited();
  let isDown = false;
  for (let i = 1; i < places.length; ++i) {
    const [a, b] = [places[i - 1], places[i]];
    const step = Math.min(a, b) * world.places + Math.max(a, b);
    if (taken.has(step)) {
      isDown = false;
      continue;
    }
    taken.add(step);
    if (!isDown) path.moveTo(world.xs[a], world.ys[a]);
    path.lineTo(world.xs[b], world.ys[b]);
    isDown = true;
  }
  return path;
}

function ahead(track: Track, time: number, world: World): Path2D {
  const path = new Path2D();
  const first = Math.floor(time);
  const last = Math.min(track.end, first + kMostAhead);
  for (let t = first; t <= last; ++t) {
    const place = track.place(t);
    if (t === first) path.moveTo(world.xs[place], world.ys[place]);
    else path.lineTo(world.xs[place], world.ys[place]);
  }
  return path;
}
