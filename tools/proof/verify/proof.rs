// SPDX-License-Identifier: MIT
//! Verifies a certificate: lemmas, the theorem, and the rules of their proofs (docs/proof.md, sections 3 and 4).
use crate::agent::{AgentModel, AgentPrices, Poses, Rest, NEVER};
use crate::formula::{Choices, Formula, GoalChoice, TaskChoice};
use crate::instance::Instance;
use crate::joint::{Joint, Layers};
use crate::paths::Paths;
use crate::prices::{Prices, UNIT};
use crate::reader::Lines;
use crate::rules::{Chains, Constraint, Kind, Rules};
use crate::search::{surely_satisfies, Path, Search};
use crate::successors::Successors;
use crate::tokens::{ensure, unreadable, Fault, Tokens};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// The greatest number of stops of an agent with a choice.
const MAX_STOPS: usize = 63;
/// The greatest price of a choice. Prices of agents are then far below NEVER.
const MAX_PRICE: u32 = 1 << 20;

/// Parses the price of a choice.
fn price(tokens: &mut Tokens) -> Result<u32, Fault> {
    let price = tokens.number()?;
    ensure((1..=MAX_PRICE).contains(&price), "expected a price from 1 to 2^20").map(|_| price)
}

/// The bound `inf`. No sum of costs reaches it.
const INFINITE: u64 = u64::MAX;

/// The statement that all plans of `agents` which satisfy `constraints` cost at least `bound` together.
struct Lemma {
    agents: Vec<u32>,
    bound: u64,
    constraints: Vec<Constraint>,
}

/// The least cost of an agent under the first `constraints` of its constraints, and a path of this cost. The path is empty if there is
/// none, or if the cost is only known to exceed the limit of the model.
struct Known {
    constraints: usize,
    cost: u32,
    path: Path,
}

pub struct Verifier {
    instance: Instance,
    chains: Chains,
    poses: HashMap<u32, Rc<Poses>>,
    models: Vec<Option<AgentModel>>,
    rules: Rules,
    search: Search,
    lines: Lines,
    following: bool,
    lemmas: Vec<Lemma>,
    /// For each constraint in force, in the order of addition, its agent.
    trail: Vec<u32>,
    /// The constraints in force on each agent.
    constraints: Vec<Vec<Constraint>>,
    /// For each constraint in force, how often it occurs among the constraints in force.
    present: HashMap<Constraint, u32>,
    /// For each agent its known costs, with ascending numbers of constraints.
    known: Vec<Vec<Known>>,
    nodes: u64,
    has_choices: bool,
    /// The goals of agents without a choice of goals.
    goals: HashSet<u32>,
    /// The least price of each agent with a choice, once the prices are known.
    least_prices: Vec<Option<u32>>,
    /// File to which the clauses of a formula are written.
    pub clauses: Option<String>,
}

fn text(bound: u64) -> String { if bound == INFINITE { "inf".to_string() } else { bound.to_string() } }

impl Verifier {
    pub fn new(instance: Instance, lines: Lines) -> Verifier {
        let (agents, chains, rules) = (instance.agents.len(), Chains::of(&instance.world), Rules::new(instance.world.links.len()));
        let (constraints, known, models) = ((0..agents).map(|_| vec![]), (0..agents).map(|_| vec![]), (0..agents).map(|_| None));
        let (constraints, known, models) = (constraints.collect(), known.collect(), models.collect());
        let (poses, search, lemmas, trail, present) = Default::default();
        let (has_choices, least_prices) = (instance.agents.iter().any(|agent| agent.has_choice()), vec![None; agents]);
        let goals = instance.agents.iter().filter_map(|agent| agent.goal).collect();
        Verifier { has_choices, goals, least_prices, instance, chains, poses, models, rules, search, lines, following: true, lemmas, trail, constraints, present, known, nodes: 0, clauses: None }
    }

    pub fn statistics(&self) -> String {
        let (lines, lemmas) = (self.lines.number, self.lemmas.len());
        format!("{} lines, {} nodes, {} lemmas, {} searches", lines, self.nodes, lemmas, self.search.searches)
    }

