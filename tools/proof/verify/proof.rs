// SPDX-License-Identifier: MIT
//! The certificate: lemmas, the theorem, and the rules of their proofs (docs/proof.md, 3 and 4).
use crate::body::{Body, Poses, NEVER};
use crate::cover;
use crate::instance::Instance;
use crate::joint::{Joint, Layers, Walk};
use crate::prices::{Prices, UNIT};
use crate::reader::Lines;
use crate::rules::{Chains, Demand, Kind, Rules};
use crate::search::{surely_meets, Path, Rows, Search};
use std::collections::HashMap;
use std::rc::Rc;

/// Why a certificate is not accepted.
pub enum Fault {
    Refused(String),
    Unreadable(String),
}

impl From<String> for Fault {
    fn from(reason: String) -> Fault {
        Fault::Unreadable(reason)
    }
}

fn refuse<T>(reason: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Refused(reason.into()))
}

fn unreadable<T>(reason: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Unreadable(reason.into()))
}

/// A bound that no sum of costs reaches.
const INFINITE: u64 = u64::MAX;

struct Lemma {
    agents: Vec<u32>,
    bound: u64,
    demands: Vec<Demand>,
}

/// The cost of an agent under the first so many of its demands, and a path that has it.
struct Known {
    demands: usize,
    cost: u32,
    path: Path,
}

/// A split on the way to where the proof is read.
struct Split {
    trail: usize,
    second: Option<Demand>,
}

pub struct Verifier {
    instance: Instance,
    chains: Chains,
    poses: HashMap<u32, Rc<Poses>>,
    bodies: Vec<Option<Body>>,
    rules: Rules,
    search: Search,
    lines: Lines,
    following: bool,
    lemmas: Vec<Lemma>,
    /// Whose demands were added, in order; those demands of each agent; how often each is there.
    trail: Vec<u32>,
    demands: Vec<Vec<Demand>>,
    present: HashMap<Demand, u32>,
    known: Vec<Vec<Known>>,
    pub nodes: u64,
}

/// The words of a line, as numbers and more.
struct Words<'a>(std::str::Split<'a, char>);

impl<'a> Words<'a> {
    fn of(line: &'a str) -> Words<'a> {
        Words(line.split(' '))
    }

    fn word(&mut self) -> Result<&'a str, Fault> {
        self.0.next().filter(|word| !word.is_empty()).ok_or_else(|| Fault::Unreadable("expected another word".to_string()))
    }

    fn whole(&mut self) -> Result<u64, Fault> {
        let word = self.word()?;
        if !word.bytes().all(|byte| byte.is_ascii_digit()) {
            return unreadable(format!("expected a number, not '{:.20}'", word));
        }
        word.parse().or_else(|_| refuse("a number that is too large"))
    }

    fn number(&mut self) -> Result<u32, Fault> {
        let value = self.whole()?;
        if value < u64::from(NEVER) { Ok(value as u32) } else { refuse("a number that is too large") }
    }

    fn index(&mut self, count: usize, what: &str) -> Result<u32, Fault> {
        let value = self.number()?;
        if (value as usize) < count { Ok(value) } else { refuse(format!("there is no {} {}", what, value)) }
    }

    /// A number or `inf`.
    fn or_inf(&mut self) -> Result<Option<u32>, Fault> {
        if self.0.clone().next() == Some("inf") {
            self.0.next();
            return Ok(None);
        }
        self.number().map(Some)
    }

    fn bound(&mut self) -> Result<u64, Fault> {
        Ok(self.or_inf()?.map_or(INFINITE, u64::from))
    }

    fn end(&mut self) -> Result<(), Fault> {
        self.0.next().map_or(Ok(()), |_| unreadable("expected the end of the line"))
    }
}

impl Verifier {
    pub fn new(instance: Instance, lines: Lines) -> Verifier {
        let (agents, places) = (instance.agents.len(), instance.world.links.len());
        Verifier {
            chains: Chains::of(&instance.world),
            poses: HashMap::new(),
            bodies: (0..agents).map(|_| None).collect(),
            rules: Rules::new(places),
            search: Search::default(),
            lines,
            following: true,
            lemmas: Vec::new(),
            trail: Vec::new(),
            demands: vec![Vec::new(); agents],
            present: HashMap::new(),
            known: (0..agents).map(|_| Vec::new()).collect(),
            nodes: 0,
            instance,
        }
    }

