// SPDX-License-Identifier: MIT
// Reads the log of a drive, which may still be growing. Lines are taken strictly, with their number
// in errors.

import { parse, type Value } from "../page/json";
import type { Model } from "../page/model";
import { nameOf } from "../page/names";
import { Drive, kStates } from "./drive";
import type { Order } from "./order";

const kFormat = "grove drive 1";
const kFar = 1e7; // cells or metres
const kLong = 1e9; // seconds

export class Log {
  readonly drive: Drive;
  private isBegun = false;
  private readonly agents: Map<string, number>;
  private readonly named = new Set<string>(); // the robots of the header
  private rest = ""; // of a line that has not ended
  private lines = 0;

  constructor(private readonly model: Model, private readonly order: Order) {
    this.drive = new Drive(model);
    this.agents = new Map(model.agents.map(({ id }, i) => [id, i]));
  }

  // What came since the last time. Throws an error that names the line.
  add(text: string): void {
    const lines = (this.rest + text).split("\n");
    this.rest = lines.pop()!;
    for (const line of lines) {
      ++this.lines;
      if (line.trim() === "") continue;
      try {
        const data = parse(line);
        if (this.isBegun) this.see(data);
        else this.begin(data);
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        throw new Error(`line ${this.lines}: ${why}`);
      }
    }
  }

  private begin(data: Value): void {
    if (data.key("format").text() !== kFormat) data.key("format").fail(`'${kFormat}'`);
    this.drive.order = nameOf(data.key("order").text());
    for (const robot of data.key("robots").list()) {
      if (!this.agents.has(robot.text())) robot.fail("a robot of the instance");
      this.named.add(robot.text());
    }
    this.isBegun = true;
  }

  private see(data: Value): void {
    const { drive, model, order } = this;
    const id = data.key("robot");
    if (!this.named.has(id.text())) id.fail("a robot that the first line names");
    const agent = this.agents.get(id.text())!;
    const time = data.key("t").number();
    const robot = drive.robots[agent];
    const before = robot.count > 0 ? robot.times[robot.count - 1] : 0;
    if (time < before || time > kLong) data.key("t").fail(`seconds from ${before} on`);
    const [x, y] = data.key("at").list(2).map((value) => {
      if (Math.abs(value.number()) > kFar) value.fail("a place in the world");
      return value.number();
    });
    const angle = data.key("angle");
    const action = data.key("action").integer(0, order.actions(agent) + 1);
    const state = kStates.findIndex((name) => name === data.key("state").text());
    if (state < 0) data.key("state").fail(`one of ${kStates.join(", ")}`);
    const at = model.world.drawn(x, y);
    drive.add(agent, time, at.x, at.y,
      angle.isThere ? (angle.number() * Math.PI) / 180 : NaN, action, state);
  }
}