    fn line(&mut self) -> Result<String, Fault> {
        crate::LINE.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let line = self.lines.next().map_err(unreadable)?.ok_or_else(|| unreadable("expected more"))?;
        if line.ends_with(' ') { Err(unreadable("found a blank at the end of the line; expected none")) } else { Ok(line.to_string()) }
    }

    /// After run(): true if the claim is about all plans, false if it is only about plans without following conflicts.
    pub fn may_follow(&self) -> bool { self.following }

    /// Verifies the certificate. Returns the bound L of the theorem, or None for `inf`.
    pub fn run(&mut self) -> Result<Option<u64>, Fault> {
        Some(self.line()?).filter(|line| line == "grove-proof 1").ok_or_else(|| unreadable("expected 'grove-proof 1'"))?;
        let line = self.line()?;
        let sum = line.strip_prefix("instance ").filter(|sum| sum.len() == 16).and_then(|sum| u64::from_str_radix(sum, 16).ok());
        let sum = sum.ok_or_else(|| unreadable("expected 'instance' and 16 digits"))?;
        ensure(sum == self.instance.checksum, "it is of another instance")?;
        let line = self.line()?;
        self.following = line == "following yes";
        if !self.following && line != "following no" { return Err(unreadable("expected 'following yes' or 'following no'")); }
        loop {
            let line = self.line()?;
            let mut tokens = Tokens::of(&line);
            match tokens.token()? {
                "lemma" => {
                    let lemma = self.lemma(tokens)?;
                    self.lemmas.push(lemma);
                }
                "theorem" => {
                    let (bound, all) = (tokens.or_inf()?.map_or(INFINITE, u64::from), (0..self.models.len() as u32).collect());
                    tokens.end()?;
                    let first = self.line()?;
                    self.proof(first, &Lemma { agents: all, bound, constraints: Vec::new() })?;
                    let ended = self.line()? == "end" && self.lines.next().map_err(unreadable)?.is_none();
                    return if ended { Ok(Some(bound).filter(|&bound| bound < INFINITE)) } else { Err(unreadable("expected 'end', the last line")) };
                }
                _ => return Err(unreadable("expected 'lemma' or 'theorem'")),
            }
        }
    }

    fn lemma(&mut self, mut tokens: Tokens) -> Result<Lemma, Fault> {
        let bound = tokens.or_inf()?.map_or(INFINITE, u64::from);
        let mut lemma = Lemma { bound, agents: Vec::new(), constraints: Vec::new() };
        while lemma.agents.is_empty() || tokens.more() {
            let agent = tokens.index(self.models.len(), "agent")?;
            ensure(lemma.agents.last().map_or(true, |&last| last < agent), "the agents must ascend")?;
            lemma.agents.push(agent);
        }
        loop {
            let line = self.line()?;
            match line.strip_prefix("demand ") {
                Some(text) => lemma.constraints.push(self.constraint(text, &lemma)?),
                None => return self.proof(line, &lemma).map(|_| lemma),
            }
        }
    }

    fn model(&mut self, agent: u32) -> &mut AgentModel {
        let (instance, poses) = (&self.instance, &mut self.poses);
        self.models[agent as usize].get_or_insert_with(|| {
            let found = &instance.agents[agent as usize];
            let poses = poses.entry(found.turn).or_insert_with(|| Rc::new(Poses::of(&instance.world, found.turn)));
            AgentModel::of(instance, found, poses.clone())
        })
    }

    /// Parses a constraint of a formula: also `A rest P inf`.
    fn constraint_of_formula(&mut self, text: &str, of: &Lemma) -> Result<Constraint, Fault> {
        match text.strip_suffix(" inf").filter(|start| start.split(' ').nth(1) == Some("rest")) {
            Some(start) => Ok(Constraint { s: NEVER, e: NEVER, ..self.constraint(&format!("{} 0", start), of)? }),
            None => self.constraint(text, of),
        }
    }

