// SPDX-License-Identifier: MIT
//! Least costs of one agent: A* whose labels are a pose, stops done, how the agent stands, and an interval of time in which its place
//! is free. The earliest of these can do what later ones can: wait.
use crate::body::{Body, NEVER};
use crate::instance::Place;
use crate::rules::{Chains, Demand, Kind, Rules, Way, EARLY};
use std::rc::Rc;

#[derive(Clone, Copy)]
struct Label {
    pose: u32,
    row: u32,
    interval: u32,
    time: u32,
    before: u32,
    way: Way,
}

/// When an agent arrives where, with the time of the start first.
pub type Path = Vec<(u32, Place)>;

#[derive(Default)]
pub struct Search {
    labels: Vec<Label>,
    /// Where the best label of its kind is, by hash; with the number of the search.
    table: Vec<(u32, u32)>,
    stamp: u32,
    waiting: Vec<Vec<u32>>,
    rows: Rows,
    least: u32,
    now: usize,
    pub searches: u64,
}

/// Sets of stops done that occurred in a search, with what remains then of each pose.
#[derive(Default)]
pub struct Rows(Vec<(u64, Rc<Vec<u32>>)>);

impl Rows {
    pub fn number(&mut self, body: &mut Body, rules: &Rules, done: u64) -> u32 {
        if let Some(found) = self.0.iter().position(|row| row.0 == done) { return found as u32; }
        self.0.push((done, body.remaining(&rules.allowed, done)));
        self.0.len() as u32 - 1
    }

    fn done(&self, row: u32) -> u64 { self.0[row as usize].0 }

    pub fn remains(&self, row: u32, pose: u32) -> u32 { self.0[row as usize].1[pose as usize] }
}

fn hash(label: &Label) -> usize {
    let mixed = (u64::from(label.pose) << 32 | u64::from(label.row) << 4 | u64::from(label.way)).wrapping_mul(0x9e3779b97f4a7c15);
    ((mixed ^ u64::from(label.interval).wrapping_mul(0xd6e8feb86659fd93)) >> 24) as usize
}

impl Search {
    /// The least cost, with a path that has it.
    pub fn least(&mut self, body: &mut Body, chains: &Chains, rules: &Rules) -> Option<(u32, Path)> {
        self.searches += 1;
        self.stamp += 1;
        self.labels.clear();
        self.rows = Rows::default();
        self.waiting.iter_mut().for_each(Vec::clear);
        self.now = 0;
        self.begin(body, rules);
        while self.now < self.waiting.len() {
            let found = match self.waiting[self.now].pop() { Some(found) => found, None => { self.now += 1; continue } };
            let label = self.labels[found as usize];
            if self.table[self.slot(&label)].1 != found { continue; }
            let (done, hi) = (self.rows.done(label.row), rules.interval(label.interval).1);
            let full = done == body.all();
            if full && hi == NEVER && label.way & EARLY == 0 && self.rows.remains(label.row, label.pose) == 0 {
                return Some((label.time, self.path(body, found)));
            }
            if !(full && rules.ordered && body.rests_on_last) {
                self.work(body, rules, found, label, hi);
                self.go(body, chains, rules, found, label, hi);
            }
        }
        None
    }

    fn begin(&mut self, body: &mut Body, rules: &Rules) {
        let place = body.poses.place(body.start);
        if let Some(interval) = rules.holding(place, 0) {
            let (mut done, mut time) = (now_done(body, rules, place, 0), 0);
            if let Some((stop, end)) = body.working {
                if rules.allowed[0] >> stop & 1 == 0 || rules.interval(interval).1 < end { return; }
                (done, time) = (done | 1 << stop, end);
            }
            if body.working.is_none() && !body.may_be(&rules.allowed, done, done, body.start) { return; }
            let row = self.rows.number(body, rules, done);
            let way = rules.arrived(place, 0);
            self.add(Label { pose: body.start, row, interval, time, before: u32::MAX, way });
        }
    }

    /// Stops done where it is: in work, or in an order as a choice.
    fn work(&mut self, body: &mut Body, rules: &Rules, before: u32, label: Label, hi: u32) {
        let done = self.rows.done(label.row);
        let mut open = body.stops_at(body.poses.place(label.pose)) & !done;
        if open != 0 { open &= rules.allowed[done.count_ones() as usize]; }
        for stop in (0..body.stops.len()).filter(|stop| open >> stop & 1 == 1) {
            let time = label.time + body.stops[stop].duration;
            if time <= hi && body.may_be(&rules.allowed, done | 1 << stop, 1 << stop, label.pose) {
                let row = self.rows.number(body, rules, done | 1 << stop);
                self.add(Label { row, time, before, ..label });
            }
        }
    }

