// SPDX-License-Identifier: MIT
//! Prices (docs/proof.md, section 4): the least cost of a path with the prices of the rows that it uses.
use crate::agent::NEVER;
use crate::instance::Place;
use crate::successors::{State, Successors};
use crate::tokens::Map;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Units of a price in a step.
pub const UNIT: u64 = 1024;

#[derive(Default)]
pub struct Prices {
    /// Price of being on a place at a time.
    at: Map<(Place, u32), u64>,
    /// Price of being on a place at a time and at the time before.
    stay: Map<(Place, u32), u64>,
    /// Price of moving between two places, the lower number first, and arriving at a time.
    go: Map<(Place, Place, u32), u64>,
    /// For each agent, times and prices: an agent that costs at most the time pays the price.
    finish: Map<u32, Vec<(u32, u64)>>,
    /// Sum of the prices of all rows.
    pub sum: u64,
    /// For each place, times in ascending order, each with the sum of the prices from then on for an agent that rests there.
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

    /// Returns the price of a step that arrives at `time`.
    fn step(&self, from: Place, to: Place, time: u32) -> u64 {
        let edge = if from == to { self.stay.get(&(from, time)) } else { self.go.get(&(from.min(to), from.max(to), time)) };
        edge.unwrap_or(&0) + self.at.get(&(to, time)).unwrap_or(&0)
    }

    /// Returns the price of a path's end: of resting on `place` for ever, and of costing `time`.
    fn end(&self, agent: u32, place: Place, time: u32) -> u64 {
        let rows = self.rests.get(&place).map_or(&[][..], Vec::as_slice);
        let rest = rows.get(rows.partition_point(|row| row.0 <= time)).map_or(0, |row| row.1);
        let finish = self.finish.get(&agent).map_or(&[][..], Vec::as_slice);
        rest + finish.iter().filter(|row| time <= row.0).map(|row| row.1).sum::<u64>()
    }

    /// Returns the least cost of a path of an agent with the prices that it pays, in units. Returns None if there is no path.
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
                // A path whose last step changes nothing ends earlier, and costs that earlier time.
                if step != state { end(successors, &mut waiting, &step, time + 1, used); }
                push(successors, &mut waiting, step, time + 1, used);
            }
        }
        Some(beyond).filter(|_| limit < NEVER)
    }
}
