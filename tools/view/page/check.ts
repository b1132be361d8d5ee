// SPDX-License-Identifier: MIT
// Finds the violations of a plan, from the contract (docs/design.md, sections 1 and 5) and the data of the
// page only. It checks first each robot by itself, then the needs of tasks, then collisions, then the claims of
// the file. The page relies on no other verdict.

import { Occupancy, type ReportCollision } from "./occupancy";
import { finish } from "./facts";
import { hasChoice, hasDestination, hasStatedVisits } from "./model";
import type { Agent, AgentPlan, Angle, Model, Plan, WorkTime } from "./model";
import type { Track, TurnTrack } from "./track";

export type Kind =
  | "path" | "start" | "jump" | "turn" | "work" | "end" | "visit" | "order" | "need" | "vertex" | "swap"
  | "cost" | "claim";

export interface Violation {
  time: number;
  kind: Kind;
  agents: number[];
  place: number; // where it occurs; -1: nowhere in particular
  text: string;
  task?: number; // of a need that is not met
}

const kMost = 1000; // violations, after which the search stops
const kStepsAtOnce = 2048; // steps of one robot between two checks of the elapsed time

// Returns all violations, but at most kMost, in order of time.
export function check(model: Model, plan: Plan): Violation[] {
  const checker = new Checker(model, plan);
  while (!checker.step(1000));
  return checker.violations;
}

// Searches for violations, for about the requested time per call of step().
export class Checker {
  readonly violations: Violation[] = [];
  done = false;
  private readonly parts: Generator<void>;
  private readonly end: number;

  constructor(
    private readonly model: Model,
    private readonly plan: Plan,
  ) {
    this.end = plan.agents.reduce((end, agent) => Math.max(end, agent.track.end), 0);
    this.parts = this.checkAll();
  }

  // Continues the search for about this time. Returns whether it is complete.
  step(milliseconds: number): boolean {
    const until = performance.now() + milliseconds;
    while (!this.done) {
      if (this.violations.length >= kMost || this.parts.next().done) this.close();
      if (performance.now() > until) break;
    }
    return this.done;
  }

  private close(): void {
    this.checkClaims();
    this.violations.sort((a, b) => a.time - b.time);
    this.done = true;
  }

  private add(kind: Kind, time: number, agents: number[], place: number, text: string): void {
    if (this.violations.length < kMost) this.violations.push({ time, kind, agents, place, text });
  }

  // Checks everything except the claims. Yields wherever the search may be interrupted.
  private *checkAll(): Generator<void> {
    for (let index = 0; index < this.plan.agents.length; ++index) {
      yield* this.checkAgent(index);
      yield;
    }
    yield* this.checkNeeds();
    yield* this.checkMoments();
  }

  private *checkAgent(index: number): Generator<void> {
    const plan = this.plan.agents[index];
    const agent = this.model.agents[index];
    if (plan.track.isEmpty) {
      this.add("path", 0, [index], -1, `${agent.name} has no path`);
      return;
    }
    const check = new AgentCheck(this.model, index, plan, (kind, time, text, place) =>
      this.add(kind, time, [index], place, `${agent.name} ${text}`));
    yield* check.run();
  }

  // Finds tasks with a choice of robots that too few of their robots visit. (If all robots must visit a task, the
  // check of each robot finds its missing visit.)
  private *checkNeeds(): Generator<void> {
    const visitors = new Map<number, Set<number>>(); // by task
    for (let robot = 0; robot < this.plan.agents.length; ++robot) {
      for (const { task } of this.plan.agents[robot].work) {
        if (!visitors.has(task)) visitors.set(task, new Set());
        visitors.get(task)!.add(robot);
      }
      yield;
    }
    for (let index = 0; index < this.model.tasks.length && this.plan.agents.length > 0; ++index) {
      const task = this.model.tasks[index];
      if (!hasChoice(task)) continue;
      const count = [...visitors.get(index) ?? []].filter((robot) => task.agents.includes(robot)).length;
      if (count < task.need && this.violations.length < kMost)
        this.violations.push({ time: this.end, kind: "need", agents: [], place: task.place, task: index,
          text: `${task.name} is visited by ${count} of its ${task.agents.length} robots, but needs ${task.need}` });
      yield;
    }
  }

  // Finds, for each time, robots on the same place, and robots that swapped places in the step before.
  private *checkMoments(): Generator<void> {
    const occupancy = new Occupancy(this.plan, this.model.world.places);
    const report: ReportCollision = (kind, time, a, b) =>
      this.reportCollision(kind, time, a, b, occupancy.here[b]);
    for (let time = 0; time <= this.end; ++time) {
      occupancy.advance(report);
      yield;
    }
  }