    pub fn statistics(&self) -> String {
        let (lines, lemmas) = (self.lines.number, self.lemmas.len());
        format!("{} lines, {} nodes, {} lemmas, {} searches", lines, self.nodes, lemmas, self.search.searches)
    }

    /// The line that was read last.
    fn line(&mut self) -> Result<String, Fault> {
        crate::LINE.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let line = self.lines.next()?;
        match line {
            None => unreadable("expected more"),
            Some(line) if line.ends_with(' ') => unreadable("expected no blank at the end of the line"),
            Some(line) => Ok(line.to_string()),
        }
    }

    /// What the theorem says: L, or None for `inf`.
    pub fn run(&mut self) -> Result<Option<u64>, Fault> {
        if self.line()? != "grove-proof 1" {
            return unreadable("expected 'grove-proof 1'");
        }
        let line = self.line()?;
        let sum = line.strip_prefix("instance ").filter(|sum| sum.len() == 16).and_then(|sum| u64::from_str_radix(sum, 16).ok());
        match sum {
            None => return unreadable("expected 'instance' and 16 digits"),
            Some(sum) if sum != self.instance.checksum => return refuse("it is of another instance"),
            _ => (),
        }
        self.following = match self.line()?.as_str() {
            "following yes" => true,
            "following no" => false,
            _ => return unreadable("expected 'following yes' or 'following no'"),
        };
        loop {
            let line = self.line()?;
            let mut words = Words::of(&line);
            match words.word()? {
                "lemma" => {
                    let lemma = self.lemma(words)?;
                    self.lemmas.push(lemma);
                }
                "theorem" => {
                    let bound = words.bound()?;
                    words.end()?;
                    let first = self.line()?;
                    let all = (0..self.instance.agents.len() as u32).collect();
                    self.proof(first, &Lemma { agents: all, bound, demands: Vec::new() })?;
                    if self.line()? != "end" || self.lines.next()?.is_some() {
                        return unreadable("expected 'end', and the end of the file");
                    }
                    return Ok(Some(bound).filter(|&bound| bound != INFINITE));
                }
                _ => return unreadable("expected 'lemma' or 'theorem'"),
            }
        }
    }

    fn lemma(&mut self, mut words: Words) -> Result<Lemma, Fault> {
        let mut lemma = Lemma { bound: words.bound()?, agents: Vec::new(), demands: Vec::new() };
        while lemma.agents.is_empty() || words.0.clone().next().is_some() {
            let agent = words.index(self.instance.agents.len(), "agent")?;
            if lemma.agents.last().map_or(false, |&last| last >= agent) {
                return refuse("agents that do not ascend");
            }
            lemma.agents.push(agent);
        }
        loop {
            let line = self.line()?;
            match line.strip_prefix("demand ") {
                Some(text) => lemma.demands.push(self.demand(text, &lemma.agents)?),
                None => return self.proof(line, &lemma).map(|_| lemma),
            }
        }
    }

    fn body(&mut self, agent: u32) -> &mut Body {
        if self.bodies[agent as usize].is_none() {
            let found = &self.instance.agents[agent as usize];
            let world = &self.instance.world;
            let poses = self.poses.entry(found.turn).or_insert_with(|| Rc::new(Poses::of(world, found.turn))).clone();
            self.bodies[agent as usize] = Some(Body::of(&self.instance, found, poses));
        }
        self.bodies[agent as usize].as_mut().expect("just made")
    }

    fn demand(&mut self, text: &str, agents: &[u32]) -> Result<Demand, Fault> {
        let mut words = Words::of(text);
        let agent = words.number()?;
        if agents.binary_search(&agent).is_err() {
            return refuse(format!("agent {} is not among those of whom this is", agent));
        }
        let places = self.instance.world.links.len();
        let mut demand = Demand { agent, kind: Kind::Bar, p: 0, q: 0, s: 0, e: 0 };
        demand.kind = match words.word()? {
            "bar" => Kind::Bar,
            "move" => Kind::Move,
            "norest" => Kind::NoRest,
            "rest" => Kind::Rest,
            "pass" => Kind::Pass,
            "stop" => Kind::Stop,
            "nostop" => Kind::NoStop,
            _ => return unreadable("expected a demand"),
        };
        if matches!(demand.kind, Kind::Stop | Kind::NoStop) {
            demand.p = words.number()?;
            demand.q = words.number()?;
            let stops = &self.body(agent).stops;
            if demand.p as usize >= stops.len() || !stops.iter().any(|stop| stop.task == demand.q) {
                return refuse("no such number, or no such stop of this agent");
            }
            return words.end().map(|_| demand);
        }
        demand.p = words.index(places, "place")?;
        if matches!(demand.kind, Kind::Move | Kind::Pass) {
            demand.q = words.index(places, "place")?;
            if demand.p == demand.q || (demand.kind == Kind::Pass && self.chains.exit(demand.p, demand.q).is_none()) {
                return refuse("expected two places, for 'pass' the last of a chain and the end next to it");
            }
        }
        demand.s = words.number()?;
        let ends = !matches!(demand.kind, Kind::Rest | Kind::NoRest);
        demand.e = if ends { words.or_inf()?.unwrap_or(NEVER) } else { demand.s };
        words.end().map(|_| demand)
    }

