// SPDX-License-Identifier: MIT
//! Rule `formula` (docs/proof.md, section 4): variables with a meaning, the clauses that hold for every plan, and the steps of a proof by
//! unsatisfiable cores.
use crate::agent::{AgentModel, NEVER};
use crate::clauses::{not, Clauses, Handle, Literal};
use crate::paths::{Node, Paths, Spot};
use crate::rules::{Chains, Constraint, Kind};
use crate::tokens::{ensure, Fault, Tokens};
use std::collections::{BTreeMap, HashMap, HashSet};

type Variable = u32;

fn yes(variable: Variable) -> Literal { 2 * variable }
fn no(variable: Variable) -> Literal { 2 * variable + 1 }

/// An arrival or a visit of an agent: its place and time.
type At = (u32, u32);

/// A node of a graph of paths. `spot.done` is 0, and `done` the set of stops done.
struct NamedNode {
    time: u32,
    place: u32,
    spot: Spot,
    done: u64,
}

/// Variables that state the presence of an agent: one of their own, or those of nodes.
#[derive(Default)]
struct Presences {
    own: HashMap<At, Variable>,
    of_nodes: HashMap<At, Vec<Variable>>,
}

impl Presences {
    /// Lets the variable of a node stand for its presence, unless the presence has its own.
    fn add_node(&mut self, at: At, variable: Variable) {
        if !self.own.contains_key(&at) { self.of_nodes.entry(at).or_default().push(variable); }
    }

    fn at(&self, at: At) -> impl Iterator<Item = Variable> + '_ {
        self.own.get(&at).into_iter().chain(self.of_nodes.get(&at).into_iter().flatten()).copied()
    }

    fn all(&self) -> impl Iterator<Item = (At, Variable)> + '_ {
        let of_nodes = self.of_nodes.iter().flat_map(|(&at, variables)| variables.iter().map(move |&variable| (at, variable)));
        self.own.iter().map(|(&at, &variable)| (at, variable)).chain(of_nodes)
    }
}

/// The variables of one agent.
#[derive(Default)]
struct Agent {
    /// The greatest excess of its paths, if the certificate states one.
    levels: Option<u32>,
    within: BTreeMap<u32, Variable>,
    active: Option<Variable>,
    /// It is on this place at this time, and leaves the place later.
    visits: Presences,
    /// It makes its last arrival.
    lasts: Presences,
    /// It rests on this place at this time.
    rests: BTreeMap<At, Variable>,
    nodes: Vec<(NamedNode, Variable)>,
    known_nodes: HashSet<(u32, Spot, u64)>,
    meets: Vec<(Constraint, Variable)>,
    /// By task with a choice of agents, and whether the agent counts it.
    counts: BTreeMap<(u32, bool), Variable>,
    /// By last inner place and exit of a traversal, and time.
    inside: BTreeMap<(u32, u32, u32), Variable>,
    ends: BTreeMap<(u32, u32, u32), Variable>,
}

impl Agent {
    /// Returns the arrivals on a place at a time, for good or not.
    fn arrivals(&self, at: At) -> impl Iterator<Item = Variable> + '_ {
        self.visits.at(at).chain(self.lasts.at(at))
    }

    /// Returns all arrivals and visits.
    fn presences(&self) -> impl Iterator<Item = (At, Variable)> + '_ {
        self.visits.all().chain(self.lasts.all())
    }

    /// A node without a last arrival is a visit; the node of a last arrival is one.
    fn add_nodes_to_presences(&mut self) {
        for (NamedNode { time, place, spot, .. }, variable) in &self.nodes {
            if spot.since == NEVER { self.visits.add_node((*place, *time), *variable); }
            if spot.since == *time { self.lasts.add_node((*place, *time), *variable); }
        }
    }

    /// Returns `within` with the greatest excess from `low` to `high`.
    fn within(&self, low: u32, high: u32) -> Option<Variable> { self.within.range(low..=high).next_back().map(|found| *found.1) }
}