  private reportCollision(
    kind: "vertex" | "swap", time: number, a: number, b: number, place: number,
  ): void {
    const [first, second] = [this.model.agents[a].name, this.model.agents[b].name];
    const where = this.model.world.place(place);
    const text = kind === "vertex"
      ? `${first} and ${second} are both on ${where}`
      : `${first} and ${second} change places at ${where}`;
    this.add(kind, time, [a, b], place, text);
  }

  private checkClaims(): void {
    const { agents, claims } = this.plan;
    if (agents.length === 0) {
      this.add("claim", 0, [], -1, "there is no plan");
      return;
    }
    const cost = agents.reduce((sum, plan) => sum + finish(plan), 0);
    if (claims.cost !== undefined && claims.cost !== cost)
      this.add("cost", this.end, [], -1,
        `the costs add up to ${cost}, but the plan claims ${claims.cost}`);
    const wrong = wrongClaim(this.plan, cost);
    if (wrong) this.add("claim", this.end, [], -1, wrong);
  }
}

// Returns what is wrong with the claimed bound and status, given the computed cost; null: nothing, or the
// plan does not claim all of status, bound and omega.
function wrongClaim(plan: Plan, cost: number): string | null {
  const { status, lower_bound: bound, omega } = plan.claims;
  if (status === undefined || bound === undefined || omega === undefined) return null;
  if (bound < 0) return `the lower bound is ${bound}, below 0`;
  if (bound > cost) return `the lower bound ${bound} is above the cost ${cost}`;
  const isWithin = accepts(omega, cost, bound);
  const deserved = cost === bound ? "optimal" : isWithin ? "bounded" : "feasible";
  if (status === deserved) return null;
  return `the status is ${status}, but cost and bound make it ${deserved}`;
}

// Returns whether cost <= (1 + omega) * bound, in exact arithmetic. `omega` is a decimal fraction, perhaps
// with an exponent ("1e-05"). If it is infinite, returns false, because the plan promises nothing.
function accepts(omega: string, cost: number, bound: number): boolean {
  const match = /^([0-9]{1,20})(?:\.([0-9]{1,20}))?(?:e([+-][0-9]{1,2}))?$/.exec(omega);
  if (!match) return false;
  const [, whole, fraction = "", exponent = "0"] = match;
  const shift = Number(exponent) - fraction.length;
  const ten = BigInt(10);
  const unit = ten ** BigInt(Math.max(0, -shift));
  const parts = BigInt(whole + fraction) * ten ** BigInt(Math.max(0, shift)); // omega = parts / unit
  return BigInt(cost) * unit <= BigInt(bound) * (unit + parts);
}

type Report = (kind: Kind, time: number, text: string, place: number) => void;

// Checks the path, task executions and visits of one robot, without regard to other robots.
class AgentCheck {
  private steps = 0;
  private readonly agent: Agent;
  private readonly ownTasks: number[]; // tasks that it must visit, and those of which the plan states its visit

  constructor(
    private readonly model: Model,
    private readonly index: number,
    private readonly plan: AgentPlan,
    private readonly report: Report,
  ) {
    this.agent = model.agents[index];
    this.ownTasks = [...new Set([...this.agent.tasks, ...plan.work.map(({ task }) => task)])];
  }

  *run(): Generator<void> {
    this.checkStart();
    yield* this.checkMoves();
    yield* this.checkTurns();
    yield* this.checkWork();
    this.checkEnd();
    yield* this.checkVisits();
    yield* this.checkOrder();
    const rest = finish(this.plan);
    if (this.plan.cost !== null && this.plan.cost !== rest)
      this.report("cost", rest,
        `comes to rest at ${rest}, but the plan claims ${this.plan.cost}`, -1);
  }

  private hasDoneEnough(): boolean {
    return ++this.steps % kStepsAtOnce === 0;
  }
  private name(place: number): string {
    return this.model.world.place(place);
  }
  private place(time: number): number {
    return this.plan.track.place(time);
  }
  private angle(time: number): Angle {
    return this.plan.turns ? this.plan.turns.at(time) : { steps: 0, direction: 0 };
  }

  private checkStart(): void {
    const { start, startAngle } = this.agent;
    const at = this.place(0);
    const angle = this.angle(0);
    if (at !== start)
      this.report("start", 0,
        `begins on ${this.name(at)}, not on its start ${this.name(start)}`, at);
    else if (this.plan.turns && !sameAngle(angle, startAngle))
      this.report("start", 0, "does not have its heading at the start", at);
    if (!this.model.world.free[at])
      this.report("jump", 0, `is on ${this.name(at)}, which is blocked`, at);
  }