    fn push(&mut self, demand: Demand) {
        self.demands[demand.agent as usize].push(demand);
        self.trail.push(demand.agent);
        *self.present.entry(demand).or_insert(0) += 1;
    }

    /// Adds what one side of a split demands: who rests on a place for ever has it for itself.
    fn assume(&mut self, demand: Demand, agents: &[u32]) {
        self.push(demand);
        if demand.kind == Kind::Rest {
            for &agent in agents.iter().filter(|&&agent| agent != demand.agent) {
                self.push(Demand { agent, kind: Kind::Bar, e: NEVER, ..demand });
            }
        }
    }

    fn undo(&mut self, trail: usize) {
        while self.trail.len() > trail {
            let agent = self.trail.pop().expect("a demand") as usize;
            let demand = self.demands[agent].pop().expect("a demand");
            match self.present.get_mut(&demand) {
                Some(count) if *count > 1 => *count -= 1,
                _ => drop(self.present.remove(&demand)),
            }
            while self.known[agent].last().map_or(false, |known| known.demands > self.demands[agent].len()) {
                self.known[agent].pop();
            }
        }
    }

    /// Reads the proof of a statement; its first line is read already.
    fn proof(&mut self, first: String, of: &Lemma) -> Result<(), Fault> {
        of.demands.iter().for_each(|&demand| self.push(demand));
        let (mut splits, mut line): (Vec<Split>, _) = (Vec::new(), first);
        loop {
            self.nodes += 1;
            let (rule, rest) = line.split_once(' ').map_or((line.as_str(), ""), |(rule, rest)| (rule, rest));
            let alternative = match rule {
                "split" => Some(self.split(rest, of)?),
                "later" => Some(self.later(rest, of)?),
                "leaf" => self.leaf(rest, of).map(|_| None)?,
                "joint" if rest.is_empty() => self.joint(of).map(|_| None)?,
                "prices" if rest.is_empty() => self.prices(of).map(|_| None)?,
                _ => return unreadable("expected a rule"),
            };
            if let Some((one, two)) = alternative {
                splits.push(Split { trail: self.trail.len(), second: Some(two) });
                self.assume(one, &of.agents);
            } else {
                // What is proven closes splits, up to one whose second side is still to come.
                loop {
                    match splits.last_mut().map(|split| (split.trail, split.second.take())) {
                        None => {
                            self.undo(0);
                            return Ok(());
                        }
                        Some((trail, Some(second))) => {
                            self.undo(trail);
                            self.assume(second, &of.agents);
                            break;
                        }
                        Some((trail, None)) => {
                            self.undo(trail);
                            splits.pop();
                        }
                    }
                }
            }
            line = self.line()?;
        }
    }

    fn split(&mut self, text: &str, of: &Lemma) -> Result<(Demand, Demand), Fault> {
        let (one, two) = match text.split_once(" | ") {
            Some((one, two)) => (self.demand(one, &of.agents)?, self.demand(two, &of.agents)?),
            None => return unreadable("expected two demands"),
        };
        let same = (one.p, one.q, one.s) == (two.p, two.q, two.s);
        let at_once = one.s == one.e && two.s == two.e;
        let permitted = match (one.kind, two.kind, one.agent == two.agent) {
            (Kind::Bar, Kind::Bar, false) => at_once && one.p == two.p && one.s.abs_diff(two.s) <= u32::from(!self.following),
            (Kind::Move, Kind::Move, false) => at_once && (one.p, one.q, one.s) == (two.q, two.p, two.s),
            (Kind::NoRest, Kind::Rest, true) | (Kind::Rest, Kind::NoRest, true) => same,
            (Kind::Stop, Kind::NoStop, true) | (Kind::NoStop, Kind::Stop, true) => same,
            (Kind::Pass, Kind::Pass, false) => {
                let (first, second) = (self.chains.exit(one.p, one.q), self.chains.exit(two.p, two.q));
                first.zip(second).map_or(false, |((chain, side, found), (other, back, _))| {
                    let times = one.e < NEVER && two.e < NEVER && one.e <= two.s + found.length && two.e <= one.s + found.length;
                    chain == other && side != back && times
                })
            }
            _ => false,
        };
        if permitted { Ok((one, two)) } else { refuse("a plan may meet neither of these demands") }
    }