/// The choices of an instance, and their prices (docs/proof.md, "choices").
#[derive(Default)]
pub struct Choices {
    /// By task.
    pub tasks: Vec<TaskChoice>,
    pub goals: BTreeMap<u32, GoalChoice>,
}

pub struct TaskChoice {
    /// The agents that may visit the task.
    pub agents: Vec<u32>,
    pub need: u32,
    pub price: u32,
}

impl Choices {
    /// Returns by how much the sum of all prices exceeds the cost of a plan. The prices of goals for which no agent pays are part of this
    /// sum.
    pub fn constant(&self) -> u64 {
        let of_task = |task: &TaskChoice| u64::from(task.price) * (task.agents.len() as u64 - u64::from(task.need));
        self.tasks.iter().map(of_task).sum::<u64>() + self.goals.values().map(|goal| u64::from(goal.price)).sum::<u64>()
    }
}

impl TaskChoice {
    fn is_choice(&self) -> bool { (self.need as usize) < self.agents.len() }
}

/// A place where agents with a choice of goals may end.
#[derive(Default)]
pub struct GoalChoice {
    pub agents: Vec<u32>,
    pub price: u32,
}

/// A count of true inputs: the sum, the range of the inputs, and the least number of them.
type Count = (u32, u32, u32, u32);

#[derive(Default)]
pub struct Formula {
    variables: u32,
    agents: Vec<Agent>,
    sums: Vec<Vec<Literal>>,
    counts: BTreeMap<Count, Variable>,
    splits: Vec<(Literal, Literal)>,
    pub choices: Choices,
    /// By literal that states whether an agent counts a task: the task and the agent, and whether it counts.
    counters: HashMap<Literal, ((u32, u32), bool)>,
    /// By goal and unit of its price.
    used: BTreeMap<(u32, u32), Variable>,
    /// A sum, and the greatest number of its inputs that are true.
    limits: Vec<(u32, u32)>,
    /// By literal that states a constraint.
    constraints: HashMap<Literal, Constraint>,
    clauses: Clauses,
    /// The clauses of the certificate, by number.
    steps: Vec<Handle>,
    soft: HashSet<Literal>,
    /// The sum of all excesses is at least this number plus the number of false soft literals.
    raised: u64,
}

impl Formula {
    pub fn new(agents: usize) -> Formula { Formula { agents: (0..agents).map(|_| Agent::default()).collect(), ..Formula::default() } }

    /// Returns a new variable.
    fn variable(&mut self) -> Result<Variable, Fault> {
        ensure(self.variables < 1 << 29, "too many variables")?;
        self.variables += 1;
        Ok(self.variables - 1)
    }

    fn agent(&self, tokens: &mut Tokens) -> Result<usize, Fault> { tokens.index(self.agents.len(), "agent").map(|agent| agent as usize) }

    /// Parses a literal: a variable, from 1, with a minus sign if it is negated.
    fn literal(&self, tokens: &mut Tokens) -> Result<Literal, Fault> {
        let (number, negated) = tokens.signed()?;
        let known = 0 < number && number <= self.variables;
        ensure(known, format!("there is no variable {}", number)).map(|_| yes(number - 1) + u32::from(negated))
    }

    fn literals(&self, tokens: &mut Tokens) -> Result<Vec<Literal>, Fault> {
        let mut found = Vec::new();
        while tokens.more() { found.push(self.literal(tokens)?); }
        Ok(found)
    }

