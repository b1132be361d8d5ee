// SPDX-License-Identifier: MIT
// Reads the execution that the page contains, which is stored as columns of differences (README.md).

import { parse, type Value } from "../page/json";
import type { Model } from "../page/model";
import { nameOf } from "../page/names";
import { Drive, kStates } from "./drive";
import type { Order } from "./order";

const kFine = 1000; // units of the data per second, cell or metre

export function readDrive(text: string, model: Model, order: Order): Drive {
  const data = parse(text);
  const drive = new Drive(model);
  drive.order = nameOf(data.key("order").text());
  drive.secondsPerStep = data.key("seconds_per_step").number();
  const states = data.key("states").list().map(readState);
  data.key("robots").list(model.agents.length).forEach((robot, agent) =>
    readRobot(robot, agent, states, { drive, model, order }));
  return drive;
}

export function readState(name: Value): number {
  const state = kStates.findIndex((one) => one === name.text());
  if (state < 0) name.fail(`one of ${kStates.join(", ")}`);
  return state;
}

function readRobot(
  data: Value, agent: number, states: number[],
  { drive, model, order }: { drive: Drive; model: Model; order: Order },
): void {
  const times = data.key("t").safeIntegers();
  const column = (name: string) => data.key(name).safeIntegers(times.length);
  const [xs, ys, angles] = [column("x"), column("y"), column("angle")];
  const [actions, codes] = [column("action"), column("state")];
  let [t, x, y, angle, action, code] = [0, 0, 0, 0, 0, 0];
  for (let i = 0; i < times.length; ++i) {
    t += times[i];
    x += xs[i];
    y += ys[i];
    angle += angles[i];
    action += actions[i];
    code += codes[i];
    if (times[i] < 0) data.key("t").fail("times in their order");
    if (!(code in states)) data.key("state").fail(`numbers below ${states.length}`);
    if (!(action >= 0 && action <= order.actions(agent)))
      data.key("action").fail(`at most ${order.actions(agent)}`);
    const at = model.world.drawn(x / kFine, y / kFine);
    drive.add(agent, t / kFine, at.x, at.y, angle < 0 ? NaN : angle, action, states[code]);
  }
}