    fn go(&mut self, body: &mut Body, chains: &Chains, rules: &Rules, before: u32, label: Label, hi: u32) {
        let from = body.poses.place(label.pose);
        let done = self.rows.done(label.row);
        let poses = body.poses.clone();
        for &pose in poses.next(label.pose) {
            let to = poses.place(pose);
            if to == from {
                if label.time < hi { self.add(Label { pose, time: label.time + 1, before, ..label }); }
                continue;
            }
            let (way, exit) = rules.passing(chains, label.way, from, to);
            let now = now_done(body, rules, to, done);
            if now != done && !body.may_be(&rules.allowed, now, now & !done, pose) { continue; }
            let row = if now == done { label.row } else { self.rows.number(body, rules, now) };
            for interval in rules.ending(to, label.time + 1)..rules.intervals(to).end {
                let (first, last) = rules.interval(interval);
                if first > hi + 1 { break; }
                let (first, last) = (first.max(label.time + 1), last.min(hi + 1));
                if let Some(time) = rules.arrival(from, to, exit, first, last) {
                    let early = rules.arrived(to, time);
                    self.add(Label { pose, row, interval, time, before, way: way | early });
                    if early != 0 {
                        if let Some(time) = rules.arrival(from, to, exit, rules.rest_from(to).max(first), last) {
                            self.add(Label { pose, row, interval, time, before, way });
                        }
                    }
                }
            }
        }
    }

    /// Where a label is in the table, or would be.
    fn slot(&self, label: &Label) -> usize {
        let mut slot = hash(label) & (self.table.len() - 1);
        while self.table[slot].0 == self.stamp {
            let other = &self.labels[self.table[slot].1 as usize];
            let key = |l: &Label| (l.pose, l.row, l.interval, l.way);
            if key(other) == key(label) { break; }
            slot = (slot + 1) & (self.table.len() - 1);
        }
        slot
    }

    fn add(&mut self, label: Label) {
        let remains = self.rows.remains(label.row, label.pose);
        if remains >= NEVER { return; }
        if self.table.len() < 2 * self.labels.len() + 1024 { self.grow(); }
        let slot = self.slot(&label);
        if self.table[slot].0 == self.stamp && self.labels[self.table[slot].1 as usize].time <= label.time { return; }
        let number = self.labels.len() as u32;
        self.table[slot] = (self.stamp, number);
        self.labels.push(label);
        let cost = label.time + remains;
        if number == 0 { self.least = cost; }
        let bucket = (cost - self.least) as usize;
        assert!(bucket >= self.now, "costs to go that are not consistent");
        if self.waiting.len() <= bucket { self.waiting.resize(bucket + 1, Vec::new()); }
        self.waiting[bucket].push(number);
    }

    fn grow(&mut self) {
        let current: Vec<u32> = self.table.iter().filter(|entry| entry.0 == self.stamp).map(|entry| entry.1).collect();
        self.table = vec![(0, 0); (4 * self.labels.len() + 2048).next_power_of_two()];
        for number in current {
            let slot = self.slot(&self.labels[number as usize]);
            self.table[slot] = (self.stamp, number);
        }
    }

    fn path(&self, body: &Body, mut number: u32) -> Path {
        let mut path: Path = Vec::new();
        while number != u32::MAX {
            let label = &self.labels[number as usize];
            let place = body.poses.place(label.pose);
            match path.last_mut() {
                Some(last) if last.1 == place => last.0 = label.time,
                _ => path.push((label.time, place)),
            }
            number = label.before;
        }
        path.reverse();
        path[0].0 = 0;
        path
    }
}

/// Without an order of stops those that take no time are done on arrival.
pub fn now_done(body: &Body, rules: &Rules, place: Place, done: u64) -> u64 {
    let here = body.stops_at(place) & !done;
    if here == 0 || rules.ordered { done } else { done | body.has_no_duration(here) }
}

/// Whether a path, known to meet others, surely meets this demand.
pub fn surely_meets(path: &Path, demand: &Demand) -> bool {
    let Demand { kind, p, q, s, e, .. } = *demand;
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