    fn constraint(&mut self, text: &str, of: &Lemma) -> Result<Constraint, Fault> {
        let mut tokens = Tokens::of(text);
        let agent = tokens.number()?;
        ensure(of.agents.binary_search(&agent).is_ok(), format!("agent {} is not among the agents of this lemma or theorem", agent))?;
        let names = ["bar", "move", "norest", "rest", "pass", "stop", "nostop"];
        let kinds = [Kind::Bar, Kind::Move, Kind::NoRest, Kind::Rest, Kind::Pass, Kind::Stop, Kind::NoStop];
        let name = tokens.token()?;
        let kind = kinds[names.iter().position(|&known| known == name).ok_or_else(|| unreadable("expected a constraint"))?];
        let mut constraint = Constraint { agent, kind, p: tokens.number()?, q: 0, s: 0, e: 0 };
        if matches!(kind, Kind::Move | Kind::Pass | Kind::Stop | Kind::NoStop) { constraint.q = tokens.number()?; }
        if matches!(kind, Kind::Stop | Kind::NoStop) {
            let stops = &self.model(agent).stops;
            let known = (constraint.p as usize) < stops.len() && stops.iter().any(|stop| stop.task == constraint.q);
            ensure(known, "this agent has no such number, or no such stop")?;
        } else {
            let places = self.instance.world.links.len() as u32;
            ensure(constraint.p < places && constraint.q < places, format!("there is no place {}", constraint.p.max(constraint.q)))?;
            let moves = kind == Kind::Move && constraint.p != constraint.q || kind == Kind::Pass && self.chains.exit(constraint.p, constraint.q).is_some();
            let paired = moves || !matches!(kind, Kind::Move | Kind::Pass);
            ensure(paired, "expected two different places; for 'pass', the last place of a chain and the end next to it")?;
            constraint.s = tokens.number()?;
            let ends = !matches!(kind, Kind::Rest | Kind::NoRest);
            constraint.e = if ends { tokens.or_inf()?.unwrap_or(NEVER) } else { constraint.s };
        }
        tokens.end().map(|_| constraint)
    }

    fn push(&mut self, constraint: Constraint) {
        self.constraints[constraint.agent as usize].push(constraint);
        self.trail.push(constraint.agent);
        *self.present.entry(constraint).or_insert(0) += 1;
    }

    /// Adds the constraint of one branch of a split. A Rest constraint also bars the place for all other agents of the statement.
    fn assume(&mut self, constraint: Constraint, agents: &[u32]) {
        self.push(constraint);
        for &agent in agents.iter().filter(|&&agent| constraint.kind == Kind::Rest && agent != constraint.agent) {
            self.push(Constraint { agent, kind: Kind::Bar, e: NEVER, ..constraint });
        }
    }

    fn undo(&mut self, trail: usize) {
        for agent in self.trail.drain(trail..).rev().map(|agent| agent as usize) {
            let constraint = self.constraints[agent].pop().expect("a constraint");
            let count = self.present.get_mut(&constraint).expect("a constraint");
            *count -= 1;
            if *count == 0 { self.present.remove(&constraint); }
            let left = self.constraints[agent].len();
            while self.known[agent].last().map_or(false, |known| known.constraints > left) { self.known[agent].pop(); }
        }
    }

