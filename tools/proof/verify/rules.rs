// SPDX-License-Identifier: MIT
//! Constraints (docs/proof.md, section 2), and the steps of one agent that its constraints allow.
use crate::agent::{AgentModel, NEVER};
use crate::instance::{Place, World};

#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Kind { Bar, Move, NoRest, Rest, Pass, Stop, NoStop }

/// `p` and `q` are places; for Stop and NoStop, `p` is a position in the order of stops, from 0, and `q` the task of the stop. `s` and `e`
/// are times; e = s for Rest and NoRest.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Constraint {
    pub agent: u32,
    pub kind: Kind,
    pub p: u32,
    pub q: u32,
    pub s: u32,
    pub e: u32,
}

/// A chain of inner places from `first` to `last` (docs/proof.md, section 1). `ends[0]` is the end next to `first`, `ends[1]` the end next
/// to `last`. `length` is the number of steps from end to end.
pub struct Chain {
    first: Place,
    last: Place,
    ends: [Place; 2],
    pub length: u32,
}

impl Chain {
    /// For a traversal that leaves on a side (1 or 2): the end by which it enters, and its first inner place.
    pub fn entry(&self, side: u8) -> (Place, Place) { if side == 1 { (self.ends[1], self.last) } else { (self.ends[0], self.first) } }
}

/// All chains of a world.
pub struct Chains {
    /// For each place the index of its chain, or NONE.
    of: Vec<u32>,
    chains: Vec<Chain>,
}

const NONE: u32 = u32::MAX;

impl Chains {
    pub fn of(world: &World) -> Chains {
        let near = |place: Place| &world.neighbours[place as usize];
        let inner = |place: Place| near(place).len() == 2;
        let mut found = Chains { of: vec![NONE; world.links.len()], chains: Vec::new() };
        for end in (0..world.links.len() as u32).filter(|&place| !inner(place)) {
            for &first in near(end).iter().filter(|&&place| inner(place)) {
                if found.of[first as usize] != NONE { continue; }
                let (mut before, mut last, mut length) = (end, first, 2);
                loop {
                    found.of[last as usize] = found.chains.len() as u32;
                    let next = near(last)[usize::from(near(last)[0] == before)];
                    if !inner(next) {
                        found.chains.push(Chain { first, last, ends: [end, next], length });
                        break;
                    }
                    before = std::mem::replace(&mut last, next);
                    length += 1;
                }
            }
        }
        found
    }

    /// Returns whether a place is an inner place of the chain with this index.
    pub fn contains(&self, chain: u32, place: Place) -> bool { self.of[place as usize] == chain }

    /// Returns the side of the chain (1: ends[0], 2: ends[1]) on which a step between the inner place and the end enters or leaves it.
    fn side(&self, inner: Place, end: Place) -> u8 {
        let chain = &self.chains[self.of[inner as usize] as usize];
        let second = if chain.first == chain.last { end != chain.ends[0] } else { inner == chain.last };
        1 + u8::from(second)
    }

    /// Returns the index of the chain that a step from `inner` to `end` leaves, the side (1 or 2) on which it leaves, and the chain.
    /// Returns None if `inner` and `end` are not the last place of a chain and the end next to it.
    pub fn exit(&self, inner: Place, end: Place) -> Option<(u32, u8, &Chain)> {
        let number = self.of[inner as usize];
        let chain = self.chains.get(number as usize)?;
        let side = self.side(inner, end);
        let exit = if side == 1 { (chain.first, chain.ends[0]) } else { (chain.last, chain.ends[1]) };
        Some((number, side, chain)).filter(|_| exit == (inner, end))
    }
}

/// Effect of the constraints on one place. Valid only if `stamp` equals that of Rules.
#[derive(Clone, Copy, Default)]
struct Mark {
    stamp: u32,
    first: u32,
    count: u32,
    leaves: bool,
    /// The agent may not rest on the place after an arrival before this time.
    rest: u32,
}