    /// Parses a definition, except for those of nodes and constraints. Returns false if the line is something else.
    pub fn define(&mut self, name: &str, tokens: &mut Tokens, places: usize, chains: &Chains) -> Result<bool, Fault> {
        match name {
            "agent" => {
                let (agent, excess) = (self.agent(tokens)?, tokens.number()?);
                self.agents[agent].levels = self.agents[agent].levels.max(Some(excess));
            }
            "within" => {
                let (agent, excess, variable) = (self.agent(tokens)?, tokens.number()?, self.variable()?);
                ensure(self.agents[agent].within.insert(excess, variable).is_none(), "this variable exists")?;
            }
            "active" => {
                let (agent, variable) = (self.agent(tokens)?, self.variable()?);
                ensure(self.agents[agent].active.replace(variable).is_none(), "this variable exists")?;
            }
            "visit" | "last" | "rests" => {
                let (agent, place) = (self.agent(tokens)?, tokens.index(places, "place")?);
                let time = if name == "rests" { tokens.or_inf()?.unwrap_or(NEVER) } else { tokens.number()? };
                let (variable, of) = (self.variable()?, &mut self.agents[agent]);
                let old = match name {
                    "visit" => of.visits.own.insert((place, time), variable),
                    "last" => of.lasts.own.insert((place, time), variable),
                    _ => of.rests.insert((place, time), variable),
                };
                ensure(old.is_none(), "this variable exists")?;
            }
            "inside" | "ends" => {
                let (agent, inner) = (self.agent(tokens)?, tokens.index(places, "place")?);
                let (exit, time) = (tokens.index(places, "place")?, tokens.number()?);
                ensure(chains.exit(inner, exit).is_some(), "expected the last place of a chain and the end next to it")?;
                let (variable, of) = (self.variable()?, &mut self.agents[agent]);
                let map = if name == "inside" { &mut of.inside } else { &mut of.ends };
                ensure(map.insert((inner, exit, time), variable).is_none(), "this variable exists")?;
            }
            "sum" => {
                let inputs = self.literals(tokens)?;
                ensure(!inputs.is_empty() && self.sums.len() < 1 << 29, "expected inputs")?;
                self.sums.push(inputs);
            }
            "count" => {
                let sum = tokens.index(self.sums.len(), "sum")?;
                let (first, end, count) = (tokens.number()?, tokens.number()?, tokens.number()?);
                let inputs = self.sums[sum as usize].len();
                let good = first < end && end as usize <= inputs && end - first >= 2 && 0 < count && count <= end - first;
                ensure(good, "expected two inputs or more, and at most their number")?;
                let variable = self.variable()?;
                ensure(self.counts.insert((sum, first, end, count), variable).is_none(), "this variable exists")?;
            }
            "counts" | "skips" => {
                let (agent, task) = (self.agent(tokens)?, tokens.index(self.choices.tasks.len(), "task")?);
                let choice = &self.choices.tasks[task as usize];
                ensure(choice.is_choice() && choice.agents.contains(&(agent as u32)), "the agent has no choice whether to visit the task")?;
                let (variable, counts) = (self.variable()?, name == "counts");
                ensure(self.agents[agent].counts.insert((task, counts), variable).is_none(), "this variable exists")?;
                self.counters.insert(yes(variable), ((task, agent as u32), counts));
            }
            "used" => {
                let (place, unit) = (tokens.index(places, "place")?, tokens.number()?);
                let price = self.choices.goals.get(&place).map(|goal| goal.price);
                ensure(price.map_or(false, |price| unit <= price), "no agent chooses this goal, or its price is less")?;
                let variable = self.variable()?;
                ensure(self.used.insert((place, unit), variable).is_none(), "this variable exists")?;
            }
            "atmost" => {
                let sum = tokens.index(self.sums.len(), "sum")?;
                let most = tokens.number()?;
                ensure(self.limits_visits(&self.sums[sum as usize], most), "more inputs of the sum may be true")?;
                self.limits.push((sum, most));
            }
            "split" => {
                let (one, two) = (self.literal(tokens)?, self.literal(tokens)?);
                self.splits.push((one, two));
            }
            _ => return Ok(false),
        }
        tokens.end().map(|_| true)
    }