    /// Reads and verifies the proof of a statement. `line` is its first line.
    fn proof(&mut self, mut line: String, of: &Lemma) -> Result<(), Fault> {
        of.constraints.iter().for_each(|&constraint| self.push(constraint));
        // For each open split, the length of the trail before it, and its second branch (None once the proof of that branch has started).
        let mut splits: Vec<(usize, Option<Constraint>)> = Vec::new();
        loop {
            self.nodes += 1;
            let (rule, rest) = line.split_once(' ').unwrap_or((line.as_str(), ""));
            let known = ["split", "later", "leaf", "joint", "prices", "formula"].contains(&rule);
            ensure(!known || !self.has_choices, "an instance with choices requires the rule 'choices'")?;
            let sides = match rule {
                "split" => Some(self.split(rest, of)?),
                "later" => Some(self.later(rest, of)?),
                "leaf" => self.leaf(rest, of).map(|_| None)?,
                "joint" if rest.is_empty() => self.joint(of).map(|_| None)?,
                "prices" if rest.is_empty() => self.prices(of).map(|_| None)?,
                "formula" if rest.is_empty() => self.formula(of, Formula::new(of.agents.len())).map(|_| None)?,
                "choices" if rest.is_empty() => self.choices(of).map(|_| None)?,
                _ => return Err(unreadable("expected a rule")),
            };
            let next = if let Some((one, two)) = sides {
                splits.push((self.trail.len(), Some(two)));
                Some(one)
            } else {
                // A proven node closes all innermost splits whose second branch was in progress, and then starts the second branch of
                // the next split.
                while splits.last().map_or(false, |split| split.1.is_none()) { splits.pop(); }
                let second = splits.last_mut().and_then(|split| split.1.take());
                self.undo(splits.last().map_or(0, |split| split.0));
                second
            };
            match next { Some(constraint) => self.assume(constraint, &of.agents), None => return Ok(()) }
            line = self.line()?;
        }
    }

    fn split(&mut self, text: &str, of: &Lemma) -> Result<(Constraint, Constraint), Fault> {
        let (one, two) = text.split_once(" | ").ok_or_else(|| unreadable("expected two constraints"))?;
        let (one, two) = (self.constraint(one, of)?, self.constraint(two, of)?);
        ensure(self.permits(&one, &two), "a plan may satisfy neither of these constraints").map(|_| (one, two))
    }

    /// Returns whether each plan considered satisfies at least one of two constraints.
    fn permits(&self, one: &Constraint, two: &Constraint) -> bool {
        let same = (one.p, one.q, one.s) == (two.p, two.q, two.s);
        let at_once = one.s == one.e && two.s == two.e;
        match (one.kind, two.kind, one.agent == two.agent) {
            (Kind::Bar, Kind::Bar, false) => at_once && one.p == two.p && one.s.abs_diff(two.s) <= u32::from(!self.following),
            (Kind::Move, Kind::Move, false) => at_once && (one.p, one.q, one.s) == (two.q, two.p, two.s),
            (Kind::NoRest, Kind::Rest, true) | (Kind::Rest, Kind::NoRest, true) => same,
            (Kind::Stop, Kind::NoStop, true) | (Kind::NoStop, Kind::Stop, true) => same,
            (Kind::Pass, Kind::Pass, false) => {
                let exits = self.chains.exit(one.p, one.q).zip(self.chains.exit(two.p, two.q));
                let times = |length| one.e < NEVER && two.e < NEVER && one.e <= two.s + length && two.e <= one.s + length;
                exits.map_or(false, |(this, that)| this.0 == that.0 && this.1 != that.1 && times(this.2.length))
            }
            _ => false,
        }
    }

    /// Parses the index of a lemma and returns the lemma. Refuses it if it is about an agent outside `of`, or has a constraint that is not
    /// in force.
    fn usable(&self, tokens: &mut Tokens, of: &Lemma) -> Result<&Lemma, Fault> {
        let number = tokens.index(self.lemmas.len(), "lemma")?;
        let lemma = &self.lemmas[number as usize];
        let other = lemma.agents.iter().find(|agent| of.agents.binary_search(agent).is_err());
        ensure(other.is_none(), format!("lemma {} is also about agent {}, which is not an agent here", number, other.unwrap_or(&0)))?;
        let missing = lemma.constraints.iter().position(|constraint| !self.present.contains_key(constraint));
        ensure(missing.is_none(), format!("constraint {} of lemma {} is not in force", missing.unwrap_or(0), number)).map(|_| lemma)
    }

