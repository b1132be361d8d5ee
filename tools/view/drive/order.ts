// SPDX-License-Identifier: MIT
// The passing order of the executed plan (README.md): for each action its planned end, the tasks that it
// visits, and the action of another robot that it waits for.

import { parse, type Value } from "../page/json";
import type { Model } from "../page/model";

const kMostTime = (1 << 30) + 1;

export interface Wait {
  agent: number;
  action: number; // must be completed first
}

export interface Visit {
  action: number; // the action that visits the task; -1: visited at the start
  task: number;
}

interface RobotOrder {
  ends: number[]; // by action: planned end, in steps
  visits: Visit[]; // by ascending action
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

  // Returns the planned time, in steps, at which a robot has completed this number of actions.
  planTime(agent: number, completed: number): number {
    return completed > 0 ? this.robots[agent].ends[completed - 1] : 0;
  }

  visits(agent: number): Visit[] {
    return this.robots[agent].visits;
  }

  // Returns the action that a robot with this number of completed actions must wait for; null: none.
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
