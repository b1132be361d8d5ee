// SPDX-License-Identifier: MIT
// What a certificate says, in words.

import { plural } from "../page/dom";
import type { Model } from "../page/model";
import { demandOf, type Certificate, type Demand, type Statement, type Step } from "./certificate";

function times({ begin, end }: Demand): string {
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

export function demandText({ agents, tasks, world }: Model, demand: Demand): string {
  const agent = agents[demand.agent].name;
  const [first, second] = demand.places.map((place) => world.place(place));
  switch (demand.kind) {
    case "bar": return `${agent} is not on ${first} ${times(demand)}`;
    case "move": return `${agent} does not go from ${first} to ${second}, arriving ${times(demand)}`;
    case "norest": return `${agent} does not come to rest on ${first} by ${demand.end}`;
    case "rest": return `${agent} comes to rest on ${first} by ${demand.end}`;
    case "pass":
      return `${agent} does not come through the passage by ${first} to ${second}, arriving ${times(demand)}`;
    case "stop": return `${agent} does ${tasks[demand.task].name} as its stop ${demand.stop + 1}`;
    case "nostop": return `${agent} does another than ${tasks[demand.task].name} as its stop ${demand.stop + 1}`;
  }
}

// What leads to a step, as its row has it.
export function stepText(model: Model, statement: Statement, step: Step): string {
  const demand = demandOf(step);
  if (!demand) return statement.demands.length > 0 ? "All plans that meet its demands" : "All plans";
  if (step.above!.step.kind !== "later") return demandText(model, demand);
  return `${model.agents[demand.agent].name} costs more than ${demand.end}`;
}

// What a step comes to, in a word or two.
export function noteText({ kind, lemmas, leaves, rows }: Step): string {
  switch (kind) {
    case "leaf": return lemmas.length === 0 ? "own costs" : lemmasText(lemmas);
    case "joint": return "joint search";
    case "prices": return plural(rows.length, "price");
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
  const plans = following ? "plan" : "plan in which nobody enters a place as another leaves it";
  return theorem.bound === Infinity ? `There is no ${plans}`
    : `No ${plans} costs less than ${numberText(theorem.bound)}`;
}

export function howText({ theorem, lemmas }: Certificate): string {
  const { root, steps } = theorem;
  if (root.kind === "joint") return "proven by a search of all agents' joint paths";
  if (root.kind === "prices") return `proven by ${plural(root.rows.length, "price")} of places, moves and finish times`;
  const splits = steps.filter(({ sides }) => sides.length > 0).length;
  return `proven by ${plural(splits, "split")}, ${leavesText(root.leaves)} and ${plural(lemmas.length, "lemma")}`;
}

// Of a plan: what the theorem says of it.
export function planText(cost: number, bound: number): string {
  if (cost < bound) return "which is less: one of the two is wrong";
  if (cost === bound) return "so it is optimal";
  if (bound === 0) return "which says nothing of how near it is to the best";
  return `so it costs at most ${((100 * (cost - bound)) / bound).toFixed(2)} % more than the best`;
}

export function lemmaText(model: Model, { agents, bound }: Statement): string {
  const who = agentsText(model, agents);
  if (bound === Infinity) return `there is no way for ${who}`;
  return `${who} ${agents.length === 1 ? "costs" : "cost together"} ${numberText(bound)} or more`;
}

// Why each plan meets one of the two; empty: docs/proof.md has no such split. (Of passages only what
// the demands tell: whether there is one, this page does not know.)
export function whyText(model: Model, following: boolean, step: Step): string {
  const { world, agents } = model;
  const [a, b] = step.sides;
  const both = `${agents[a.agent].name} and ${agents[b.agent].name}`;
  const [place, to] = a.places.map((p) => world.place(p));
  const [from, next] = b.places.map((p) => world.place(p));
  const areTwo = a.agent !== b.agent;
  const isOneTime = a.begin === a.end && b.begin === b.end;
  if (step.kind === "later")
    return `Else ${both} cost together at most ${numberText(a.end + b.end)}, and lemma ${step.lemmas[0]} says that they cost more.`;
  switch (`${a.kind} ${b.kind}`) {
    case "bar bar":
      if (!areTwo || !isOneTime || place !== from) return "";
      if (a.begin === b.begin) return `Else ${both} are on ${place} at ${a.begin}.`;
      return following || Math.abs(a.begin - b.begin) !== 1 ? ""
        : `Else one of ${both} enters ${place} at ${Math.max(a.begin, b.begin)}, as the other leaves it, or they meet there.`;
    case "move move":
      return areTwo && isOneTime && a.begin === b.begin && place === next && to === from
        ? `Else ${both} swap ${place} and ${to}, arriving at ${a.begin}.` : "";
    case "pass pass":
      return areTwo && a.end + b.end < Infinity
        ? `Else ${both} come through one passage against each other, at times so near that they meet in it.` : "";
    case "norest rest":
      return !areTwo && place === from && a.end === b.end
        ? `Either is the contrary of the other. With the second, nobody else is on ${place} from ${b.end} on.` : "";
    case "stop nostop":
      return !areTwo && a.stop === b.stop && a.task === b.task ? "Either is the contrary of the other." : "";
    default:
      return "";
  }
}

// Why a step that is no split has what its statement says.
export function closedText(model: Model, { agents, bound }: Statement, step: Step): string {
  const much = bound === Infinity ? "there is no way" : `together ${numberText(bound)} or more`;
  switch (step.kind) {
    case "joint":
      return `By a search of all joint paths of ${agentsText(model, agents)} that meet the demands: ` +
        (bound === Infinity ? "there are none without conflict." : `none without conflict costs less than ${numberText(bound)}.`);
    case "prices":
      return "By prices of places, moves and pairs of finish times, of which at most one agent uses each: what each agent " +
        "costs at least with prices to pay, less the sum of all prices, bounds what all of them cost.";
    default:
      if (step.lemmas.length > 0)
        return `By the agents' own costs, and what ${lemmasText(step.lemmas)} ` +
          `${step.lemmas.length === 1 ? "adds" : "add"} to them: ${much}.`;
      if (bound === Infinity) return "By the agents' own costs: one of them has no way.";
      return agents.length === 1 ? `By the agent's own cost: ${numberText(bound)} or more.`
        : `By the agents' own costs: ${much}.`;
  }
}