    fn later(&mut self, text: &str, of: &Lemma) -> Result<(Constraint, Constraint), Fault> {
        let mut tokens = Tokens::of(text);
        let mut side = |tokens: &mut Tokens| {
            let (agent, time) = (tokens.index(self.models.len(), "agent")?, tokens.number()?);
            let goal = self.model(agent).plain_goal;
            ensure(goal.is_some(), format!("agent {} has no plain goal", agent))?;
            Ok::<_, Fault>(Constraint { agent, kind: Kind::NoRest, p: goal.unwrap_or(0), q: 0, s: time, e: time })
        };
        let (one, two) = (side(&mut tokens)?, side(&mut tokens)?);
        let lemma = self.usable(&mut tokens, of)?;
        tokens.end()?;
        let pair = [one.agent.min(two.agent), one.agent.max(two.agent)];
        let said = one.agent != two.agent && lemma.agents == pair && lemma.bound > u64::from(one.s) + u64::from(two.s);
        ensure(said, "the lemma is not about these two agents, or its bound is too small").map(|_| (one, two))
    }

    /// Returns c(A, D) of docs/proof.md. Unless `exact`, a lower bound that is already known suffices. If c(A, D) exceeds the limit of the
    /// model, returns the limit + 1.
    fn cost(&mut self, agent: u32, exact: bool) -> u32 {
        self.model(agent);
        let number = agent as usize;
        let (constraints, known) = (&self.constraints[number], &mut self.known[number]);
        if let Some(last) = known.last() {
            let satisfied = || constraints[last.constraints..].iter().all(|constraint| surely_satisfies(&last.path, constraint));
            let holds = !exact || last.path.is_empty() || satisfied();
            if holds { return last.cost; }
        }
        let model = self.models[number].as_mut().expect("made above");
        let met = self.rules.set(model, &self.chains, constraints);
        let limit = if met { model.limit() } else { NEVER };
        let mut successors = Successors { model, chains: &self.chains, rules: &self.rules };
        let found = if met { self.search.least(&mut successors) } else { None };
        // The search covers only paths that cost at most the limit of the model.
        let beyond = if limit < NEVER { limit + 1 } else { NEVER };
        let (cost, path) = found.filter(|found| found.0 <= limit).unwrap_or((beyond, Vec::new()));
        known.push(Known { constraints: constraints.len(), cost, path });
        cost
    }

    /// If the cost of an agent is only known to exceed the limit of its model, tries to raise this limit. Returns whether it succeeded.
    fn raise_limit(&mut self, agent: u32) -> bool {
        let last = self.known[agent as usize].last().map_or(NEVER, |last| if last.path.is_empty() { last.cost } else { NEVER });
        if last == NEVER { return false; }
        self.known[agent as usize].retain(|known| !known.path.is_empty());
        self.successors(agent).1.model.raise_limit(last)
    }

    fn leaf(&mut self, names: &str, of: &Lemma) -> Result<(), Fault> {
        let (mut tokens, mut named) = (Tokens::of(names), Vec::new());
        while !names.is_empty() && tokens.more() {
            let lemma = self.usable(&mut tokens, of)?;
            if lemma.bound == INFINITE { return Ok(()); }
            named.push((lemma.agents.clone(), lemma.bound));
        }
        let mut costs: Vec<u32> = of.agents.iter().map(|&agent| self.cost(agent, false)).collect();
        let mut sum: u64 = costs.iter().map(|&cost| u64::from(cost)).sum();
        for (i, &agent) in of.agents.iter().enumerate() {
            if costs[i] == NEVER || sum >= of.bound { return Ok(()); }
            sum -= u64::from(costs[i]);
            costs[i] = self.cost(agent, true);
            sum += u64::from(costs[i]);
        }
        let cost_of = |agent: &u32| u64::from(costs[of.agents.binary_search(agent).expect("an agent of the lemma")]);
        let more_than_costs = |(agents, bound): (Vec<u32>, u64)| {
            let more = bound.saturating_sub(agents.iter().map(cost_of).sum());
            (agents, more)
        };
        let more = crate::covering::least(named.into_iter().map(more_than_costs).collect());
        let proven = costs.contains(&NEVER) || sum + more >= of.bound;
        if !proven && of.agents.iter().filter(|&&agent| self.raise_limit(agent)).count() > 0 { return self.leaf(names, of); }
        ensure(proven, format!("costs {} and {} by lemmas; expected {}", sum, more, text(of.bound)))
    }