/// Flags of a state. EARLY: the agent arrived on its place too early to rest there. 4 or 8: it entered its chain on side 1 or 2.
pub type Flags = u8;
pub const EARLY: Flags = 1;

/// The constraints on one agent in a form that the searches can query.
#[derive(Default)]
pub struct Rules {
    stamp: u32,
    marks: Vec<Mark>,
    safe: Vec<(u32, u32)>,
    moves: Vec<Constraint>,
    passes: Vec<(u32, u8, u32, u32)>,
    /// `allowed[k]`: the set of stops that may be at position k, from 0, of the order.
    pub allowed: Vec<u64>,
    /// Whether a constraint restricts the order of stops.
    pub ordered: bool,
    /// The first time after all finite times in constraints; at least 1.
    pub horizon: u32,
}

impl Rules {
    pub fn new(places: usize) -> Rules { Rules { marks: vec![Mark::default(); places], ..Rules::default() } }

    fn mark(&mut self, place: Place) -> &mut Mark {
        let mark = &mut self.marks[place as usize];
        if mark.stamp != self.stamp { *mark = Mark { stamp: self.stamp, count: 1, ..Mark::default() }; }
        mark
    }

    fn marked(&self, place: Place) -> Option<&Mark> {
        Some(&self.marks[place as usize]).filter(|mark| mark.stamp == self.stamp)
    }

    /// Replaces the rules by those for `constraints`, which are on the agent of `model`, and restricts the order of stops in the model.
    /// Returns false, and leaves the rules incomplete, if the agent would have to rest on two different places.
    pub fn set(&mut self, model: &mut AgentModel, chains: &Chains, constraints: &[Constraint]) -> bool {
        self.stamp += 1;
        self.moves.clear();
        self.passes.clear();
        self.allowed.clear();
        self.allowed.resize(model.stops.len(), model.all());
        self.ordered = false;
        self.horizon = 1;
        let mut bars: Vec<(Place, u32, u32)> = Vec::new();
        let mut rest: Option<(Place, u32)> = None;
        for constraint in constraints {
            let Constraint { kind, p, q, s, e, .. } = *constraint;
            let last = if e == NEVER { s } else { e };
            self.horizon = self.horizon.max(last + 1);
            match kind {
                Kind::Bar => bars.push((p, s, e)),
                Kind::Move => {
                    self.mark(p).leaves = true;
                    self.moves.push(*constraint);
                }
                Kind::NoRest => self.mark(p).rest = self.mark(p).rest.max(s + 1),
                Kind::Rest if rest.map_or(false, |(place, _)| place != p) => return false,
                Kind::Rest => rest = Some((p, rest.map_or(s, |(_, time)| time.min(s)))),
                Kind::Pass => self.passes.extend(chains.exit(p, q).map(|(chain, side, _)| (chain, side, s, e))),
                Kind::Stop | Kind::NoStop => {
                    let stop = model.stops.iter().position(|stop| stop.task == q).expect("a stop");
                    self.allowed[p as usize] &= if kind == Kind::Stop { 1 << stop } else { !(1 << stop) };
                    self.ordered = true;
                }
            }
        }
        // A Rest constraint (p, s) keeps the agent on p from time s on, so all other places are free only before s.
        let away = rest.map_or(NEVER, |(_, time)| time.wrapping_sub(1));
        self.safe.clear();
        self.safe.push(if away == u32::MAX { (1, 0) } else { (0, away) });
        bars.extend(rest.map(|(place, _)| (place, 1, 0)));
        bars.sort_unstable();
        let mut at = 0;
        while at < bars.len() {
            let place = bars[at].0;
            let end = if rest.map_or(false, |rest| rest.0 == place) || away == NEVER { NEVER } else { away };
            let (first, mut free) = (self.safe.len() as u32, 0);
            while at < bars.len() && bars[at].0 == place {
                let (_, s, e) = bars[at];
                at += 1;
                if s <= e {
                    self.free(free, s.wrapping_sub(1), end);
                    free = free.max(e + 1);
                }
            }
            self.free(free, NEVER, end);
            let count = self.safe.len() as u32 - first;
            *self.mark(place) = Mark { first, count, ..*self.mark(place) };
        }
        model.choose(&self.allowed);
        true
    }

