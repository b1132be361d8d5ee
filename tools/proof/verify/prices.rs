// SPDX-License-Identifier: MIT
//! Rule `prices` (docs/proof.md, section 4): the minimum, over the paths of an agent, of its cost plus the prices (Lagrangian
//! multipliers) of the rows that the path uses.
use crate::agent::NEVER;
use crate::instance::Place;
use crate::successors::{State, Successors};
use crate::tokens::Map;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Number of price units in one time step of cost.
pub const UNIT: u64 = 1024;

#[derive(Default)]
pub struct Prices {
    /// Price of being on a place at a given time.
    at: Map<(Place, u32), u64>,
    /// Price of being on a place at a given time and at the time step before.
    stay: Map<(Place, u32), u64>,
    /// Price of a move between two places, in either direction, that arrives at a given time. The place with the lower index comes first.
    go: Map<(Place, Place, u32), u64>,
    /// For each agent, pairs of a time and a price. The agent pays the price if its cost is at most the time.
    finish: Map<u32, Vec<(u32, u64)>>,
    /// Sum of the prices of all rows.
    pub sum: u64,
    /// For each place, pairs of a time and a price. After close(), the pairs are in ascending order of time, and each price is the sum of
    /// all prices that an agent pays if it rests there from the time of the pair on.
    rests: Map<Place, Vec<(u32, u64)>>,
}

impl Prices {
    pub fn place(&mut self, place: Place, time: u32, price: u64) {
        *self.at.entry((place, time)).or_insert(0) += price;
        self.rests.entry(place).or_default().push((time, price));
        self.sum += price;
    }

    pub fn edge(&mut self, from: Place, to: Place, time: u32, price: u64) {
        *self.go.entry((from, to, time)).or_insert(0) += price;
        *self.stay.entry((from, time)).or_insert(0) += price;
        self.rests.entry(from).or_default().push((time, price));
        self.sum += price;
    }

    pub fn finish(&mut self, agents: [(u32, u32); 2], price: u64) {
        agents.iter().for_each(|&(agent, time)| self.finish.entry(agent).or_default().push((time, price)));
        self.sum += price;
    }

    pub fn close(&mut self) {
        for rows in self.rests.values_mut() {
            rows.sort_unstable();
            let mut sum = 0;
            for row in rows.iter_mut().rev() {
                sum += row.1;
                row.1 = sum;
            }
        }
    }

    /// Returns the sum of the prices, in units, that a step with arrival at `time` pays.
    fn step(&self, from: Place, to: Place, time: u32) -> u64 {
        let edge = if from == to { self.stay.get(&(from, time)) } else { self.go.get(&(from.min(to), from.max(to), time)) };
        edge.unwrap_or(&0) + self.at.get(&(to, time)).unwrap_or(&0)
    }

    /// Returns the sum of the prices, in units, that a path pays at its end: for resting on `place` after `time` forever, and for a cost of
    /// `time`.
    fn end(&self, agent: u32, place: Place, time: u32) -> u64 {
        let rows = self.rests.get(&place).map_or(&[][..], Vec::as_slice);
        let rest = rows.get(rows.partition_point(|row| row.0 <= time)).map_or(0, |row| row.1);
        let finish = self.finish.get(&agent).map_or(&[][..], Vec::as_slice);
        rest + finish.iter().filter(|row| time <= row.0).map(|row| row.1).sum::<u64>()
    }

    /// Returns the minimum, over the paths of an agent, of the cost plus the prices that the path pays, in units. If paths that cost more
    /// than the limit of the model could have a smaller sum, returns a lower bound on the minimum. Returns None if the limit is NEVER and
    /// there is no path.
    pub fn of(&self, agent: u32, successors: &mut Successors) -> Option<u64> {
        let limit = successors.model.limit();
        let beyond = UNIT * (u64::from(limit) + 1);
        let mut waiting = BinaryHeap::new();
        let mut known: Map<(State, u32), u64> = Map::default();
        let place = successors.model.poses.place(successors.model.start);
        let steps: Vec<(State, u64)> = successors.starts().into_iter().map(|state| (state, *self.at.get(&(place, 0)).unwrap_or(&0))).collect();
        let mut push = |successors: &Successors, waiting: &mut BinaryHeap<_>, state: State, time: u32, used: u64| {
            let best = known.entry((state, time)).or_insert(u64::MAX);
            let remains = successors.remains(&state);
            if used < *best && remains < NEVER {
                *best = used;
                waiting.push(Reverse((UNIT * u64::from(time + remains) + used, u32::MAX - time, used, Some(state))));
            }
        };
        let end = |successors: &Successors, waiting: &mut BinaryHeap<_>, state: &State, time: u32, used: u64| {
            if !successors.may_end(state, time) { return; }
            waiting.push(Reverse((UNIT * u64::from(time) + used + self.end(agent, successors.place(state), time), u32::MAX - time, used, None)));
        };
        for (state, used) in steps {
            end(successors, &mut waiting, &state, 0, used);
            push(successors, &mut waiting, state, 0, used);
        }
        while let Some(Reverse((total, late, used, state))) = waiting.pop() {
            let (time, state) = match state {
                Some(state) => (u32::MAX - late, state),
                None => return Some(total.min(beyond)),
            };
            let place = successors.place(&state);
            for step in successors.steps(state, time) {
                let used = used + self.step(place, successors.place(&step), time + 1);
                // A path whose last step does not change the state ends before this step and has a lower cost.
                if step != state { end(successors, &mut waiting, &step, time + 1, used); }
                push(successors, &mut waiting, step, time + 1, used);
            }
        }
        Some(beyond).filter(|_| limit < NEVER)
    }
}
