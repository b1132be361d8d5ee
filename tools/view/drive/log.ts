// SPDX-License-Identifier: MIT
// Reads the drive log of a running execution. The parser is strict; it skips and counts invalid lines.

import { parse, type Value } from "../page/json";
import type { Model } from "../page/model";
import { nameOf } from "../page/names";
import { readState } from "./columns";
import { Drive } from "./drive";
import type { Order } from "./order";

const kFormat = "grove drive 1";
// Limits, equal to those in src/io/execution_log_file.cpp.
const kFar = 1e7; // cells or metres
const kLong = 1e9; // seconds

export class Log {
  readonly drive: Drive;
  skippedLines = 0; // number of invalid lines
  firstError = ""; // error of the first skipped line
  private hasHeader = false;
  private readonly agents: Map<string, number>;
  private readonly named = new Set<string>(); // ids of the robots in the header
  private rest = ""; // the incomplete last line
  private lines = 0;

  constructor(private readonly model: Model, private readonly order: Order) {
    this.drive = new Drive(model);
    this.agents = new Map(model.agents.map(({ id }, i) => [id, i]));
  }

  // Reads new text. Skips invalid lines, because they must not stop the display of robots. If the first line
  // is invalid, ignores all others, because they have no meaning without it.
  add(text: string): void {
    const lines = (this.rest + text).split("\n");
    this.rest = lines.pop()!;
    for (const line of lines) {
      ++this.lines;
      if (line.trim() === "" || this.isNoDrive) continue;
      try {
        const data = parse(line);
        if (this.hasHeader) this.addObservation(data);
        else this.readHeader(data);
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        if (this.skippedLines++ === 0) this.firstError = `line ${this.lines}: ${why}`;
      }
    }
  }

  get isNoDrive(): boolean {
    return !this.hasHeader && this.skippedLines > 0;
  }

  private readHeader(data: Value): void {
    if (data.key("format").text() !== kFormat) data.key("format").fail(`'${kFormat}'`);
    this.drive.secondsPerStep = seconds(data.key("seconds_per_step"), 0);
    for (const robot of data.key("robots").list()) {
      if (!this.agents.has(robot.text())) robot.fail("a robot of the instance");
      this.named.add(robot.text());
    }
    this.drive.order = nameOf(data.key("order").text());
    this.hasHeader = true;
  }

  private addObservation(data: Value): void {
    const { drive, model, order } = this;
    const id = data.key("robot");
    if (!this.named.has(id.text())) id.fail("a robot that the first line names");
    const agent = this.agents.get(id.text())!;
    const { count, times } = drive.robots[agent];
    const time = seconds(data.key("t"), count > 0 ? times[count - 1] : 0);
    const [x, y] = data.key("at").list(2).map((value) => {
      if (Math.abs(value.number()) > kFar) value.fail("a place in the world");
      return value.number();
    });
    const angle = data.key("angle");
    const action = data.key("action").integer(0, order.actions(agent) + 1);
    const state = readState(data.key("state"));
    const at = model.world.drawn(x, y);
    drive.add(agent, time, at.x, at.y, angle.isThere ? angle.number() : NaN, action, state);
  }
}

function seconds(value: Value, least: number): number {
  const number = value.number();
  if (number < least || number > kLong) value.fail(`seconds from ${least} on`);
  return number;
}