    /// A lemma that may be used here.
    fn usable(&self, words: &mut Words, of: &Lemma) -> Result<&Lemma, Fault> {
        let number = words.index(self.lemmas.len(), "lemma")?;
        let lemma = &self.lemmas[number as usize];
        if let Some(agent) = lemma.agents.iter().find(|agent| of.agents.binary_search(agent).is_err()) {
            return refuse(format!("lemma {} is of agent {}, too", number, agent));
        }
        match lemma.demands.iter().position(|demand| !self.present.contains_key(demand)) {
            Some(missing) => refuse(format!("demand {} of lemma {} is not in force", missing, number)),
            None => Ok(lemma),
        }
    }

    fn later(&mut self, text: &str, of: &Lemma) -> Result<(Demand, Demand), Fault> {
        let mut words = Words::of(text);
        let mut side = |words: &mut Words| {
            let (agent, time) = (words.index(self.instance.agents.len(), "agent")?, words.number()?);
            match self.body(agent).plain_goal {
                Some(goal) => Ok(Demand { agent, kind: Kind::NoRest, p: goal, q: 0, s: time, e: time }),
                None => refuse(format!("agent {} has no plain goal", agent)),
            }
        };
        let (one, two) = (side(&mut words)?, side(&mut words)?);
        let lemma = self.usable(&mut words, of)?;
        words.end()?;
        let pair = [one.agent.min(two.agent), one.agent.max(two.agent)];
        if one.agent == two.agent || lemma.agents != pair || lemma.bound < u64::from(one.s) + u64::from(two.s) + 1 {
            return refuse("the lemma is not of these two, or says less");
        }
        Ok((one, two))
    }

    /// c(A, D), or a lower bound of it that is known already.
    fn cost(&mut self, agent: u32, exact: bool) -> u32 {
        self.body(agent);
        let number = agent as usize;
        let (demands, known) = (&self.demands[number], &mut self.known[number]);
        if let Some(last) = known.last() {
            if !exact || last.cost == NEVER || demands[last.demands..].iter().all(|demand| surely_meets(&last.path, demand)) {
                return last.cost;
            }
        }
        let body = self.bodies[number].as_mut().expect("made above");
        let met = self.rules.set(body, &self.chains, demands);
        let found = if met { self.search.least(body, &self.chains, &self.rules) } else { None };
        let (cost, path) = found.unwrap_or((NEVER, Vec::new()));
        known.push(Known { demands: demands.len(), cost, path });
        cost
    }

    fn leaf(&mut self, text: &str, of: &Lemma) -> Result<(), Fault> {
        let (mut words, mut names) = (Words::of(text), Vec::new());
        while !text.is_empty() && words.0.clone().next().is_some() {
            let lemma = self.usable(&mut words, of)?;
            if lemma.bound == INFINITE {
                return Ok(());
            }
            names.push((lemma.agents.clone(), lemma.bound));
        }
        let mut costs: Vec<u32> = of.agents.iter().map(|&agent| self.cost(agent, false)).collect();
        let mut sum: u64 = costs.iter().map(|&cost| u64::from(cost)).sum();
        for (i, &agent) in of.agents.iter().enumerate() {
            if costs[i] == NEVER || sum >= of.bound {
                return Ok(());
            }
            sum -= u64::from(costs[i]);
            costs[i] = self.cost(agent, true);
            sum += u64::from(costs[i]);
        }
        let cost_of = |agent: &u32| u64::from(costs[of.agents.binary_search(agent).expect("an agent of the lemma")]);
        let need = |(agents, bound): (Vec<u32>, u64)| {
            let more = bound.saturating_sub(agents.iter().map(cost_of).sum());
            (agents, more)
        };
        let more = cover::least(names.into_iter().map(need).collect());
        if costs.contains(&NEVER) || sum + more >= of.bound {
            return Ok(());
        }
        refuse(format!("costs {} and {} by lemmas, expected {}", sum, more, bound_text(of.bound)))
    }

