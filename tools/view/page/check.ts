// SPDX-License-Identifier: MIT
// What is wrong with a plan, by the contract (docs/design.md, sections 1 and 5) and from the page's
// data alone: each robot by itself, then all of them through time on one map of who is where, then
// what the file claims. The page believes no verdict but its own.

import { finish, visitTime } from "./facts";
import type { Agent, AgentPlan, Angle, Model, Plan, WorkTime } from "./model";

export type Kind =
  | "path" | "start" | "jump" | "turn" | "work" | "end" | "visit" | "order" | "vertex" | "swap"
  | "cost" | "claim";

export interface Violation {
  time: number;
  kind: Kind;
  agents: number[];
  place: number; // -1: no matter
  text: string;
}

const kMost = 1000; // violations; who has so many needs no more

// All of them, in order of time.
export function check(model: Model, plan: Plan): Violation[] {
  const checker = new Checker(model, plan);
  while (!checker.step(1000));
  return checker.violations;
}

// The same a few milliseconds at a time.
export class Checker {
  readonly violations: Violation[] = [];
  done = false;
  private agent = 0; // the next one to be checked
  private time = 0; // the next moment
  private readonly end: number;
  private readonly here: Int32Array; // by agent
  private readonly before: Int32Array;
  private readonly runs: Int32Array;
  private readonly occupant: Int32Array; // by place, valid where its stamp is that of a time
  private readonly stamp: Int32Array;

  constructor(
    private readonly model: Model,
    private readonly plan: Plan,
  ) {
    const count = plan.agents.length;
    this.end = plan.agents.reduce((end, agent) => Math.max(end, agent.track.end), 0);
    this.here = new Int32Array(count);
    this.before = new Int32Array(count);
    this.runs = new Int32Array(count);
    this.occupant = new Int32Array(model.world.places);
    this.stamp = new Int32Array(model.world.places).fill(-1);
  }

