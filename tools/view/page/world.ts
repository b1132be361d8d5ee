// SPDX-License-Identifier: MIT
// Reads the world: positions of places, and possible moves.

import { shapes } from "../palette.json";
import type { Value } from "./json";
import type { Road, World } from "./model";
import { nameOf } from "./names";

const kMostPlaces = 1 << 26;

export function readWorld(data: Value): World {
  switch (data.key("kind").text()) {
    case "grid": return readGrid(data);
    case "roadmap": return readRoadmap(data);
    default: return data.key("kind").fail("grid or roadmap");
  }
}

function readGrid(data: Value): World {
  data.only("kind", "width", "height", "free");
  const width = data.key("width").integer(1, kMostPlaces);
  const height = data.key("height").integer(1, Math.floor(kMostPlaces / width) + 1);
  const places = width * height;
  const xs = new Float64Array(places);
  const ys = new Float64Array(places);
  for (let place = 0; place < places; ++place) {
    xs[place] = (place % width) + 0.5;
    ys[place] = Math.floor(place / width) + 0.5;
  }
  const free = data.key("free").as((text) => readFree(text, places));
  return {
    kind: "grid", places, width, height, unit: 1, xs, ys, free, columns: width, roads: [],
    vertexNames: [],
    mayMove: (from, to) => {
      if (!free[to]) return false;
      const by = to - from;
      if (by === width || by === -width) return true;
      return (by === 1 && to % width !== 0) || (by === -1 && from % width !== 0);
    },
    place: (place) => `[${place % width}, ${Math.floor(place / width)}]`,
    drawn: (x, y) => ({ x: x + 0.5, y: y + 0.5 }),
  };
}

// Parses the lengths of alternating runs of free and blocked cells. Returns 1 for each free cell.
function readFree(text: string, places: number): Uint8Array {
  const free = new Uint8Array(places);
  let at = 0;
  let isFree = 1;
  for (const word of text.split(" ")) {
    const count = /^[0-9]{1,9}$/.test(word) ? Number(word) : NaN;
    if (!(at + count <= places)) throw new Error(`expected ${places} cells as counts`);
    free.fill(isFree, at, at + count);
    at += count;
    isFree = 1 - isFree;
  }
  if (at !== places) throw new Error(`expected ${places} cells as counts, but found ${at}`);
  return free;
}

interface Vertex {
  name: string;
  x: number;
  y: number;
}

function readRoadmap(data: Value): World {
  data.only("kind", "vertices", "roads");
  const vertices = data.key("vertices").list().map((vertex): Vertex => {
    const [name, x, y] = vertex.list(3);
    return { name: nameOf(name.text()), x: x.number(), y: -y.number() };
  });
  if (vertices.length === 0) data.key("vertices").fail("a vertex at least");
  let places = vertices.length;
  const roads = data.key("roads").list().map((road): Road => {
    const [from, to, steps, oneWay] = road.list(4);
    const first = places;
    places += steps.integer(1, kMostPlaces) - 1;
    if (places > kMostPlaces) road.fail("fewer places");
    return {
      from: from.integer(0, vertices.length), to: to.integer(0, vertices.length),
      steps: steps.integer(1, kMostPlaces), oneWay: oneWay.integer(0, 2) === 1, first,
    };
  });
  const unit = lengthOfStep(vertices, roads);
  const xs = new Float64Array(places);
  const ys = new Float64Array(places);
  vertices.forEach((vertex, i) => {
    xs[i] = vertex.x;
    ys[i] = vertex.y;
  });
  layRoads(roads, xs, ys, unit);
  const margin = shapes.margin * unit;
  const [first] = vertices;
  return {
    kind: "roadmap", places, unit, xs, ys, columns: 0, roads,
    width: shiftToZero(xs, margin),
    height: shiftToZero(ys, margin),
    free: new Uint8Array(places).fill(1),
    vertexNames: vertices.map((vertex) => vertex.name),
    mayMove: movesOnRoads(roads, vertices.length),
    place: (place) => nameOnRoads(place, vertices, roads),
    drawn: (x, y) => ({ x: x - first.x + xs[0], y: -y - first.y + ys[0] }),
  };
}

