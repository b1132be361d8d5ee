// SPDX-License-Identifier: MIT
// The passing order of the executed plan (README.md): planned ends of actions, their visits, and the actions
// they wait for.

import { parse, type Value } from "../page/json";
import type { Model } from "../page/model";

const kMostTime = (1 << 30) + 1;

export interface Wait {
  agent: number;
  action: number; // to be completed
}

export interface Visit {
  action: number; // action of the visit; -1: at the start
  task: number;
}

interface RobotOrder {
  ends: number[]; // by action: plan steps
  visits: Visit[]; // ascending
  waits: Map<number, Wait>; // by action
}

export class Order {
  private constructor(private readonly robots: RobotOrder[]) {}

  static read(text: string, model: Model): Order {
    const data = parse(text);
    const robots = data.key("robots").list(model.agents.length);
    const counts = robots.map((robot) => robot.key("ends").list().length);
    return new Order(robots.map((robot, i) => readRobot(robot, counts[i], counts, model)));
  }

  actions(agent: number): number {
    return this.robots[agent].ends.length;
  }

  // Time of the plan that a robot has reached with this number of completed actions.
  planTime(agent: number, completed: number): number {
    return completed > 0 ? this.robots[agent].ends[completed - 1] : 0;
  }

  visits(agent: number): Visit[] {
    return this.robots[agent].visits;
  }

  // The action that the next action of a robot must wait for, given its number of completed actions.
  wait(agent: number, completed: number): Wait | null {
    return this.robots[agent].waits.get(completed) ?? null;
  }
}

function readRobot(data: Value, count: number, counts: number[], model: Model): RobotOrder {
  return {
    ends: data.key("ends").list().map((end) => end.integer(0, kMostTime)),
    visits: data.key("visits").list().map((visit) => {
      const [action, task] = visit.list(2);
      return { action: action.integer(-1, count), task: task.integer(0, model.tasks.length) };
    }),
    waits: new Map(data.key("waits").list().map((wait) => {
      const [action, other, its] = wait.list(3);
      const agent = other.integer(0, counts.length);
      return [action.integer(0, count), { agent, action: its.integer(0, counts[agent]) }];
    })),
  };
}