    /// Returns whether at most `most` of these literals are true in every plan considered: they deny that agents count one task, or
    /// that they do not count it.
    fn limits_visits(&self, inputs: &[Literal], most: u32) -> bool {
        let counters: Option<Vec<&((u32, u32), bool)>> = inputs.iter().map(|&input| self.counters.get(&not(input))).collect();
        let counters = match counters { Some(counters) if !counters.is_empty() => counters, _ => return false };
        let ((task, _), counts) = *counters[0];
        let mut agents: Vec<u32> = counters.iter().map(|counter| counter.0.1).collect();
        agents.sort_unstable();
        let distinct = agents.windows(2).all(|two| two[0] < two[1]);
        let choice = &self.choices.tasks[task as usize];
        let limit = if counts { Some(choice.agents.len() as u32 - choice.need) } else { Some(choice.need).filter(|_| choice.price > 0) };
        distinct && counters.iter().all(|counter| counter.0.0 == task && counter.1 == counts) && limit.map_or(false, |limit| limit <= most)
    }

    /// Defines the variable "the agent satisfies this constraint".
    pub fn meets(&mut self, constraint: Constraint) -> Result<(), Fault> {
        ensure(!matches!(constraint.kind, Kind::Stop | Kind::NoStop), "expected a constraint on places")?;
        let variable = self.variable()?;
        self.agents[constraint.agent as usize].meets.push((constraint, variable));
        self.constraints.insert(yes(variable), constraint);
        Ok(())
    }

    /// Defines the variable of a node, from `AGENT TIME PLACE POSE DONE`, perhaps `work TASK STEPS`, and perhaps `since TIME`.
    pub fn node(&mut self, agent: u32, model: &AgentModel, places: usize, tokens: &mut Tokens) -> Result<(), Fault> {
        let (time, place) = (tokens.number()?, tokens.index(places, "place")?);
        let pose = model.poses.numbered(place, tokens.number()?);
        let pose = pose.ok_or_else(|| (1, "there is no such pose".to_string()))?;
        let done = tokens.whole()?;
        ensure(done & !model.all() == 0, "there is no such stop")?;
        ensure(!model.is_plain(), "this agent needs no nodes")?;
        let mut spot = Spot { pose, done: 0, work: 0, steps: 0, since: NEVER, ends: false };
        if tokens.take("work") {
            let task = tokens.number()?;
            let stop = model.stops.iter().position(|stop| stop.task == task && stop.place == place);
            spot.work = 1 + stop.ok_or_else(|| (1, "there is no such stop".to_string()))? as u32;
            spot.steps = tokens.number()?;
        }
        if tokens.take("since") {
            spot.since = tokens.number()?;
            spot.ends = model.is_priced() && tokens.take("end");
        }
        tokens.end()?;
        let variable = self.variable()?;
        let of = &mut self.agents[agent as usize];
        ensure(of.known_nodes.insert((time, spot, done)), "this variable exists")?;
        of.nodes.push((NamedNode { time, place, spot, done }, variable));
        Ok(())
    }

    /// The agents of which the certificate states the greatest excess.
    pub fn levels(&self) -> Vec<(u32, u32)> {
        let levels = |(agent, of): (usize, &Agent)| of.levels.map(|excess| (agent as u32, excess));
        self.agents.iter().enumerate().filter_map(levels).collect()
    }

    /// Ends the definitions. Adds the clauses that do not depend on the paths of agents. `excess`: the sum of all excesses is at most this
    /// number (None: no limit). `permitted`: whether every plan satisfies one of two constraints.
    pub fn close(&mut self, excess: Option<u64>, chains: &Chains, permitted: impl Fn(&Constraint, &Constraint) -> bool) -> Result<(), Fault> {
        self.clauses = Clauses::new(self.variables as usize);
        self.agents.iter_mut().for_each(Agent::add_nodes_to_presences);
        self.exclude_presences();
        for agent in 0..self.agents.len() {
            self.add_levels(agent, excess);
            self.add_rests(agent);
            self.add_meets(agent);
            self.add_traversals(agent, chains);
        }
        self.add_bars();
        self.add_counts();
        self.add_limits();
        self.add_goals();
        for &(one, two) in &self.splits {
            let sides = self.constraints.get(&one).zip(self.constraints.get(&two));
            let good = sides.map_or(false, |(one, two)| permitted(one, two));
            ensure(good, format!("a plan may satisfy neither side of the split {} {}", one / 2 + 1, two / 2 + 1))?;
            self.clauses.add(&[one, two]);
        }
        Ok(())
    }

