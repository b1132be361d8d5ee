// SPDX-License-Identifier: MIT
// A chart over time with step lines, areas and marks. It shows the values at a time that the pointer or the
// arrow keys set.

import { el, setText } from "../page/dom";
import type { Scale } from "./scale";
import { thin } from "./scale";
import { svg } from "./svg";
import { seconds } from "./words";

export interface Point {
  time: number;
  value: number;
}

export interface Series {
  name: string;
  kind: string; // CSS class of its elements
  points: Point[];
  until?: Point[]; // only for an area: its lower edge, at the same times
}

export interface Mark {
  time: number;
  value: number;
  shape: string; // a character
  kind: string; // CSS class, as for a series
  title: string;
}

export interface Contents {
  title: string;
  end: number; // end of the time axis
  x: Scale;
  y: Scale;
  series: Series[];
  marks: Mark[];
  label(value: number): string;
  read(time: number): string; // returns the text for a time
  stops: number[]; // times that the arrow keys go to
}

const kMostPoints = 2000;
const kMostMarks = 200;
const kLeft = 64;
const kBottom = 22;
const kTop = 8;
const kRight = 12;

export class Chart {
  readonly element: HTMLElement;
  private readonly picture = el("div", { class: "picture", tabindex: 0, role: "img" });
  private readonly reading = el("p", { class: "readout", "aria-live": "polite" });
  private readonly cursor = svg("line", { class: "cursor", y1: kTop });
  private contents: Contents | null = null;
  private time: number | null = null;

  constructor() {
    this.element = el("div", { class: "chart" }, this.picture, this.reading);
    this.picture.addEventListener("pointermove", (event) => this.point(event));
    this.picture.addEventListener("pointerdown", (event) => this.point(event));
    this.picture.addEventListener("keydown", (event) => this.key(event));
  }

  show(contents: Contents): void {
    this.contents = contents;
    this.paint();
  }

  paint(): void {
    if (!this.contents) return;
    const width = Math.max(260, this.element.clientWidth);
    const height = width < 500 ? 180 : 240;
    this.picture.setAttribute("aria-label", this.contents.title);
    const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height });
    const frame = new Frame(this.contents, width, height);
    const series = this.contents.series.filter(({ points }) => points.length > 0);
    drawing.append(...frame.axes(), ...series.map((each) => frame.line(each)),
      ...thin(this.contents.marks, kMostMarks).map((mark) => frame.mark(mark)), this.cursor);
    this.cursor.setAttribute("y2", String(height - kBottom));
    this.picture.replaceChildren(drawing);
    this.read(this.time ?? this.contents.end);
  }

  private read(time: number): void {
    if (!this.contents) return;
    const width = this.picture.firstElementChild!.clientWidth || 1;
    const x = kLeft + this.contents.x.at(time) * (width - kLeft - kRight);
    for (const end of ["x1", "x2"]) this.cursor.setAttribute(end, x.toFixed(1));
    setText(this.reading, `${seconds(time)}: ${this.contents.read(time)}`);
  }

  private point(event: PointerEvent): void {
    if (!this.contents) return;
    const box = this.picture.firstElementChild!.getBoundingClientRect();
    const fraction = (event.clientX - box.left - kLeft) / (box.width - kLeft - kRight);
    this.time = this.timeAt(Math.min(1, Math.max(0, fraction)));
    this.read(this.time);
  }

  // Returns the time at a position on the time axis (0 to 1), by bisection, because Scale has no inverse.
  private timeAt(fraction: number): number {
    let [least, most] = [0, this.contents!.end];
    for (let i = 0; i < 40; ++i) {
      const middle = (least + most) / 2;
      if (this.contents!.x.at(middle) < fraction) least = middle;
      else most = middle;
    }
    return most;
  }

  private key(event: KeyboardEvent): void {
    if (!this.contents || (event.key !== "ArrowLeft" && event.key !== "ArrowRight")) return;
    event.preventDefault();
    const now = this.time ?? this.contents.end;
    const stops = this.contents.stops;
    const next = event.key === "ArrowRight" ? stops.find((stop) => stop > now)
      : [...stops].reverse().find((stop) => stop < now);
    if (next === undefined) return;
    this.time = next;
    this.read(next);
  }
}

// The drawing area of a chart.
class Frame {
  constructor(
    private readonly contents: Contents,
    private readonly width: number,
    private readonly height: number,
  ) {}

  private x(time: number): string {
    return (kLeft + this.contents.x.at(time) * (this.width - kLeft - kRight)).toFixed(1);
  }
  private y(value: number): string {
    const space = this.height - kBottom - kTop;
    return (kTop + (1 - this.contents.y.at(value)) * space).toFixed(1);
  }

  axes(): SVGElement[] {
    const { contents, height } = this;
    const foot = height - kBottom;
    const across = contents.y.marks(4).flatMap((value) => [
      svg("line", { class: "grid", x1: kLeft, x2: this.width - kRight, y1: this.y(value), y2: this.y(value) }),
      svg("text", { x: kLeft - 6, y: this.y(value), class: "y" }, contents.label(value)),
    ]);
    const times = contents.x.marks(this.width < 500 ? 3 : 6).filter((t) => t <= contents.end);
    const down = times.flatMap((time) => [
      svg("line", { class: "grid", x1: this.x(time), x2: this.x(time), y1: foot, y2: foot + 4 }),
      svg("text", { x: this.x(time), y: height - 5, class: "x" }, seconds(time)),
    ]);
    return [...across, ...down];
  }

  line(series: Series): SVGElement {
    const forth = thin(series.points, kMostPoints);
    if (!series.until) return svg("path", { class: `line ${series.kind}`, d: this.steps(forth, "M") });
    const back = thin(series.until, kMostPoints).reverse();
    const d = `${this.steps(forth, "M")}${this.stepsBack(back)}Z`;
    return svg("path", { class: `area ${series.kind}`, d });
  }

  private steps(points: Point[], begin: string): string {
    let d = "";
    for (const { time, value } of points)
      d += d === "" ? `${begin}${this.x(time)} ${this.y(value)}` : `H${this.x(time)}V${this.y(value)}`;
    return `${d}H${this.x(this.contents.end)}`;
  }

  private stepsBack(points: Point[]): string {
    let d = points.length > 0 ? `V${this.y(points[0].value)}` : "";
    points.forEach(({ time }, i) => {
      d += `H${this.x(time)}`;
      if (i + 1 < points.length) d += `V${this.y(points[i + 1].value)}`;
    });
    return d;
  }

  mark(mark: Mark): SVGElement {
    const text = svg("text", { x: this.x(mark.time), y: this.y(mark.value), class: `mark ${mark.kind}` }, mark.shape);
    text.append(svg("title", {}, mark.title));
    return text;
  }
}
