// SPDX-License-Identifier: MIT
//! States of one agent under constraints, and the steps between them. All searches use them.
use crate::agent::{AgentModel, NEVER};
use crate::instance::Place;
use crate::rules::{Chains, Rules, Flags, EARLY};

/// A state of an agent. `done`: index of its set of stops done, from AgentModel::number(); `left`: remaining time steps of the task
/// execution at the last of them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct State {
    pub pose: u32,
    pub done: u32,
    pub left: u32,
    pub flags: Flags,
}

/// A state, the index of a time interval in which its place is free, and the arrival time, which is in this interval.
pub type Arrival = (State, u32, u32);

pub struct Successors<'a> {
    pub model: &'a mut AgentModel,
    pub chains: &'a Chains,
    pub rules: &'a Rules,
}

impl Successors<'_> {
    pub fn place(&self, state: &State) -> Place { self.model.poses.place(state.pose) }

    fn full(&self, state: &State) -> bool { self.model.done(state.done) == self.model.all() }

    pub fn starts(&mut self) -> Vec<State> {
        let (pose, place, mut found) = (self.model.start, self.model.poses.place(self.model.start), Vec::new());
        let (stop, left) = self.model.working.map_or((0, 0), |(stop, end)| (1 << stop, end));
        let works = stop == 0 || self.rules.allowed[0] & stop != 0;
        if works && self.rules.holding(place, 0).is_some() {
            let done = self.done_on(place, 0) | stop;
            let state = State { pose, done: self.model.number(done), left, flags: self.rules.arrived(place, 0) };
            self.arrive(state, &mut found);
        }
        found
    }

    /// Returns `done` plus the stops that are done on arrival at this place: all stops there that take no time, or none if the order of
    /// stops is constrained.
    fn done_on(&self, place: Place, done: u64) -> u64 {
        let here = self.model.stops_at(place) & !done;
        if here == 0 || self.rules.ordered { done } else { done | self.model.has_no_duration(here) }
    }

    /// Returns the states that follow without a step if the agent counts a stop on its place as the next one. If the stop takes time, its
    /// task execution starts.
    pub fn choices(&mut self, state: State) -> Vec<State> {
        let done = self.model.done(state.done);
        let mut open = self.model.stops_at(self.place(&state)) & !done;
        if open == 0 || state.left > 0 { return Vec::new(); }
        open &= self.rules.allowed[done.count_ones() as usize];
        let begin = |stop: usize| State { done: self.model.number(done | 1 << stop), left: self.model.stops[stop].duration, ..state };
        (0..64).filter(|stop| open >> stop & 1 == 1).map(begin).collect()
    }

    fn arrive(&mut self, state: State, found: &mut Vec<State>) {
        found.push(state);
        found.extend(self.choices(state));
    }

    /// Returns whether the path must end in this state, because all stops are done, their order is constrained, and the agent rests on the
    /// place of its last stop.
    pub fn over(&self, state: &State) -> bool { self.rules.ordered && self.model.rests_on_last && self.full(state) }

    /// Returns the states at `time` + 1 that may follow `state` at `time`.
    pub fn steps(&mut self, state: State, time: u32) -> Vec<State> {
        let (mut found, mut gone) = (Vec::new(), Vec::new());
        let stays = self.rules.holding(self.place(&state), time + 1);
        if state.left == 0 && self.over(&state) { return found; }
        if stays.is_some() { self.arrive(State { left: state.left.saturating_sub(1), ..state }, &mut found); }
        if state.left == 0 {
            self.go((state, stays.unwrap_or(0), time), (time + u32::from(stays.is_some()), time), &mut gone);
            gone.into_iter().for_each(|(state, _, _)| self.arrive(state, &mut found));
        }
        found
    }

    /// Appends to `found` the earliest arrivals in neighbouring poses. The agent can be on its place until time `stays` and must leave it
    /// for a different place by time `leaves`.
    pub fn go(&mut self, (state, interval, time): Arrival, (stays, leaves): (u32, u32), found: &mut Vec<Arrival>) {
        let (from, poses) = (self.place(&state), self.model.poses.clone());
        for &pose in poses.next(state.pose) {
            let to = poses.place(pose);
            if to == from {
                if time < stays { found.push((State { pose, ..state }, interval, time + 1)); }
                continue;
            }
            let (flags, exit) = self.rules.passing(self.chains, state.flags, from, to);
            let mut after = State { pose, flags, ..state };
            if self.model.stops_at(to) != 0 {
                let done = self.done_on(to, self.model.done(state.done));
                after.done = self.model.number(done);
            }
            for interval in self.rules.ending(to, time + 1)..self.rules.intervals(to).end {
                let (first, last) = self.rules.interval(interval);
                if first > leaves + 1 { break; }
                let (first, last) = (first.max(time + 1), last.min(leaves + 1));
                if let Some(time) = self.rules.arrival(from, to, exit, first, last) {
                    let early = self.rules.arrived(to, time);
                    found.push((State { flags: flags | early, ..after }, interval, time));
                    if early != 0 {
                        let time = self.rules.arrival(from, to, exit, self.rules.rest_from(to).max(first), last);
                        found.extend(time.map(|time| (after, interval, time)));
                    }
                }
            }
        }
    }

    /// Returns a lower bound on the remaining cost from this state.
    pub fn remains(&self, state: &State) -> u32 { state.left + self.model.remains(state.done, state.pose) }

    /// Returns whether the agent may rest in this state, provided that its place is free forever.
    pub fn rests(&self, state: &State) -> bool { state.flags & EARLY == 0 && self.full(state) && self.remains(state) == 0 }

    /// Returns whether a path may end in this state at this time.
    pub fn may_end(&self, state: &State, time: u32) -> bool {
        let holding = self.rules.holding(self.place(state), time);
        holding.map_or(false, |number| self.rules.interval(number).1 == NEVER) && self.rests(state)
    }
}
