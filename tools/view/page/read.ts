// SPDX-License-Identifier: MIT
// Reads the data of the page (README.md) strictly: each unexpected value is an error.

import { parse, type Value } from "./json";
import { hasChoice } from "./model";
import type { Agent, AgentPlan, Claims, Model, Plan, Task, World } from "./model";
import { nameOf } from "./names";
import { readAngle, readTrack, readTurns, stepsOnGrid, stepsOnRoads } from "./track";
import { readWorld } from "./world";

const kMostTime = (1 << 30) + 1; // as in plan files
const kMostTurn = (1 << 16) + 1;

export function readModel(text: string): Model {
  const data = parse(text);
  if (data.key("format").text() !== "grove view 1") data.key("format").fail("'grove view 1'");
  data.only("format", "instance", "world", "agents", "tasks", "plans");
  const world = readWorld(data.key("world"));
  const taskCount = data.key("tasks").list().length;
  const agents = data.key("agents").list().map((agent) => readAgent(agent, world, taskCount));
  const everyone = [...agents.keys()];
  const tasks = data.key("tasks").list().map((task, index) =>
    readTask(task, index, world, agents, everyone));
  const plans = data.key("plans").list().map((plan) => readPlan(plan, world, agents, tasks));
  return { instance: nameOf(data.key("instance").text()), world, agents, tasks, plans };
}

function readAgent(data: Value, world: World, taskCount: number): Agent {
  const goal = data.key("goal");
  const goals = data.key("goals");
  if (goal.isThere && goals.isThere) goals.fail("'goal' or 'goals'");
  const turn = data.key("turn");
  const goalAngle = data.key("goalAngle");
  const working = data.key("working");
  const turnSteps = turn.isThere ? turn.integer(1, kMostTurn) : 0;
  if (turnSteps > 0 && world.kind !== "grid") turn.fail("no robot that turns on a roadmap");
  const agent: Agent = {
    id: data.key("id").text(),
    name: nameOf(data.key("id").text()),
    start: data.key("start").integer(0, world.places),
    goal: goal.isThere ? goal.integer(0, world.places) : -1,
    goals: readGoals(goals, world),
    turnSteps,
    startAngle: turnSteps > 0
      ? data.key("angle").as((text) => readAngle(text, turnSteps)) : { steps: 0, direction: 0 },
    goalAngle: turnSteps > 0 && goalAngle.isThere ? goalAngle.integer(0, 4 * turnSteps) : -1,
    working: null,
    tasks: [],
    hasOptions: false,
  };
  const ofTurning = turnSteps > 0 ? ["turn", "angle", "goalAngle"] : [];
  data.only("id", "start", "goal", "goals", "working", ...ofTurning);
  if (working.isThere) {
    const [task, done] = working.list(2);
    agent.working = { task: task.integer(0, taskCount), done: done.integer(0, kMostTime) };
  }
  return agent;
}

function readGoals(data: Value, world: World): number[] {
  if (!data.isThere) return [];
  const goals = data.list().map((place) => place.integer(0, world.places));
  if (goals.length === 0) data.fail("a place at least");
  return goals;
}

// `everyone`: all robots, for "*"; shared by the tasks, because each of thousands of tasks may have it.
function readTask(
  data: Value, index: number, world: World, agents: Agent[], everyone: number[],
): Task {
  const duration = data.key("duration");
  const need = data.key("need");
  const own = data.key("agents");
  const may = own.is("*") ? everyone : own.list().map((agent) => agent.integer(0, agents.length));
  const task: Task = {
    id: data.key("id").text(),
    name: nameOf(data.key("id").text()),
    place: data.key("place").integer(0, world.places),
    agents: may,
    need: need.isThere ? need.integer(1, may.length + 1) : may.length,
    duration: duration.isThere ? duration.integer(0, kMostTime) : 0,
  };
  data.only("id", "place", "agents", "need", "duration");
  for (const agent of task.agents)
    if (hasChoice(task)) agents[agent].hasOptions = true;
    else agents[agent].tasks.push(index);
  return task;
}

function readPlan(data: Value, world: World, agents: Agent[], tasks: Task[]): Plan {
  const list = data.key("agents");
  data.only("name", "claims", "agents");
  const plans = list.isThere
    ? list.list(agents.length).map((plan, i) => readAgentPlan(plan, world, agents[i], tasks)) : [];
  return {
    name: nameOf(data.key("name").text()),
    claims: readClaims(data.key("claims")),
    agents: plans,
    end: plans.reduce((end, plan) => Math.max(end, endOf(plan)), 0),
  };
}

function endOf(plan: AgentPlan): number {
  const worked = plan.work.reduce((end, work) => Math.max(end, work.end), 0);
  return Math.max(plan.track.end, plan.turns ? plan.turns.end : 0, worked);
}

function readClaims(data: Value): Claims {
  const claims: Claims = {};
  const status = data.key("status");
  const cost = data.key("cost");
  const bound = data.key("lower_bound");
  const omega = data.key("omega");
  data.only("status", "cost", "lower_bound", "omega");
  if (status.isThere) claims.status = status.text();
  if (cost.isThere) claims.cost = cost.wholeNumber();
  if (bound.isThere) claims.lower_bound = bound.wholeNumber();
  if (omega.isThere) claims.omega = omega.text();
  return claims;
}

function readAgentPlan(data: Value, world: World, agent: Agent, tasks: Task[]): AgentPlan {
  const steps = world.kind === "grid" ? stepsOnGrid(world.columns) : stepsOnRoads();
  const cost = data.key("cost");
  const order = data.key("tasks");
  const work = data.key("work");
  const turns = data.key("turns");
  if (turns.isThere && agent.turnSteps === 0) turns.fail("no turns of a robot that turns freely");
  const plan: AgentPlan = {
    cost: cost.isThere ? cost.integer(1 - kMostTime, kMostTime) : null,
    track: data.key("path").as((text) => readTrack(text, steps, world.places)),
    turns: agent.turnSteps > 0
      ? turns.as((text) => readTurns(text, agent.turnSteps)) : null,
    tasks: order.isThere
      ? order.list().map((task) => task.integer(0, tasks.length)) : null,
    work: work.isThere
      ? work.list().map((piece) => {
          const [task, begin, end] = piece.list(3);
          return {
            task: task.integer(0, tasks.length),
            begin: begin.integer(1 - kMostTime, kMostTime),
            end: end.integer(1 - kMostTime, kMostTime),
          };
        })
      : [],
  };
  data.only("cost", "path", "turns", "tasks", "work");
  if (plan.turns && plan.turns.end !== plan.track.end) turns.fail("as many times as the path has");
  return plan;
}