    fn joint(&mut self, of: &Lemma) -> Result<(), Fault> {
        let costs: Vec<u32> = of.agents.iter().map(|&agent| self.cost(agent, true)).collect();
        let sum: u64 = costs.iter().map(|&cost| u64::from(cost)).sum();
        if costs.contains(&NEVER) || sum >= of.bound { return Ok(()); }
        let spare = of.bound - 1 - sum;
        let cap = |&cost: &u32| if of.bound == INFINITE { NEVER } else { (u64::from(cost) + spare).min(u64::from(NEVER) - 1) as u32 };
        let caps: Vec<u32> = costs.iter().map(cap).collect();
        let none = self.none_joint(&of.agents, &caps, Some(of.bound).filter(|&bound| bound < INFINITE));
        ensure(none, "joint search finds a plan that costs less")
    }

    fn successors(&mut self, agent: u32) -> (bool, Successors<'_>) {
        self.model(agent);
        let model = self.models[agent as usize].as_mut().expect("made above");
        let met = self.rules.set(model, &self.chains, &self.constraints[agent as usize]);
        (met, Successors { model, chains: &self.chains, rules: &self.rules })
    }

    /// Returns whether these agents have no plan in which each agent costs at most its cap in `caps` and all agents together cost less
    /// than `limit`.
    fn none_joint(&mut self, agents: &[u32], caps: &[u32], limit: Option<u64>) -> bool {
        let (mut horizon, mut layers) = (1, Vec::new());
        for &agent in agents {
            let (met, successors) = self.successors(agent);
            if !met { return true; }
            horizon = horizon.max(successors.rules.horizon);
        }
        for (&agent, &cap) in agents.iter().zip(caps) { layers.push(Layers::of(&mut self.successors(agent).1, cap, horizon)); }
        Joint { layers, limit, horizon, following: self.following }.finds_none()
    }

    /// Returns the least cost of an agent without constraints, as exactly as is affordable. NEVER: it has no path.
    fn least_cost(&mut self, agent: u32) -> u32 {
        if let Some(price) = self.least_prices[agent as usize] { return price; }
        let mut cost = self.cost(agent, true);
        while cost < NEVER && self.raise_limit(agent) { cost = self.cost(agent, true); }
        cost
    }

    /// Reads the prices of choices, and the formula that follows.
    fn choices(&mut self, of: &Lemma) -> Result<(), Fault> {
        ensure(self.has_choices, "the instance has no choices")?;
        ensure(of.agents.len() == self.models.len(), "choices require all agents, without constraints")?;
        for agent in 0..self.models.len() { self.require_rules(agent)?; }
        let mut choices = self.choices_of_instance();
        loop {
            let line = self.line()?;
            if line == "formula" { break; }
            let mut tokens = Tokens::of(&line);
            match tokens.token()? {
                "task" => {
                    let task = &mut choices.tasks[tokens.index(self.instance.tasks.len(), "task")? as usize];
                    ensure((task.need as usize) < task.agents.len() && task.price == 0, "the task has no choice of agents, or has a price")?;
                    task.price = price(&mut tokens)?;
                }
                "goal" => {
                    let place = tokens.index(self.instance.world.links.len(), "place")?;
                    let goal = choices.goals.get_mut(&place).filter(|goal| goal.price == 0);
                    let goal = goal.ok_or_else(|| (1, "no agent chooses this goal, or it has a price".to_string()))?;
                    goal.price = price(&mut tokens)?;
                }
                _ => return Err(unreadable("expected a price of a task or goal, or 'formula'")),
            }
            tokens.end()?;
        }
        for agent in 0..self.models.len() { self.set_prices(agent, &choices)?; }
        let mut formula = Formula::new(self.models.len());
        formula.choices = choices;
        self.formula(of, formula)
    }

