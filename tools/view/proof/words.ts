// SPDX-License-Identifier: MIT
// Texts for constraints, steps and statements.

import { plural } from "../page/dom";
import type { Model } from "../page/model";
import { constraintOf, type Certificate, type Constraint, type Statement, type Step } from "./certificate";

function times({ begin, end }: Constraint): string {
  if (end === Infinity) return `from ${begin} on`;
  return begin === end ? `at ${begin}` : `from ${begin} to ${end}`;
}

function listed(words: string[]): string {
  if (words.length < 2) return words.join();
  return `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}

const kMostNamed = 6;

export function agentsText({ agents }: Model, which: number[]): string {
  if (which.length === agents.length && which.length > 2) return `all ${which.length} agents`;
  if (which.length > kMostNamed) return plural(which.length, "agent");
  return listed(which.map((agent) => agents[agent].name));
}

export function constraintText({ agents, tasks, world }: Model, constraint: Constraint): string {
  const agent = agents[constraint.agent].name;
  const [first, second] = constraint.places.map((place) => world.place(place));
  switch (constraint.kind) {
    case "bar": return `${agent} is not on ${first} ${times(constraint)}`;
    case "move": return `${agent} does not go from ${first} to ${second}, arriving ${times(constraint)}`;
    case "norest": return `${agent} does not come to rest on ${first} by ${constraint.end}`;
    case "rest": return `${agent} comes to rest on ${first} by ${constraint.end}`;
    case "pass":
      return `${agent} does not pass through the corridor and leave it from ${first} to ${second}, arriving ${times(constraint)}`;
    case "stop": return `${agent} does ${tasks[constraint.task].name} as its stop ${constraint.stop + 1}`;
    case "nostop": return `${agent} does another task than ${tasks[constraint.task].name} as its stop ${constraint.stop + 1}`;
  }
}

// Returns the text in the row of a step: the constraint that leads to it.
export function stepText(model: Model, statement: Statement, step: Step): string {
  const constraint = constraintOf(step);
  if (!constraint) return statement.constraints.length > 0 ? "All plans that satisfy its constraints" : "All plans";
  if (step.above!.step.kind !== "later") return constraintText(model, constraint);
  return `${model.agents[constraint.agent].name} costs more than ${constraint.end}`;
}

// Returns a short note on how a step is proven.
export function noteText({ kind, lemmas, leaves, rows, cores }: Step): string {
  switch (kind) {
    case "leaf": return lemmas.length === 0 ? "individual costs" : lemmasText(lemmas);
    case "joint": return "joint search";
    case "prices": return plural(rows.length, "multiplier");
    case "formula": return plural(cores, "core");
    default: return leavesText(leaves);
  }
}

function leavesText(count: number): string {
  return count === 1 ? "1 leaf" : `${numberText(count)} leaves`;
}

export function lemmasText(lemmas: number[]): string {
  return `${lemmas.length === 1 ? "lemma" : "lemmas"} ${listed(lemmas.map(String))}`;
}

export function numberText(value: number): string {
  return value.toLocaleString("en");
}

export function theoremText({ theorem, following }: Certificate): string {
  const plans = following ? "plan" : "plan in which no agent enters a place as another leaves it";
  return theorem.bound === Infinity ? `There is no ${plans}`
    : `No ${plans} costs less than ${numberText(theorem.bound)}`;
}

export function howText({ theorem, lemmas }: Certificate): string {
  const { root, steps } = theorem;
  if (root.kind === "joint") return "proven by a search of all agents' joint paths";
  if (root.kind === "prices") return `proven by ${plural(root.rows.length, "multiplier")} of places, moves and finish times`;
  if (root.kind === "formula") return `proven by ${plural(root.cores, "unsatisfiable core")}`;
  const splits = steps.filter(({ sides }) => sides.length > 0).length;
  return `proven by ${plural(splits, "split")}, ${leavesText(root.leaves)} and ${plural(lemmas.length, "lemma")}`;
}

// Returns what the theorem implies for a plan of this cost.
export function planText(cost: number, bound: number): string {
  if (cost < bound) return "which is less: one of the two is wrong";
  if (cost === bound) return "so it is optimal";
  if (bound === 0) return "which gives no gap";
  return `so it costs at most ${((100 * (cost - bound)) / bound).toFixed(2)} % more than the best`;
}

export function lemmaText(model: Model, { agents, bound }: Statement): string {
  const who = agentsText(model, agents);
  if (bound === Infinity) return `there is no path for ${who}`;
  return `${who} ${agents.length === 1 ? "costs" : "together cost"} ${numberText(bound)} or more`;
}

// Explains why each plan satisfies at least one of the two constraints; empty: docs/proof.md has no
// such split. Does not check that the places of `pass` belong to a corridor.
export function whyText(model: Model, following: boolean, step: Step): string {
  const { world, agents } = model;
  const [a, b] = step.sides;
  const both = `${agents[a.agent].name} and ${agents[b.agent].name}`;
  const [place, to] = a.places.map((p) => world.place(p));
  const [from, next] = b.places.map((p) => world.place(p));
  const areTwo = a.agent !== b.agent;
  const isOneTime = a.begin === a.end && b.begin === b.end;
  if (step.kind === "later")
    return `Otherwise ${both} together cost at most ${numberText(a.end + b.end)}, and by lemma ${step.lemmas[0]} they cost more.`;
  switch (`${a.kind} ${b.kind}`) {
    case "bar bar":
      if (!areTwo || !isOneTime || place !== from) return "";
      if (a.begin === b.begin) return `Otherwise ${both} are on ${place} at ${a.begin}.`;
      return following || Math.abs(a.begin - b.begin) !== 1 ? ""
        : `Otherwise one of ${both} enters ${place} at ${Math.max(a.begin, b.begin)}, as the other leaves it, or they meet there.`;
    case "move move":
      return areTwo && isOneTime && a.begin === b.begin && place === next && to === from
        ? `Otherwise ${both} swap ${place} and ${to}, arriving at ${a.begin}.` : "";
    case "pass pass":
      return areTwo && a.end + b.end < Infinity
        ? `Otherwise ${both} pass through one corridor in opposite directions, at times so close that they meet in it.` : "";
    case "norest rest":
      return !areTwo && place === from && a.end === b.end
        ? `Each is the negation of the other. With the second, no other agent is on ${place} from ${b.end} on.` : "";
    case "stop nostop":
      return !areTwo && a.stop === b.stop && a.task === b.task ? "Each is the negation of the other." : "";
    default:
      return "";
  }
}

// Explains how a step without children proves its statement.
export function closedText(model: Model, { agents, bound }: Statement, step: Step): string {
  const much = bound === Infinity ? "there is no path" : `together ${numberText(bound)} or more`;
  switch (step.kind) {
    case "joint":
      return `By a search of all joint paths of ${agentsText(model, agents)} that satisfy the constraints: ` +
        (bound === Infinity ? "there are none without conflict." : `none without conflict costs less than ${numberText(bound)}.`);
    case "prices":
      return "By multipliers of places, moves and pairs of finish times, each of which at most one agent uses: the least costs of " +
        "the agents including multipliers, minus the sum of all multipliers, are a lower bound on the cost of all agents.";
    case "formula":
      return `By ${plural(step.cores, "unsatisfiable core")}: sets of limits on the costs of agents, found by a SAT solver. No plan ` +
        "meets all limits of a set. Together they prove a lower bound on the cost of all agents.";
    default:
      if (step.lemmas.length > 0)
        return `By the agents' individual costs, and the excess by ${lemmasText(step.lemmas)}: ${much}.`;
      if (bound === Infinity) return "By the agents' individual costs: one of them has no path.";
      return agents.length === 1 ? `By the agent's individual cost: ${numberText(bound)} or more.`
        : `By the agents' individual costs: ${much}.`;
  }
}