    /// Adds a free interval from `from` to min(`to`, `end`). Adds none if it would be empty.
    fn free(&mut self, from: u32, to: u32, end: u32) {
        if from != u32::MAX && to != u32::MAX && end != u32::MAX && from <= to.min(end) { self.safe.push((from, to.min(end))); }
    }

    /// Returns the indices of the time intervals in which this place is free.
    pub fn intervals(&self, place: Place) -> std::ops::Range<u32> {
        self.marked(place).map_or(0..1, |mark| mark.first..mark.first + mark.count)
    }

    pub fn interval(&self, number: u32) -> (u32, u32) { self.safe[number as usize] }

    /// Returns the index of the first free interval of a place that ends at `time` or later; one past the last if none does.
    pub fn ending(&self, place: Place, time: u32) -> u32 {
        let range = self.intervals(place);
        let slice = &self.safe[range.start as usize..range.end as usize];
        range.start + slice.partition_point(|interval| interval.1 < time) as u32
    }

    /// Returns the index of the free interval of a place that contains `time`. Returns None if the place is not free then.
    pub fn holding(&self, place: Place, time: u32) -> Option<u32> {
        Some(self.ending(place, time)).filter(|&number| number < self.intervals(place).end && self.safe[number as usize].0 <= time)
    }

    /// Returns the least arrival time from which on the agent may rest on the place.
    pub fn rest_from(&self, place: Place) -> u32 { self.marked(place).map_or(0, |mark| mark.rest) }

    pub fn arrived(&self, place: Place, time: u32) -> Flags { if time < self.rest_from(place) { EARLY } else { 0 } }

    /// Returns the flags, without EARLY, after a step between two places. If the step completes a traversal of a chain that a Pass
    /// constraint names, also returns the index of the chain and the side on which the step leaves it.
    pub fn passing(&self, chains: &Chains, flags: Flags, from: Place, to: Place) -> (Flags, Option<(u32, u8)>) {
        let known = |place: Place| Some(chains.of[place as usize]).filter(|&chain| self.passes.iter().any(|pass| pass.0 == chain));
        if self.passes.is_empty() { return (0, None); }
        let (of, into) = (known(from), known(to));
        if into.is_some() { return (if of == into { flags & !EARLY } else { chains.side(to, from) << 2 }, None); }
        let exit = of.map(|chain| (chain, chains.side(from, to)));
        (0, exit.filter(|&(_, side)| flags >> 2 != 0 && flags >> 2 != side))
    }

    /// Returns the first time from `lo` to `hi` at which the agent may arrive by this step. `exit` is the traversal that the step
    /// completes, as returned by passing(). Returns None if it may not arrive in this interval.
    pub fn arrival(&self, from: Place, to: Place, exit: Option<(u32, u8)>, lo: u32, hi: u32) -> Option<u32> {
        let leaves = self.marked(from).map_or(false, |mark| mark.leaves);
        let mut time = lo;
        while time <= hi {
            let covers = |s: u32, e: u32| s <= time && time <= e;
            let barred = self.moves.iter().filter(|_| leaves).find(|d| d.p == from && d.q == to && covers(d.s, d.e)).map(|d| d.e);
            let passed = || self.passes.iter().find(|pass| exit == Some((pass.0, pass.1)) && covers(pass.2, pass.3)).map(|pass| pass.3);
            match barred.or_else(passed) {
                Some(end) => time = end + 1,
                None => return Some(time),
            }
        }
        None
    }
}
