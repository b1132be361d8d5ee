// SPDX-License-Identifier: MIT
//! Joint search: for each agent what it may be in at each time, in layers; then sets of such, one for each agent, from time to time.
use crate::body::{Body, NEVER};
use crate::instance::Place;
use crate::rules::{Chains, Rules, Way, EARLY};
use crate::search::{now_done, Rows};
use std::collections::{HashMap, HashSet};

/// What an agent is in at a time, that of a stop at which it is at work, with the steps left, included.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct State {
    pub pose: u32,
    done: u64,
    way: Way,
    work: Option<(u32, u32)>,
}

/// One agent, step by step.
pub struct Walk<'a> {
    pub body: &'a mut Body,
    pub chains: &'a Chains,
    pub rules: &'a Rules,
    pub rows: Rows,
}

impl Walk<'_> {
    pub fn starts(&mut self) -> Vec<State> {
        let (mut found, place) = (Vec::new(), self.body.poses.place(self.body.start));
        if self.rules.holding(place, 0).is_some() {
            let done = now_done(self.body, self.rules, place, 0);
            let state = State { pose: self.body.start, done, way: self.rules.arrived(place, 0), work: self.body.working };
            match self.body.working {
                Some((stop, _)) if self.rules.allowed[0] >> stop & 1 == 0 => (),
                Some(_) => found.push(state),
                None => self.arrive(state, &mut found),
            }
        }
        found
    }

    /// A state, or what else begins, or is chosen, with it.
    fn arrive(&self, state: State, found: &mut Vec<State>) {
        found.push(state);
        let open = self.body.stops_at(self.body.poses.place(state.pose)) & !state.done;
        for stop in (0..self.body.stops.len()).filter(|stop| open >> stop & 1 == 1) {
            if self.rules.allowed[state.done.count_ones() as usize] >> stop & 1 == 1 {
                found.push(match self.body.stops[stop].duration {
                    0 => State { done: state.done | 1 << stop, ..state },
                    duration => State { work: Some((stop as u32, duration)), ..state },
                });
            }
        }
    }

    /// The states of the next time.
    pub fn steps(&mut self, state: State, time: u32) -> Vec<State> {
        let mut found = Vec::new();
        let from = self.body.poses.place(state.pose);
        let stays = self.rules.holding(from, time + 1).is_some();
        if let Some((stop, left)) = state.work.filter(|_| stays) {
            match left {
                1 => self.arrive(State { done: state.done | 1 << stop, work: None, ..state }, &mut found),
                _ => found.push(State { work: Some((stop, left - 1)), ..state }),
            }
        }
        if state.work.is_some() || (self.rules.ordered && self.body.rests_on_last && state.done == self.body.all()) {
            return found;
        }
        if stays { self.arrive(state, &mut found); }
        let poses = self.body.poses.clone();
        for &pose in poses.next(state.pose) {
            let to = poses.place(pose);
            if to == from && stays { self.arrive(State { pose, ..state }, &mut found); }
            let (way, exit) = self.rules.passing(self.chains, state.way, from, to);
            let free = self.rules.holding(to, time + 1).is_some() && self.rules.arrival(from, to, exit, time + 1, time + 1).is_some();
            if to != from && free {
                let done = now_done(self.body, self.rules, to, state.done);
                let way = way | self.rules.arrived(to, time + 1);
                self.arrive(State { pose, done, way, work: None }, &mut found);
            }
        }
        found
    }

    /// What remains at least.
    pub fn remains(&mut self, state: &State) -> u32 {
        let (stop, left) = state.work.unwrap_or((0, 0));
        let done = if left > 0 { state.done | 1 << stop } else { state.done };
        let row = self.rows.number(self.body, self.rules, done);
        left + self.rows.remains(row, state.pose)
    }

    pub fn may_end(&mut self, state: &State, time: u32) -> bool {
        let place = self.body.poses.place(state.pose);
        let free = self.rules.holding(place, time).map_or(false, |number| self.rules.interval(number).1 == NEVER);
        free && state.way & EARLY == 0 && state.done == self.body.all() && self.remains(state) == 0
    }
}

struct Point {
    place: Place,
    next: Vec<u32>,
    ends: bool,
    /// The least cost of a path through it, if costs matter.
    least: u32,
}

/// Of each time the points of one agent; where the cost has no cap, all times from `settled` on are one.
pub struct Layers(Vec<Vec<Point>>);

impl Layers {
    pub fn of(walk: &mut Walk, cap: u32, settled: u32) -> Layers {
        assert!(walk.body.reach(&walk.rules.allowed, cap), "orders of many tasks, too far from the best one");
        let (mut layers, mut time) = (Vec::new(), 0);
        let keep = |walk: &mut Walk, state: &State, time: u32| {
            let remains = walk.remains(state);
            remains < NEVER && (cap == NEVER || time + remains <= cap)
        };
        let mut states: Vec<State> = walk.starts().into_iter().filter(|state| keep(walk, state, 0)).collect();
        let mut known: HashMap<State, u32> = states.iter().copied().zip(0..).collect();
        loop {
            let steady = cap == NEVER && time == settled;
            let (mut points, mut later, mut found) = (Vec::new(), Vec::new(), HashMap::new());
            while points.len() < states.len() {
                let state = states[points.len()];
                let mut next = Vec::new();
                for step in walk.steps(state, time) {
                    if keep(walk, &step, time + 1) {
                        let (list, known) = if steady { (&mut states, &mut known) } else { (&mut later, &mut found) };
                        next.push(*known.entry(step).or_insert(list.len() as u32));
                        if list.len() < known.len() { list.push(step); }
                    }
                }
                next.sort_unstable();
                next.dedup();
                let ends = walk.may_end(&state, time);
                points.push(Point { place: walk.body.poses.place(state.pose), next, ends, least: if cap == NEVER { 0 } else { NEVER } });
            }
            layers.push(points);
            if steady || later.is_empty() { break; }
            states = later;
            known = found;
            time += 1;
        }
        let mut layers = Layers(layers);
        if cap < NEVER { layers.least_costs(); }
        layers
    }