    fn joint(&mut self, of: &Lemma) -> Result<(), Fault> {
        let mut caps = Vec::new();
        for &agent in &of.agents {
            caps.push(self.cost(agent, true));
        }
        let sum: u64 = caps.iter().map(|&cost| u64::from(cost)).sum();
        if caps.contains(&NEVER) || sum >= of.bound {
            return Ok(());
        }
        if of.bound < INFINITE {
            let spare = of.bound - 1 - sum;
            caps.iter_mut().for_each(|cap| *cap = u32::try_from(u64::from(*cap) + spare).unwrap_or(NEVER).min(NEVER - 1));
        } else {
            caps.iter_mut().for_each(|cap| *cap = NEVER);
        }
        let limit = Some(of.bound).filter(|&bound| bound < INFINITE);
        if self.none_joint(&of.agents, &caps, limit) {
            return Ok(());
        }
        refuse("joint search finds a plan that costs less")
    }

    /// No joint paths of these agents cost up to so much each, and less than a limit together.
    fn none_joint(&mut self, agents: &[u32], caps: &[u32], limit: Option<u64>) -> bool {
        let mut settled = 1;
        for &agent in agents {
            self.body(agent);
            let body = self.bodies[agent as usize].as_ref().expect("made above");
            if !self.rules.set(body, &self.chains, &self.demands[agent as usize]) {
                return true;
            }
            settled = settled.max(self.rules.settled);
        }
        let mut layers = Vec::new();
        for (&agent, &cap) in agents.iter().zip(caps) {
            let body = self.bodies[agent as usize].as_mut().expect("made above");
            self.rules.set(body, &self.chains, &self.demands[agent as usize]);
            let mut walk = Walk { body, chains: &self.chains, rules: &self.rules, rows: Rows::default() };
            layers.push(Layers::of(&mut walk, cap, settled));
        }
        Joint { layers, limit, settled, following: self.following }.finds_none()
    }

    fn prices(&mut self, of: &Lemma) -> Result<(), Fault> {
        if of.agents.len() < self.instance.agents.len() || !self.trail.is_empty() {
            return refuse("prices are of all agents, without demands");
        }
        let mut prices = Prices::default();
        let (agents, places) = (self.instance.agents.len(), self.instance.world.links.len());
        loop {
            let line = self.line()?;
            let mut words = Words::of(&line);
            match words.word()? {
                "place" => prices.place(words.index(places, "place")?, words.number()?, words.whole()?),
                "edge" => {
                    let (from, to) = (words.index(places, "place")?, words.index(places, "place")?);
                    if from >= to {
                        return refuse("places of an edge that do not ascend");
                    }
                    prices.edge(from, to, words.number()?, words.whole()?);
                }
                "finish" => {
                    let mut side = || Ok::<_, Fault>((words.index(agents, "agent")?, words.number()?));
                    let (one, two) = (side()?, side()?);
                    if one.0 >= two.0 || !self.none_joint(&[one.0, two.0], &[one.1, two.1], Some(INFINITE)) {
                        return refuse("these agents may both have finished by then");
                    }
                    prices.finish([one, two], words.whole()?);
                }
                "end" => break,
                _ => return unreadable("expected a row, or 'end'"),
            }
            words.end()?;
        }
        prices.close();
        let mut sum = 0u64;
        for agent in 0..agents as u32 {
            self.body(agent);
            let body = self.bodies[agent as usize].as_mut().expect("made above");
            self.rules.set(body, &self.chains, &[]);
            let mut walk = Walk { body, chains: &self.chains, rules: &self.rules, rows: Rows::default() };
            match prices.of(agent, &mut walk) {
                Some(price) => sum += price,
                None => return Ok(()),
            }
        }
        let bound = (sum.saturating_sub(prices.sum) + UNIT - 1) / UNIT;
        if of.bound == INFINITE || bound < of.bound {
            return refuse(format!("prices prove {}, expected {}", bound, bound_text(of.bound)));
        }
        Ok(())
    }
}

fn bound_text(bound: u64) -> String {
    if bound == INFINITE { "inf".to_string() } else { bound.to_string() }
}
