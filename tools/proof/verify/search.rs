// SPDX-License-Identifier: MIT
//! Least cost of one agent by safe-interval A*. A label is a state, a time interval in which its place is free (safe interval), and an
//! arrival time. The earliest label of a state and interval dominates later ones, because the agent can wait.
use crate::agent::NEVER;
use crate::instance::Place;
use crate::rules::{Constraint, Kind};
use crate::successors::{Arrival, State, Successors};

/// An arrival, and the index of its parent label in `labels` (u32::MAX: none).
type Label = (Arrival, u32);

/// The places of a path in order, each with the arrival time. The first entry is the start, at time 0.
pub type Path = Vec<(u32, Place)>;

#[derive(Default)]
pub struct Search {
    /// Open labels in buckets. The index of a bucket is the lower bound of its labels minus that of the first start label.
    waiting: Vec<Vec<Label>>,
    /// Expanded labels. A label's kind is its state and interval; the first expanded label of a kind is the earliest.
    labels: Vec<Label>,
    /// Hash table of the kinds of expanded labels: pose, index of the set of stops done, interval, and `searches` << 4 | flags.
    table: Vec<[u32; 4]>,
    pub searches: u32,
}

impl Search {
    /// Returns the least cost of the agent and a path of this cost. Returns None if no path has a cost up to the limit of the model.
    pub fn least(&mut self, successors: &mut Successors) -> Option<(u32, Path)> {
        self.searches += 1;
        assert!(self.searches < 1 << 28, "fewer searches");
        self.labels.clear();
        self.waiting.iter_mut().for_each(Vec::clear);
        let (mut found, mut now, mut before, limit) = (Vec::new(), 0, u32::MAX, successors.model.limit());
        for state in successors.starts() {
            let interval = successors.rules.holding(successors.place(&state), 0).expect("it may be there");
            if state.left <= successors.rules.interval(interval).1 { found.push((State { left: 0, ..state }, interval, state.left)); }
        }
        let least = found.first().map_or(0, |(state, _, time)| time + successors.remains(state));
        loop {
            for (state, interval, time) in found.drain(..) {
                let remains = successors.remains(&state);
                if remains >= NEVER || time + remains > limit.min(NEVER - 1) {
                    assert!(remains >= NEVER || limit < NEVER, "a cost below 2^30");
                    continue;
                }
                let bucket = (time + remains - least) as usize;
                assert!(bucket >= now, "costs to go that are not consistent");
                if self.waiting.len() <= bucket { self.waiting.resize(bucket + 1, Vec::new()); }
                self.waiting[bucket].push(((state, interval, time), before));
            }
            while self.waiting.get(now).map_or(false, Vec::is_empty) { now += 1; }
            let label = self.waiting.get_mut(now)?.pop().expect("one that waits");
            if !self.is_first(&label) { continue; }
            before = self.labels.len() as u32;
            self.labels.push(label);
            let (state, interval, time) = label.0;
            let end = successors.rules.interval(interval).1;
            if end == NEVER && successors.rests(&state) { return Some((time, self.path(successors))); }
            if successors.over(&state) { continue; }
            let work = successors.choices(state).into_iter().map(|next| (State { left: 0, ..next }, interval, time + next.left));
            found.extend(work.filter(|next| next.2 <= end));
            successors.go(label.0, (end, end), &mut found);
        }
    }

    /// Returns whether the label is the first of its kind, and therefore the earliest; stores its kind.
    fn is_first(&mut self, &((state, interval, _), _): &Label) -> bool {
        if self.table.len() < 2 * self.labels.len() + 1024 {
            let old = std::mem::take(&mut self.table);
            self.table = vec![[0; 4]; (4 * self.labels.len() + 2048).next_power_of_two()];
            for kind in old { if kind[3] >> 4 == self.searches { self.put(kind); } }
        }
        self.put([state.pose, state.done, interval, self.searches << 4 | u32::from(state.flags)])
    }

    fn put(&mut self, kind: [u32; 4]) -> bool {
        let word = |at: usize| u64::from(kind[at]) << 32 | u64::from(kind[at + 1]);
        let mixed = word(0).wrapping_mul(0x9e3779b97f4a7c15) ^ word(2).wrapping_mul(0xd6e8feb86659fd93);
        let mut slot = (mixed >> 24) as usize & (self.table.len() - 1);
        while self.table[slot][3] >> 4 == self.searches {
            if self.table[slot] == kind { return false; }
            slot = (slot + 1) & (self.table.len() - 1);
        }
        self.table[slot] = kind;
        true
    }

    /// Returns the path to the last expanded label.
    fn path(&self, successors: &Successors) -> Path {
        let (mut path, mut number) = (Path::new(), self.labels.len() as u32 - 1);
        while number != u32::MAX {
            let ((state, _, time), before) = self.labels[number as usize];
            let place = successors.place(&state);
            match path.last_mut() {
                Some(last) if last.1 == place => last.0 = time,
                _ => path.push((time, place)),
            }
            number = before;
        }
        path.reverse();
        path[0].0 = 0;
        path
    }
}

/// Returns whether the places and times of a path suffice to show that it satisfies a constraint. For Stop and NoStop they never do.
pub fn surely_satisfies(path: &Path, constraint: &Constraint) -> bool {
    let Constraint { kind, p, q, s, e, .. } = *constraint;
    let (arrival, last) = path[path.len() - 1];
    let within = |time: u32| s <= time && time <= e;
    match kind {
        Kind::Bar => {
            let leaves = path.iter().skip(1).map(|step| step.0 - 1).chain([NEVER]);
            !path.iter().zip(leaves).any(|(&(from, place), to)| place == p && from <= e && s <= to)
        }
        Kind::Move | Kind::Pass => !path.windows(2).any(|two| two[0].1 == p && two[1].1 == q && within(two[1].0)),
        Kind::NoRest => last != p || arrival > s,
        Kind::Rest => last == p && arrival <= s,
        Kind::Stop | Kind::NoStop => false,
    }
}