    /// Two agents are not on one place at the same time.
    fn exclude_presences(&mut self) {
        let mut groups: BTreeMap<At, Vec<(u32, Variable)>> = BTreeMap::new();
        for (number, agent) in self.agents.iter().enumerate() {
            let rests = agent.rests.iter().map(|(&at, &variable)| (at, variable));
            for (at, variable) in agent.presences().chain(rests) { groups.entry(at).or_default().push((number as u32, variable)); }
        }
        for (_, mut group) in groups {
            group.sort_unstable();
            self.clauses.add_group(group);
        }
    }

    /// within(e) implies within(e + 1); all costs are within the sum of all excesses.
    fn add_levels(&mut self, agent: usize, excess: Option<u64>) {
        let levels: Vec<(u32, Variable)> = self.agents[agent].within.iter().map(|(&level, &variable)| (level, variable)).collect();
        for two in levels.windows(2) { self.clauses.add(&[no(two[0].1), yes(two[1].1)]); }
        for (level, variable) in levels {
            self.soft.insert(yes(variable));
            if excess.map_or(false, |excess| u64::from(level) >= excess) { self.clauses.add(&[yes(variable)]); }
        }
    }

    /// A last arrival implies that the agent rests there from then on, and so at all later times.
    fn add_rests(&mut self, agent: usize) {
        let Agent { rests, lasts, .. } = &self.agents[agent];
        let mut before: Option<(At, Variable)> = None;
        for (&at, &variable) in rests {
            if let Some(before) = before.filter(|before| before.0.0 == at.0) { self.clauses.add(&[no(before.1), yes(variable)]); }
            before = Some((at, variable));
        }
        for (at, variable) in lasts.all() {
            let after = rests.range(at..=(at.0, NEVER)).next();
            if let Some((_, &rests)) = after { self.clauses.add(&[no(variable), yes(rests)]); }
        }
    }

    /// An agent that satisfies a constraint has no presence that violates it.
    fn add_meets(&mut self, number: usize) {
        let agent = &self.agents[number];
        let mut on: HashMap<u32, Vec<(u32, bool, Variable)>> = HashMap::new();
        for (is_last, map) in [(false, &agent.visits), (true, &agent.lasts)] {
            for ((place, time), variable) in map.all() { on.entry(place).or_default().push((time, is_last, variable)); }
        }
        on.values_mut().for_each(|list| list.sort_unstable());
        let mut lasts: Vec<(At, Variable)> = agent.lasts.all().collect();
        lasts.sort_unstable();
        let none = Vec::new();
        for &(Constraint { kind, p, q, s, e, .. }, meets) in &agent.meets {
            let here = on.get(&p).unwrap_or(&none);
            match kind {
                Kind::Bar if s <= e => {
                    let violates = |&&(time, is_last, _): &&(u32, bool, Variable)| time <= e && (is_last || s <= time);
                    for &(_, _, variable) in here.iter().filter(violates) { self.clauses.add(&[no(meets), no(variable)]); }
                }
                Kind::Move => {
                    for &(time, is_last, from) in here {
                        if is_last || time + 1 < s || e < time + 1 { continue; }
                        for to in agent.arrivals((q, time + 1)) { self.clauses.add(&[no(meets), no(from), no(to)]); }
                    }
                }
                Kind::NoRest => {
                    let violates = |&&(time, is_last, _): &&(u32, bool, Variable)| is_last && time <= s;
                    for &(_, _, variable) in here.iter().filter(violates) { self.clauses.add(&[no(meets), no(variable)]); }
                }
                Kind::Rest => {
                    let violates = |at: At| at.0 != p || s < at.1;
                    for &(_, variable) in lasts.iter().filter(|last| violates(last.0)) { self.clauses.add(&[no(meets), no(variable)]); }
                }
                Kind::Pass if s <= e => {
                    for (_, &ends) in agent.ends.range((p, q, s)..=(p, q, e)) { self.clauses.add(&[no(meets), no(ends)]); }
                }
                _ => (),
            }
        }
    }