    fn least_costs(&mut self) {
        for time in (0..self.0.len()).rev() {
            let (now, later) = self.0.split_at_mut(time + 1);
            for point in &mut now[time] {
                let next = point.next.iter().map(|&next| later[0][next as usize].least).min();
                point.least = if point.ends { time as u32 } else { next.unwrap_or(NEVER) };
            }
        }
    }
}

/// In a set of points: an agent that rests on this place for ever.
const RESTS: u32 = 1 << 31;

pub struct Joint {
    pub layers: Vec<Layers>,
    /// Only sums of costs below this matter; without it, costs do not.
    pub limit: Option<u64>,
    pub settled: u32,
    pub following: bool,
}

/// A set of points at a time.
struct Node<'a> {
    key: &'a [u32],
    time: u32,
    /// Of agents from each on: the least that those cost that are not at rest.
    least: Vec<u64>,
}

impl Joint {
    pub fn finds_none(&self) -> bool {
        let mut nodes: HashMap<Vec<u32>, u64> = HashMap::from([(Vec::new(), 0)]);
        for layers in &self.layers {
            let longer = |key: &Vec<u32>| (0..layers.0[0].len() as u32).map(|next| (add(key, next), 0)).collect::<Vec<_>>();
            nodes = nodes.keys().flat_map(longer).collect();
        }
        let (mut seen, mut time) = (HashSet::new(), 0);
        while !nodes.is_empty() {
            let mut later = HashMap::new();
            for (key, &spent) in &nodes {
                let mut least = vec![0; key.len() + 1];
                for agent in (0..key.len()).rev() {
                    let costs = if key[agent] < RESTS { self.point(agent, time, key[agent]).least } else { 0 };
                    least[agent] = least[agent + 1] + u64::from(costs);
                }
                if self.extend(&Node { key, time, least }, &mut Vec::new(), (spent, 0), &mut later) { return false; }
            }
            if self.limit.is_none() && time == self.settled {
                later.retain(|key: &Vec<u32>, _| seen.insert(key.clone()));
            } else {
                time += 1;
            }
            nodes = later;
        }
        true
    }

    fn point(&self, agent: usize, time: u32, number: u32) -> &Point { &self.layers[agent].0[time as usize][number as usize] }

    /// Adds what the next agent may do to what those before do (point, place before, place after), and at last the set to
    /// `later`. `costs`: of those at rest, and the least of the others. True: all rest, there is a plan.
    fn extend(
        &self, node: &Node, chosen: &mut Vec<(u32, Place, Place)>, costs: (u64, u64), later: &mut HashMap<Vec<u32>, u64>,
    ) -> bool {
        let agent = chosen.len();
        if self.limit.map_or(false, |limit| costs.0 + costs.1 + node.least[agent] >= limit) { return false; }
        if agent == node.key.len() {
            let spent = later.entry(chosen.iter().map(|choice| choice.0).collect()).or_insert(costs.0);
            *spent = costs.0.min(*spent);
            return chosen.iter().all(|choice| choice.0 >= RESTS);
        }
        let now = node.key[agent];
        if now >= RESTS { return self.choose(node, chosen, (now, now - RESTS, now - RESTS), costs, later); }
        let point = self.point(agent, node.time, now);
        let to = if self.limit.is_none() { self.settled.min(node.time + 1) } else { node.time + 1 };
        let end = if self.limit.is_none() { 0 } else { u64::from(node.time) };
        if point.ends && self.choose(node, chosen, (point.place + RESTS, point.place, point.place), (costs.0 + end, costs.1), later) {
            return true;
        }
        point.next.iter().any(|&next| {
            let after = self.point(agent, to, next);
            after.least < NEVER && {
                let costs = (costs.0, costs.1 + u64::from(after.least));
                self.choose(node, chosen, (next, point.place, after.place), costs, later)
            }
        })
    }

    fn choose(
        &self, node: &Node, chosen: &mut Vec<(u32, Place, Place)>, choice: (u32, Place, Place), costs: (u64, u64),
        later: &mut HashMap<Vec<u32>, u64>,
    ) -> bool {
        let (from, to) = (choice.1, choice.2);
        let collides = chosen.iter().any(|&(_, before, after)| {
            to == after
                || (to == before && after == from)
                || (!self.following && ((to == before && after != before) || (after == from && to != from)))
        });
        if collides { return false; }
        chosen.push(choice);
        let found = self.extend(node, chosen, costs, later);
        chosen.pop();
        found
    }
}

fn add(key: &[u32], next: u32) -> Vec<u32> { key.iter().copied().chain([next]).collect() }