    /// Refuses an agent with a choice that the rule `choices` does not cover.
    fn require_rules(&self, number: usize) -> Result<(), Fault> {
        let (agent, tasks) = (&self.instance.agents[number], &self.instance.tasks);
        if !agent.has_choice() { return Ok(()); }
        let place = |task: &u32| tasks[*task as usize].place;
        let shares = |option: &u32| {
            let all = agent.tasks.iter().chain(&agent.options);
            all.filter(|&task| task != option).any(|task| place(task) == place(option))
        };
        let refuse = |is_covered: bool, what: &str| ensure(is_covered, format!("agent {} has a choice and {}", number, what));
        refuse(agent.turn == 0, "needs time to turn")?;
        refuse(agent.working.map_or(true, |work| agent.tasks.contains(&work.0)), "executes a task of its choice at the start")?;
        refuse(agent.tasks.len() + agent.options.len() <= MAX_STOPS, "more than 63 tasks")?;
        refuse(!agent.options.iter().any(shares), "several tasks on one place")?;
        let has_goal = agent.goal.is_some() || !agent.goals.is_empty();
        refuse(has_goal || agent.tasks.is_empty(), "no goal, but must visit tasks")
    }

    fn choices_of_instance(&self) -> Choices {
        let tasks = self.instance.tasks.iter().map(|task| TaskChoice { agents: task.agents.clone(), need: task.need, price: 0 });
        let mut choices = Choices { tasks: tasks.collect(), ..Choices::default() };
        for (number, agent) in self.instance.agents.iter().enumerate() {
            for &goal in agent.goals.iter().filter(|&&goal| !self.is_goal(goal)) {
                choices.goals.entry(goal).or_insert_with(GoalChoice::default).agents.push(number as u32);
            }
        }
        choices
    }

    /// Returns whether a place is the goal of an agent without a choice of goals. No other agent can end there.
    fn is_goal(&self, place: u32) -> bool { self.goals.contains(&place) }

    fn set_prices(&mut self, number: usize, choices: &Choices) -> Result<(), Fault> {
        if !self.instance.agents[number].has_choice() { return Ok(()); }
        let is_option = |task: u32| choices.tasks[task as usize].agents.len() > choices.tasks[task as usize].need as usize;
        self.model(number as u32);
        let agent = &self.instance.agents[number];
        let model = self.models[number].as_mut().expect("made above");
        let skip = model.stops.iter().map(|stop| if is_option(stop.task) { choices.tasks[stop.task as usize].price } else { NEVER });
        let priced = |goal: &u32| choices.goals.get(goal).map(|choice| (*goal, choice.price));
        let rest = match agent.goal {
            Some(goal) => Rest::On(vec![(goal, 0)]),
            None if agent.goals.is_empty() => Rest::Anywhere,
            None => Rest::On(agent.goals.iter().filter_map(priced).collect()),
        };
        let prices = AgentPrices { skip: skip.collect(), rest };
        let least = model.set_prices(prices).ok_or_else(|| (1, format!("agent {} has too many sets of tasks that pay off", number)))?;
        self.least_prices[number] = Some(least);
        Ok(())
    }