    /// The moves of an agent through a corridor.
    fn add_traversals(&mut self, number: usize, chains: &Chains) {
        let agent = &self.agents[number];
        let mut ways: Vec<(u32, u32)> = agent.inside.keys().chain(agent.ends.keys()).map(|key| (key.0, key.1)).collect();
        ways.sort_unstable();
        ways.dedup();
        let mut presences: Vec<(At, Variable)> = agent.presences().collect();
        presences.sort_unstable();
        for (inner, exit) in ways {
            let (chain, side, way) = chains.exit(inner, exit).expect("tested by define()");
            let (entry, first) = way.entry(side);
            let inside = |time: u32| agent.inside.get(&(inner, exit, time)).copied();
            let before = |place: u32, time: u32| time.checked_sub(1).into_iter().flat_map(move |time| agent.visits.at((place, time)));
            for &((place, time), variable) in &presences {
                let (was, is) = (time.checked_sub(1).and_then(inside), inside(time));
                if let (true, Some(was), Some(is)) = (chains.contains(chain, place), was, is) {
                    self.clauses.add(&[no(was), no(variable), yes(is)]);
                }
                if let (true, Some(is)) = (place == first, is) {
                    for from in before(entry, time) { self.clauses.add(&[no(from), no(variable), yes(is)]); }
                }
                let ends = agent.ends.get(&(inner, exit, time)).copied();
                if let (true, Some(was), Some(ends)) = (place == exit, was, ends) {
                    for from in before(inner, time) { self.clauses.add(&[no(from), no(variable), no(was), yes(ends)]); }
                }
            }
        }
    }

    /// An agent that rests on a place bars it for the others.
    fn add_bars(&mut self) {
        let all = || self.agents.iter().flat_map(|agent| agent.meets.iter());
        let mut bars: HashMap<u32, Vec<(Constraint, Variable)>> = HashMap::new();
        for &bar in all().filter(|(c, _)| c.kind == Kind::Bar && c.e == NEVER) { bars.entry(bar.0.p).or_default().push(bar); }
        for (rest, meets) in all().filter(|(c, _)| c.kind == Kind::Rest) {
            for (bar, barred) in bars.get(&rest.p).into_iter().flatten() {
                if bar.agent != rest.agent && bar.s >= rest.s { self.clauses.add(&[no(*meets), yes(*barred)]); }
            }
        }
    }

    /// At least i + j inputs are true if at least i of one half and j of the other half are.
    fn add_counts(&mut self) {
        let Formula { sums, counts, clauses, .. } = self;
        for (&(sum, first, end, count), &variable) in counts.iter() {
            let middle = first + (end - first) / 2;
            // At least this number of the inputs of a half; Err: always true.
            let half = |first: u32, end: u32, count: u32| match count {
                0 => Some(Err(())),
                1 if end - first == 1 => Some(Ok(sums[sum as usize][first as usize])),
                _ => counts.get(&(sum, first, end, count)).map(|&variable| Ok(yes(variable))),
            };
            let (least, most) = (count.saturating_sub(end - middle), count.min(middle - first));
            let defined = counts.range((sum, first, middle, least)..=(sum, first, middle, most)).map(|(key, _)| key.3);
            let simple = if middle - first == 1 { 0..=1 } else { 0..=0 };
            for left in simple.filter(|left| (least..=most).contains(left)).chain(defined) {
                if let Some((one, two)) = half(first, middle, left).zip(half(middle, end, count - left)) {
                    let clause: Vec<Literal> = one.into_iter().chain(two).map(not).chain([yes(variable)]).collect();
                    clauses.add(&clause);
                }
            }
            if let Some(&fewer) = counts.get(&(sum, first, end, count - 1)) { clauses.add(&[no(variable), yes(fewer)]); }
        }
    }