  private *checkMoves(): Generator<void> {
    const { track } = this.plan;
    for (let run = 0; run < track.runs; ++run) {
      if (this.hasDoneEnough()) yield;
      const delta = track.deltas[run];
      if (delta === 0) continue;
      let from = track.places[run];
      for (let time = track.times[run]; time < track.times[run + 1]; ++time, from += delta) {
        this.checkMove(time, from, from + delta);
        if (this.hasDoneEnough()) yield;
      }
    }
  }

  private *checkTurns(): Generator<void> {
    const { turns } = this.plan;
    if (!turns) return;
    for (let run = 0; run < turns.runs; ++run) {
      if (this.hasDoneEnough()) yield;
      if (turns.jumps[run])
        this.report("turn", turns.times[run + 1], "turns in a way that is not a step of a turn",
          this.place(turns.times[run]));
      if (turns.deltas[run] === 0) continue;
      for (let time = turns.times[run]; time < turns.times[run + 1]; ++time) {
        this.checkTurn(time, turns.deltas[run]);
        if (this.hasDoneEnough()) yield;
      }
    }
  }

  private checkMove(time: number, from: number, to: number): void {
    const { world } = this.model;
    if (!world.mayMove(from, to)) {
      const why = world.free[to] ? "which is not a possible step" : "which is blocked";
      this.report("jump", time + 1, `goes from ${this.name(from)} to ${this.name(to)}, ${why}`, to);
      return;
    }
    if (!this.plan.turns) return;
    const [before, after] = [this.angle(time), this.angle(time + 1)];
    const ahead = before.direction === 0 && sameAngle(before, after) &&
      to - from === this.stepAhead(before.steps / this.agent.turnSteps);
    if (!ahead)
      this.report("turn", time + 1, `goes to ${this.name(to)}, which is not ahead of it`, to);
  }

  private stepAhead(heading: number): number {
    const { columns } = this.model.world;
    return [-columns, 1, columns, -1][heading];
  }

  // Reports a turn that changes direction before it is complete.
  private checkTurn(time: number, by: number): void {
    const { direction } = this.angle(time);
    if (direction !== 0 && direction !== by)
      this.report("turn", time + 1, "turns back within a turn", this.place(time));
  }

  private *checkWork(): Generator<void> {
    const done = new Set<number>();
    for (const piece of this.plan.work) {
      this.checkPiece(piece);
      if (done.has(piece.task))
        this.report("work", piece.begin, `${this.does(piece)} twice`, -1);
      done.add(piece.task);
      yield;
    }
    this.checkOverlaps();
    const { working } = this.agent;
    const continues = (w: WorkTime) =>
      working !== null && w.task === working.task && w.begin === -working.done;
    if (working && !this.plan.work.some(continues))
      this.report("work", 0,
        `does not continue ${this.model.tasks[working.task].name}, at which it starts`, -1);
  }

  // Reports executions of different tasks at the same time. Visits without a duration may coincide with others. In
  // order of their start times, it compares each execution only with the earlier one that ends last.
  private checkOverlaps(): void {
    const executions = this.plan.work.filter(({ task }) => this.model.tasks[task].duration > 0);
    let longest: WorkTime | null = null;
    for (const piece of executions.sort((a, b) => a.begin - b.begin || a.end - b.end)) {
      if (longest && piece.begin < longest.end && piece.task !== longest.task)
        this.report("work", piece.begin,
          `executes ${this.taskName(longest)} and ${this.taskName(piece)} at once`, -1);
      if (!longest || piece.end > longest.end) longest = piece;
    }
  }

  private taskName(piece: WorkTime): string {
    return this.model.tasks[piece.task].name;
  }

  // Returns a text such as "executes t" or, for a task without duration, "visits t".
  private does(piece: WorkTime): string {
    const { duration, name } = this.model.tasks[piece.task];
    return `${duration > 0 ? "executes" : "visits"} ${name}`;
  }

  private checkPiece(piece: WorkTime): void {
    const task = this.model.tasks[piece.task];
    if (!task.agents.includes(this.index)) {
      this.report("work", piece.begin, `${this.does(piece)}, which is not one of its tasks`, -1);
      return;
    }
    if (!hasStatedVisits(task)) {
      this.report("work", piece.begin,
        `has a stated visit of ${task.name}, which it visits by being on its place`, -1);
      return;
    }
    if (piece.end - piece.begin !== task.duration)
      this.report("work", piece.begin,
        `${this.does(piece)} from ${piece.begin} to ${piece.end}, which takes ${task.duration}`,
        task.place);
    const { working } = this.agent;
    const begun = working !== null && working.task === piece.task && working.done === -piece.begin;
    if (piece.begin < 0 && !begun)
      this.report("work", 0, `begins ${task.name} before the start`, task.place);
    if (piece.end < 0) return;
    const first = Math.max(0, piece.begin);
    if (this.place(first) !== task.place)
      this.report("work", first,
        `${this.does(piece)} on ${this.name(this.place(first))}, not on ${this.name(task.place)}`,
        this.place(first));
    this.checkStill(first, piece);
  }