    fn formula(&mut self, of: &Lemma, mut formula: Formula) -> Result<(), Fault> {
        let (agents, places) = (self.models.len(), self.instance.world.links.len());
        ensure(of.agents.len() == agents && self.trail.is_empty(), "a formula requires all agents, without constraints")?;
        let bound = of.bound.saturating_add(formula.choices.constant());
        let mut line = self.line()?;
        loop {
            let (name, rest) = line.split_once(' ').unwrap_or((line.as_str(), ""));
            match name {
                "meets" => formula.meets(self.constraint_of_formula(rest, of)?)?,
                "node" => {
                    let mut tokens = Tokens::rest(rest);
                    let agent = tokens.index(agents, "agent")?;
                    formula.node(agent, self.model(agent), places, &mut tokens)?;
                }
                _ if !formula.define(name, &mut Tokens::rest(rest), places, &self.chains)? => break,
                _ => (),
            }
            line = self.line()?;
        }
        let costs: Vec<u32> = (0..agents as u32).map(|agent| self.least_cost(agent)).collect();
        let sum: u64 = costs.iter().map(|&cost| u64::from(cost)).sum();
        let proven = costs.contains(&NEVER) || sum >= bound;
        if !proven { self.add_clauses(&mut formula, &costs, Some(bound - 1 - sum).filter(|_| bound < INFINITE))?; }
        while line != "end" {
            let (name, rest) = line.split_once(' ').unwrap_or((line.as_str(), ""));
            let known = proven || formula.step(name, &mut Tokens::rest(rest))?;
            if !known { return Err(unreadable("expected a line of a formula")); }
            line = self.line()?;
        }
        let raised = formula.proven();
        let proven = proven || raised.map_or(true, |raised| sum + raised >= bound);
        let shown = (sum + raised.unwrap_or(0)).saturating_sub(formula.choices.constant());
        ensure(proven, format!("the formula proves {}; expected {}", shown, text(of.bound)))
    }

    /// Adds the clauses that hold for all plans in which the sum of the excesses over `costs` is at most `excess` (None: for all plans).
    fn add_clauses(&mut self, formula: &mut Formula, costs: &[u32], excess: Option<u64>) -> Result<(), Fault> {
        formula.close(excess, &self.chains, |one, two| self.permits(one, two))?;
        for (agent, level) in formula.levels() {
            let cost = costs[agent as usize];
            let model = if self.least_prices[agent as usize].is_some() { self.model(agent) } else { self.successors(agent).1.model };
            let paths = Paths::of(model, cost + level);
            let paths = paths.ok_or_else(|| (1, format!("orders of agent {} with many tasks, too far from the best one", agent)))?;
            formula.add_paths(agent, model, &paths, cost, level);
        }
        let written = self.clauses.as_ref().map_or(Ok(()), |file| std::fs::write(file, formula.dimacs()));
        written.map_err(|error| unreadable(format!("cannot write the clauses: {}", error)))
    }

    fn prices(&mut self, of: &Lemma) -> Result<(), Fault> {
        let (agents, places) = (self.models.len(), self.instance.world.links.len());
        ensure(of.agents.len() == agents && self.trail.is_empty(), "prices require all agents, without constraints")?;
        let mut prices = Prices::default();
        let price = |tokens: &mut Tokens| tokens.number().map(u64::from);  // below 2^30, so sums do not overflow
        loop {
            let line = self.line()?;
            let mut tokens = Tokens::of(&line);
            match tokens.token()? {
                "place" => prices.place(tokens.index(places, "place")?, tokens.number()?, price(&mut tokens)?),
                "edge" => {
                    let (from, to) = (tokens.index(places, "place")?, tokens.index(places, "place")?);
                    ensure(from < to, "the places of an edge must ascend")?;
                    prices.edge(from, to, tokens.number()?, price(&mut tokens)?);
                }
                "finish" => {
                    let mut side = || Ok::<_, Fault>((tokens.index(agents, "agent")?, tokens.number()?));
                    let (one, two) = (side()?, side()?);
                    let none = one.0 < two.0 && self.none_joint(&[one.0, two.0], &[one.1, two.1], Some(INFINITE));
                    ensure(none, "both agents may have finished by these times")?;
                    prices.finish([one, two], price(&mut tokens)?);
                }
                "end" => break,
                _ => return Err(unreadable("expected a row, or 'end'")),
            }
            tokens.end()?;
        }
        prices.close();
        let mut sum = 0u64;
        for agent in 0..agents as u32 {
            match prices.of(agent, &mut self.successors(agent).1) { Some(price) => sum += price, None => return Ok(()) }
        }
        let bound = (sum.saturating_sub(prices.sum) + UNIT - 1) / UNIT;
        ensure(bound >= of.bound, format!("prices prove {}; expected {}", bound, text(of.bound)))
    }
}