    /// Limits of the numbers of agents that count a task, or do not count it.
    fn add_limits(&mut self) {
        for &(sum, most) in &self.limits {
            let inputs = &self.sums[sum as usize];
            let all = inputs.len() as u32;
            if most == 0 { inputs.iter().for_each(|&input| { self.clauses.add(&[not(input)]); }); }
            if most + 1 == all {
                let one: Vec<Literal> = inputs.iter().copied().map(not).collect();
                self.clauses.add(&one);
            }
            if most < all {
                if let Some(&more) = self.counts.get(&(sum, 0, all, most + 1)) { self.clauses.add(&[no(more)]); }
            }
        }
    }

    /// A goal is used if one of the agents that may choose it rests there. Units of its price are soft literals.
    fn add_goals(&mut self) {
        for (&(place, unit), &variable) in &self.used {
            if unit > 0 { self.soft.insert(yes(variable)); }
            if let Some(&used) = self.used.get(&(place, 0)) { self.clauses.add(&[no(variable), yes(used)]); }
            let rests = |agent: &u32| {
                let meets = &self.agents[*agent as usize].meets;
                meets.iter().find(|(c, _)| c.kind == Kind::Rest && c.p == place && c.s == NEVER).map(|meets| yes(meets.1))
            };
            let rests: Option<Vec<Literal>> = self.choices.goals[&place].agents.iter().map(rests).collect();
            if let Some(rests) = rests { self.clauses.add(&[vec![no(variable)], rests].concat()); }
        }
    }

    /// The end of a path decides which tasks its agent counts.
    fn add_counters(&mut self, number: u32, model: &AgentModel) {
        let agent = &self.agents[number as usize];
        for (&(task, counts), &variable) in &agent.counts {
            let stop = model.stops.iter().position(|stop| stop.task == task).expect("a stop");
            for (node, of_node) in agent.nodes.iter().filter(|(node, _)| node.spot.ends) {
                if (node.done >> stop & 1 == 1) != counts { self.clauses.add(&[no(variable), no(*of_node)]); }
            }
        }
    }

    /// Adds the clauses of the paths of an agent whose least cost is `cost`. `paths`: all that cost at most `cost` + `excess`.
    pub fn add_paths(&mut self, number: u32, model: &mut AgentModel, paths: &Paths, cost: u32, excess: u32) {
        self.add_counters(number, model);
        let (agent, plain) = (&self.agents[number as usize], model.is_plain());
        let mut of: Vec<Option<Variable>> = vec![None; paths.nodes.len()];
        let mut stray = Vec::new();
        let spot_of = |&(place, time): &At, since: u32| (time, model.poses.numbered(place, 0), since);
        let visits = agent.visits.own.iter().map(|(at, &variable)| (spot_of(at, NEVER), variable));
        let lasts = agent.lasts.own.iter().map(|(at, &variable)| (spot_of(at, at.1), variable));
        for ((time, pose, since), variable) in visits.chain(lasts).filter(|_| plain) {
            let spot = pose.and_then(|pose| paths.plain(pose, since));
            match spot.and_then(|spot| paths.find(time, spot)) { Some(node) => of[node as usize] = Some(variable), None => stray.push(variable) }
        }
        for &(NamedNode { time, spot, done, .. }, variable) in &agent.nodes {
            let node = model.known_number(done).and_then(|done| paths.find(time, Spot { done, ..spot }));
            match node {
                Some(node) => of[node as usize] = Some(variable),
                None if spot.work > 0 && !model.may_execute_in(spot.pose) => { self.clauses.add(&[no(variable)]); }
                None => stray.push(variable),
            }
        }
        for (node, variable) in paths.nodes.iter().zip(&of) { if node.least == NEVER { stray.extend(*variable); } }
        // A path through these nodes costs more.
        let beyond = agent.within(0, excess);
        for variable in stray { if let Some(within) = beyond { self.clauses.add(&[no(variable), no(within)]); } }
        let options = |list: &[u32]| {
            let mut found: Vec<(u32, Option<Variable>)> = list.iter().map(|&i| (paths.nodes[i as usize].least, of[i as usize])).collect();
            found.retain(|option| option.0 < NEVER);
            found.sort_unstable();
            found
        };
        let clauses = &mut self.clauses;
        one_of(clauses, agent, &[], &options(&paths.starts), (cost, excess), false);
        for (node, variable) in paths.nodes.iter().zip(&of) {
            let variable = match variable { Some(variable) if node.least < NEVER => *variable, _ => continue };
            if !node.ends { one_of(clauses, agent, &[no(variable)], &options(paths.next(node)), (cost, excess), node.complete); }
            let at = |node: &Node| (model.poses.place(node.spot.pose), node.time);
            let presences = if node.spot.since == NEVER { &agent.visits } else { &agent.lasts };
            let presence = presences.own.get(&at(node));
            let enters = node.spot.since == NEVER || node.spot.since == node.time;
            if let Some(&presence) = presence.filter(|_| enters && !plain) { clauses.add(&[no(variable), yes(presence)]); }
        }
        if let Some(active) = agent.active {
            let nodes = agent.nodes.iter().map(|node| node.1);
            let presences = agent.presences().map(|presence| presence.1).filter(|_| plain);
            for variable in nodes.chain(presences) { clauses.add(&[no(variable), yes(active)]); }
        }
    }