  // Works for about so long; true when all is known.
  step(milliseconds: number): boolean {
    const until = performance.now() + milliseconds;
    while (!this.done) {
      if (this.violations.length >= kMost) this.close();
      else if (this.agent < this.plan.agents.length) this.checkAgent(this.agent++);
      else if (this.time <= this.end && this.plan.agents.length > 0) this.checkMoment(this.time++);
      else this.close();
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

  private checkAgent(index: number): void {
    const plan = this.plan.agents[index];
    const agent = this.model.agents[index];
    if (plan.track.isEmpty) {
      this.add("path", 0, [index], -1, `${agent.id} has no path`);
      return;
    }
    new AgentCheck(this.model, agent, plan, (kind, time, text, place) =>
      this.add(kind, time, [index], place, `${agent.id} ${text}`),
    ).run();
  }

  // Who is where at `time`; who exchanges places in the step before it.
  private checkMoment(time: number): void {
    const { agents } = this.plan;
    this.before.set(this.here);
    for (let i = 0; i < agents.length; ++i) {
      const { track } = agents[i];
      if (track.isEmpty) continue;
      this.runs[i] = track.run(time, this.runs[i]);
      this.here[i] = track.place(time, this.runs[i]);
    }
    if (time > 0) this.checkSwaps(time);
    for (let i = 0; i < agents.length; ++i) {
      if (agents[i].track.isEmpty) continue;
      const place = this.here[i];
      if (this.stamp[place] === time) this.report("vertex", time, this.occupant[place], i);
      this.stamp[place] = time;
      this.occupant[place] = i;
    }
  }

  // Before the moment is stamped, occupants are those of the step before.
  private checkSwaps(time: number): void {
    for (let i = 0; i < this.here.length; ++i) {
      const [from, to] = [this.before[i], this.here[i]];
      if (from === to || this.stamp[to] !== time - 1 || this.plan.agents[i].track.isEmpty) continue;
      const other = this.occupant[to];
      if (other < i && this.before[other] === to && this.here[other] === from)
        this.report("swap", time, other, i);
    }
  }

  private report(kind: "vertex" | "swap", time: number, a: number, b: number): void {
    const [first, second] = [this.model.agents[a].id, this.model.agents[b].id];
    const where = this.model.world.place(this.here[b]);
    const text = kind === "vertex"
      ? `${first} and ${second} are both on ${where}`
      : `${first} and ${second} change places at ${where}`;
    this.add(kind, time, [a, b], this.here[b], text);
  }

  private checkClaims(): void {
    const { agents, claims } = this.plan;
    if (agents.length === 0) {
      this.add("claim", 0, [], -1, "there is no plan");
      return;
    }
    const cost = agents.reduce((sum, plan) => sum + finish(plan), 0);
    if (claims.cost !== undefined && claims.cost !== cost)
      this.add("cost", this.end, [], -1, `the costs add up to ${cost}, but the plan says ${claims.cost}`);
    const wrong = wrongClaim(this.plan, cost);
    if (wrong) this.add("claim", this.end, [], -1, wrong);
  }
}

// What status, bound and omega deserve.
function wrongClaim(plan: Plan, cost: number): string | null {
  const { status, lower_bound: bound, omega } = plan.claims;
  if (status === undefined || bound === undefined || omega === undefined) return null;
  if (bound < 0) return `the lower bound is ${bound}, below 0`;
  if (bound > cost) return `the lower bound ${bound} is above the cost ${cost}`;
  const deserved = cost === bound ? "optimal" : accepts(omega, cost, bound) ? "bounded" : "feasible";
  return status === deserved ? null : `the status is ${status}, but cost and bound make it ${deserved}`;
}

// cost <= (1 + omega) * bound, exactly: omega is a decimal of at most nine places. (Infinite omega
// promises nothing.)
function accepts(omega: string, cost: number, bound: number): boolean {
  if (omega === "inf") return false;
  const match = /^([0-9]+)(?:\.([0-9]{1,9}))?$/.exec(omega);
  if (!match) return false;
  const unit = BigInt(1_000_000_000);
  const billionths = BigInt(match[1]) * unit + BigInt((match[2] ?? "").padEnd(9, "0"));
  return BigInt(cost) * unit <= BigInt(bound) * (unit + billionths);
}

type Report = (kind: Kind, time: number, text: string, place: number) => void;

// One robot, as if it were alone.
class AgentCheck {
  constructor(
    private readonly model: Model,
    private readonly agent: Agent,
    private readonly plan: AgentPlan,
    private readonly report: Report,
  ) {}

  run(): void {
    this.checkStart();
    this.checkSteps();
    this.checkWork();
    this.checkEnd();
    this.checkVisits();
    this.checkOrder();
    const rest = finish(this.plan);
    if (this.plan.cost !== null && this.plan.cost !== rest)
      this.report("cost", rest, `comes to rest at ${rest}, but the plan says ${this.plan.cost}`, -1);
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
      this.report("start", 0, `begins on ${this.name(at)}, not on its start ${this.name(start)}`, at);
    else if (this.plan.turns && !sameAngle(angle, startAngle))
      this.report("start", 0, "does not look at the start where it should", at);
    if (!this.model.world.free[at]) this.report("jump", 0, `is on ${this.name(at)}, which is blocked`, at);
  }

  private checkSteps(): void {
    const { track, turns } = this.plan;
    for (let run = 0; run < track.runs; ++run) {
      const delta = track.deltas[run];
      if (delta === 0) continue;
      for (let time = track.times[run]; time < track.times[run + 1]; ++time) this.checkMove(time);
    }
    if (!turns) return;
    for (let run = 0; run < turns.runs; ++run) {
      if (turns.jumps[run])
        this.report("turn", turns.times[run + 1], "turns in a way that is no step of a turn", this.place(turns.times[run]));
      if (turns.deltas[run] === 0) continue;
      for (let time = turns.times[run]; time < turns.times[run + 1]; ++time)
        this.checkTurn(time, turns.deltas[run]);
    }
  }

  private checkMove(time: number): void {
    const { world } = this.model;
    const [from, to] = [this.place(time), this.place(time + 1)];
    if (!world.mayMove(from, to)) {
      const why = world.free[to] ? "which is no step" : "which is blocked";
      this.report("jump", time + 1, `goes from ${this.name(from)} to ${this.name(to)}, ${why}`, to);
      return;
    }
    if (!this.plan.turns) return;
    const [before, after] = [this.angle(time), this.angle(time + 1)];
    const ahead = before.direction === 0 && sameAngle(before, after) &&
      to - from === this.stepAhead(before.steps / this.agent.turnSteps);
    if (!ahead) this.report("turn", time + 1, `goes to ${this.name(to)}, which is not ahead of it`, to);
  }

  private stepAhead(heading: number): number {
    const { columns } = this.model.world;
    return [-columns, 1, columns, -1][heading];
  }

  // A turn once begun is completed.
  private checkTurn(time: number, by: number): void {
    const { direction } = this.angle(time);
    if (direction !== 0 && direction !== by)
      this.report("turn", time + 1, "turns back within a turn", this.place(time));
  }

  private checkWork(): void {
    const { work } = this.plan;
    work.forEach((piece, k) => {
      this.checkPiece(piece);
      for (const other of work.slice(0, k)) {
        if (other.task === piece.task)
          this.report("work", piece.begin, `does ${this.taskName(piece)} twice`, -1);
        else if (other.begin < piece.end && piece.begin < other.end)
          this.report("work", piece.begin, `works on ${this.taskName(other)} and ${this.taskName(piece)} at once`, -1);
      }
    });
    const { working } = this.agent;
    if (working && !work.some((w) => w.task === working.task && w.begin === -working.done))
      this.report("work", 0, `does not go on with ${this.model.tasks[working.task].id}, at which it starts`, -1);
  }

  private taskName(piece: WorkTime): string {
    return this.model.tasks[piece.task].id;
  }

  private checkPiece(piece: WorkTime): void {
    const task = this.model.tasks[piece.task];
    if (!this.agent.tasks.includes(piece.task) || task.duration === 0) {
      this.report("work", piece.begin, `works on ${task.id}, which is no work of its own`, -1);
      return;
    }
    if (piece.end - piece.begin !== task.duration)
      this.report("work", piece.begin, `works on ${task.id} from ${piece.begin} to ${piece.end}, which takes ${task.duration}`, task.place);
    const { working } = this.agent;
    const begun = working !== null && working.task === piece.task && working.done === -piece.begin;
    if (piece.begin < 0 && !begun)
      this.report("work", 0, `begins ${task.id} before the start`, task.place);
    if (piece.end < 0) return;
    const first = Math.max(0, piece.begin);
    if (this.place(first) !== task.place)
      this.report("work", first, `works on ${task.id} on ${this.name(this.place(first))}, not on ${this.name(task.place)}`, this.place(first));
    this.checkStill(first, piece);
  }

  // No step of any kind at work.
  private checkStill(first: number, piece: WorkTime): void {
    const { track, turns } = this.plan;
    const last = Math.min(piece.end, track.end);
    const angle = this.angle(first);
    for (let time = first + 1; time <= last; ++time) {
      if (this.place(time) === this.place(first) && (!turns || sameAngle(this.angle(time), angle))) continue;
      this.report("work", time, `moves at work on ${this.taskName(piece)}`, this.place(time));
      return;
    }
  }

  private checkEnd(): void {
    const { goal, goalAngle, tasks } = this.agent;
    const end = this.plan.track.end;
    const at = this.place(end);
    const angle = this.angle(end);
    if (goal >= 0 && at !== goal)
      this.report("end", end, `ends on ${this.name(at)}, not on its destination ${this.name(goal)}`, at);
    else if (goalAngle >= 0 && (angle.direction !== 0 || angle.steps !== goalAngle))
      this.report("end", end, "does not look at the end where it should", at);
    if (goal < 0 && tasks.length > 0 && !tasks.some((task) => this.model.tasks[task].place === at))
      this.report("end", end, `ends on ${this.name(at)}, where it has no task`, at);
  }

  private checkVisits(): void {
    for (const index of this.agent.tasks) {
      const task = this.model.tasks[index];
      if (visitTime(this.model, this.plan, index) === Infinity || this.visit(index, 0) === Infinity)
        this.report("visit", this.plan.track.end, `never ${task.duration > 0 ? "does" : "visits"} ${task.id} on ${this.name(task.place)}`, task.place);
    }
  }

  // The first time from `begin` on at which the task counts as visited.
  private visit(index: number, begin: number): number {
    const task = this.model.tasks[index];
    const { track, work } = this.plan;
    if (task.duration > 0) {
      const piece = work.find((w) => w.task === index);
      return piece && piece.end >= begin ? piece.end : Infinity;
    }
    for (let time = begin; time <= track.end; ++time)
      if (track.place(time) === task.place) return time;
    return begin > track.end && track.place(track.end) === task.place ? begin : Infinity;
  }

  private checkOrder(): void {
    const order = this.plan.tasks;
    if (!order) return;
    const sorted = (tasks: number[]) => [...tasks].sort((a, b) => a - b).join();
    if (sorted(order) !== sorted(this.agent.tasks)) {
      this.report("order", 0, "does not have each of its tasks once in its order", -1);
      return;
    }
    let now = 0;
    for (const task of order) {
      now = this.visit(task, now);
      if (now !== Infinity) continue;
      this.report("order", this.plan.track.end, `does not visit ${this.model.tasks[task].id} in this order`, -1);
      return;
    }
    this.checkLastOfOrder(order);
  }

  // Without a destination it rests on the last one; with work the last may be elsewhere.
  private checkLastOfOrder(order: number[]): void {
    const { goal, tasks } = this.agent;
    if (goal >= 0 || order.length === 0) return;
    if (tasks.some((task) => this.model.tasks[task].duration > 0)) return;
    const end = this.plan.track.end;
    const last = this.model.tasks[order[order.length - 1]];
    if (this.place(end) !== last.place)
      this.report("order", end, `ends on ${this.name(this.place(end))}, not on ${last.id}, the last of its order`, this.place(end));
  }
}

function sameAngle(a: Angle, b: Angle): boolean {
  return a.steps === b.steps && a.direction === b.direction;
}