  // Reports a robot that moves or turns while it executes a task, from time `first` on.
  private checkStill(first: number, piece: WorkTime): void {
    const { track, turns } = this.plan;
    const step = Math.min(nextChange(track, first), turns ? nextChange(turns, first) : Infinity);
    if (step <= piece.end)
      this.report("work", step, `moves at work on ${this.taskName(piece)}`, this.place(step));
  }

  private checkEnd(): void {
    const { goal, goals, goalAngle } = this.agent;
    const end = this.plan.track.end;
    const at = this.place(end);
    const angle = this.angle(end);
    if (goal >= 0 && at !== goal)
      this.report("end", end,
        `ends on ${this.name(at)}, not on its destination ${this.name(goal)}`, at);
    else if (goals.length > 0 && !goals.includes(at))
      this.report("end", end,
        `ends on ${this.name(at)}, which is none of the destinations that it may choose`, at);
    else if (goalAngle >= 0 && (angle.direction !== 0 || angle.steps !== goalAngle))
      this.report("end", end, "does not have its heading at the end", at);
    if (!hasDestination(this.agent)) this.checkEndWithoutDestination(end, at, angle);
  }

  private checkEndWithoutDestination(end: number, at: number, angle: Angle): void {
    const { tasks, hasOptions } = this.agent;
    if (tasks.length > 0 && !this.ownTasks.some((task) => this.model.tasks[task].place === at))
      this.report("end", end, `ends on ${this.name(at)}, where it has no task`, at);
    if (tasks.length === 0 && hasOptions && angle.direction !== 0)
      this.report("end", end, "ends within a turn", at);
  }

  private *checkVisits(): Generator<void> {
    for (const index of this.agent.tasks) {
      const task = this.model.tasks[index];
      if (this.timeOfVisit(index, 0) === Infinity)
        this.report("visit", this.plan.track.end,
          `never ${hasStatedVisits(task) ? "does" : "visits"} ${task.name} on ${this.name(task.place)}`,
          task.place);
      yield;
    }
  }

  // Returns the first time from `begin` on at which the task counts as visited; Infinity: never.
  private timeOfVisit(index: number, begin: number): number {
    const task = this.model.tasks[index];
    const { track, work } = this.plan;
    if (!hasStatedVisits(task)) return track.firstTimeOn(task.place, begin);
    const piece = work.find((w) => w.task === index);
    return piece && piece.end >= begin ? piece.end : Infinity;
  }

  private *checkOrder(): Generator<void> {
    const order = this.plan.tasks;
    if (!order) return;
    const sorted = (tasks: number[]) => [...tasks].sort((a, b) => a - b).join();
    if (sorted(order) !== sorted(this.ownTasks)) {
      this.report("order", 0, "does not have each of its tasks exactly once in its order", -1);
      return;
    }
    let now = 0;
    for (const task of order) {
      yield;
      now = this.timeOfVisit(task, now);
      if (now !== Infinity) continue;
      this.report("order", this.plan.track.end,
        `does not visit ${this.model.tasks[task].name} in this order`, -1);
      return;
    }
    this.checkLastOfOrder(order);
  }

  // Reports a robot without a destination that does not rest on the last task of its order. If the plan states
  // one of its visits, the robot may rest on any of its tasks or, if it must visit none, anywhere.
  private checkLastOfOrder(order: number[]): void {
    if (hasDestination(this.agent) || order.length === 0) return;
    if (order.some((task) => hasStatedVisits(this.model.tasks[task]))) return;
    const end = this.plan.track.end;
    const last = this.model.tasks[order[order.length - 1]];
    if (this.place(end) !== last.place)
      this.report("order", end,
        `ends on ${this.name(this.place(end))}, not on ${last.name}, the last of its order`,
        this.place(end));
  }
}

// Returns the first time after `begin` at which the value of the track differs from the value one step before;
// Infinity: never.
function nextChange(track: Track | TurnTrack, begin: number): number {
  for (let run = track.run(begin); run < track.runs; ++run)
    if (track.deltas[run] !== 0 || track.jumps[run]) return Math.max(begin, track.times[run]) + 1;
  return Infinity;
}

function sameAngle(a: Angle, b: Angle): boolean {
  return a.steps === b.steps && a.direction === b.direction;
}