// Shifts the values so that the least is `margin`. Returns their extent including a margin on both sides.
function shiftToZero(values: Float64Array, margin: number): number {
  const least = values.reduce((a, b) => Math.min(a, b), Infinity) - margin;
  const most = values.reduce((a, b) => Math.max(a, b), -Infinity) + margin;
  for (let i = 0; i < values.length; ++i) values[i] -= least;
  return most - least;
}

// Returns the mean length of a step in metres, over all roads; 1 if no road has a length.
function lengthOfStep(vertices: Vertex[], roads: Road[]): number {
  let length = 0;
  let steps = 0;
  for (const road of roads) {
    const [a, b] = [vertices[road.from], vertices[road.to]];
    length += Math.hypot(a.x - b.x, a.y - b.y);
    steps += road.steps;
  }
  return length > 0 ? length / steps : 1;
}

// Sets the positions of the inner places of roads, spaced evenly between the ends. Roads that join the same
// vertices lie beside each other.
function layRoads(roads: Road[], xs: Float64Array, ys: Float64Array, unit: number): void {
  const beside = new Map<string, Road[]>();
  for (const road of roads) {
    const key = [Math.min(road.from, road.to), Math.max(road.from, road.to)].join();
    const others = beside.get(key);
    if (others) others.push(road);
    else beside.set(key, [road]);
  }
  for (const row of beside.values())
    row.forEach((road, i) => {
      const rank = i - (row.length - 1) / 2;
      layRoad(road, rank * 2 * shapes.bend * unit, xs, ys, unit);
    });
}

function layRoad(road: Road, bend: number, xs: Float64Array, ys: Float64Array, unit: number): void {
  const a = { x: xs[road.from], y: ys[road.from] };
  const b = { x: xs[road.to], y: ys[road.to] };
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  // Makes the side of a bend independent of the direction of the road.
  const sign = road.from < road.to ? 1 : -1;
  const across = length > 0
    ? { x: (-(b.y - a.y) / length) * sign, y: ((b.x - a.x) / length) * sign } : { x: 0, y: 0 };
  for (let k = 1; k < road.steps; ++k) {
    const fraction = k / road.steps;
    const place = road.first + k - 1;
    if (road.from === road.to) {
      const angle = 2 * Math.PI * fraction; // a loop: a circle above its vertex
      xs[place] = a.x + unit * Math.sin(angle);
      ys[place] = a.y - unit * (1 - Math.cos(angle));
    } else {
      const aside = bend * Math.sin(Math.PI * fraction);
      xs[place] = a.x + (b.x - a.x) * fraction + across.x * aside;
      ys[place] = a.y + (b.y - a.y) * fraction + across.y * aside;
    }
  }
}

function movesOnRoads(roads: Road[], vertices: number): (from: number, to: number) => boolean {
  const steps = new Set<number>();
  const key = (from: number, to: number) => from * kMostPlaces + to;
  const oneWay: Uint8Array = new Uint8Array(roads.length);
  roads.forEach((road, index) => {
    oneWay[index] = road.oneWay ? 1 : 0;
    const ends: [number, number][] = road.steps === 1
      ? [[road.from, road.to]]
      : [[road.from, road.first], [road.first + road.steps - 2, road.to]];
    for (const [from, to] of ends) {
      steps.add(key(from, to));
      if (!road.oneWay) steps.add(key(to, from));
    }
  });
  const roadOf = (place: number) => lastBefore(roads, place);
  return (from, to) => {
    if (from < vertices || to < vertices) return steps.has(key(from, to));
    const road = roadOf(from);
    if (road !== roadOf(to)) return false;
    return to === from + 1 || (to === from - 1 && !oneWay[road]);
  };
}

// Returns the road of an inner place: the last road whose first inner place is at or before it.
function lastBefore(roads: Road[], place: number): number {
  let low = 0;
  let high = roads.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (roads[middle].first <= place) low = middle;
    else high = middle - 1;
  }
  return low;
}

function nameOnRoads(place: number, vertices: Vertex[], roads: Road[]): string {
  if (place < vertices.length) return vertices[place].name;
  const road = roads[lastBefore(roads, place)];
  return `${vertices[road.from].name}–${vertices[road.to].name} ${place - road.first + 1}`;
}