    /// Returns the clauses in DIMACS format.
    pub fn dimacs(&self) -> String { self.clauses.dimacs() }

    /// Verifies a step. Returns false if the line is something else.
    pub fn step(&mut self, name: &str, tokens: &mut Tokens) -> Result<bool, Fault> {
        match name {
            "clause" => {
                let clause = self.literals(tokens)?;
                ensure(self.clauses.implies(&clause), "the clause does not follow by unit propagation")?;
                self.steps.push(self.clauses.add(&clause));
            }
            "drop" => {
                let number = tokens.index(self.steps.len(), "clause")?;
                self.clauses.drop(self.steps[number as usize]);
            }
            "core" => {
                let sum = tokens.index(self.sums.len(), "sum")?;
                self.core(sum)?;
            }
            _ => return Ok(false),
        }
        tokens.end().map(|_| true)
    }

    /// At least one input of the sum is true, and the soft literals that deny them are replaced by those that deny each further one.
    fn core(&mut self, sum: u32) -> Result<(), Fault> {
        let inputs = &self.sums[sum as usize];
        for &input in inputs { ensure(self.soft.remove(&not(input)), "an input of the sum does not deny a soft literal")?; }
        ensure(self.clauses.implies(inputs), "the core does not follow by unit propagation")?;
        self.clauses.add(inputs);
        self.raised += 1;
        let all = inputs.len() as u32;
        let counts = (2..=all).filter_map(|count| self.counts.get(&(sum, 0, all, count)));
        self.soft.extend(counts.map(|&variable| no(variable)));
        Ok(())
    }

    /// Returns by how much all plans exceed the sum of the least costs at least; None: there is no plan within the sum of all excesses.
    pub fn proven(&self) -> Option<u64> { if self.clauses.refuted { None } else { Some(self.raised) } }
}

/// Adds, for each excess e for which this says something new: a path that costs at most `cost` + e and satisfies `unless` takes one of the
/// options that cost at most `cost` + e. `options`: least costs and variables, ascending. `complete`: it takes one, whatever it costs.
fn one_of(
    clauses: &mut Clauses, agent: &Agent, unless: &[Literal], options: &[(u32, Option<Variable>)], (cost, excess): (u32, u32), complete: bool,
) {
    let mut clause = unless.to_vec();
    let mut taken = 0;
    while taken < options.len() {
        let level = options[taken].0;
        while taken < options.len() && options[taken].0 == level {
            match options[taken].1 { Some(variable) => clause.push(yes(variable)), None => return }
            taken += 1;
        }
        let last = taken == options.len();
        let next = if last { excess } else { options[taken].0 - cost - 1 };
        if last && complete {
            clauses.add(&clause);
        } else if let Some(within) = agent.within(level - cost, next) {
            clause.push(no(within));
            clauses.add(&clause);
            clause.pop();
        }
    }
}
