// SPDX-License-Identifier: MIT
//! Joint search over all agents. For each agent, layers hold its possible states at each time. The search expands joint states (one state
//! per agent) from each time to the next.
use crate::agent::NEVER;
use crate::instance::Place;
use crate::successors::{State, Successors};
use crate::tokens::{Map, Set};

/// A possible state of an agent at one time step.
struct Point {
    place: Place,
    /// Indices of the points at the next time that may follow.
    next: Vec<u32>,
    /// Whether a path may end here.
    ends: bool,
    /// The least cost of a path through this point; 0 if costs have no cap.
    least: u32,
}

/// The points of one agent at each time. If the agent's cost has no cap, the last layer represents all times from `horizon` on.
pub struct Layers(Vec<Vec<Point>>);

impl Layers {
    pub fn of(successors: &mut Successors, cap: u32, horizon: u32) -> Layers {
        assert!(successors.model.raise_limit(cap), "orders of many tasks, too far from the best one");
        let (mut layers, mut time) = (Vec::new(), 0);
        let keep = |successors: &Successors, state: &State, time: u32| {
            let remains = successors.remains(state);
            remains < NEVER && (cap == NEVER || time + remains <= cap)
        };
        let mut states: Vec<State> = successors.starts().into_iter().filter(|state| keep(successors, state, 0)).collect();
        let mut known: Map<State, u32> = states.iter().copied().zip(0..).collect();
        loop {
            let steady = cap == NEVER && time == horizon;
            let (mut points, mut later, mut found) = (Vec::new(), Vec::new(), Map::default());
            while points.len() < states.len() {
                let state = states[points.len()];
                let mut next = Vec::new();
                for step in successors.steps(state, time) {
                    if keep(successors, &step, time + 1) {
                        let (list, known) = if steady { (&mut states, &mut known) } else { (&mut later, &mut found) };
                        next.push(*known.entry(step).or_insert(list.len() as u32));
                        if list.len() < known.len() { list.push(step); }
                    }
                }
                next.sort_unstable();
                next.dedup();
                let ends = successors.may_end(&state, time);
                points.push(Point { place: successors.place(&state), next, ends, least: if cap == NEVER { 0 } else { NEVER } });
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

/// In the key of a joint state, RESTS + place represents an agent that rests on this place forever.
const RESTS: u32 = 1 << 31;

pub struct Joint {
    pub layers: Vec<Layers>,
    /// The search is for plans whose sum of costs is below this limit. None: for any plan.
    pub limit: Option<u64>,
    pub horizon: u32,
    pub following: bool,
}

/// A joint state at one time step.
struct Node<'a> {
    /// For each agent the index of its point, or RESTS + place.
    key: &'a [u32],
    time: u32,
    /// For each agent, a lower bound on the sum of costs of this agent and all later ones, without agents at rest.
    least: Vec<u64>,
}

impl Joint {
    /// Returns whether there is no plan below the limit.
    pub fn finds_none(&self) -> bool {
        let mut nodes: Map<Vec<u32>, u64> = Map::from_iter([(Vec::new(), 0)]);
        for layers in &self.layers {
            let longer = |key: &Vec<u32>| (0..layers.0[0].len() as u32).map(|next| (add(key, next), 0)).collect::<Vec<_>>();
            nodes = nodes.keys().flat_map(longer).collect();
        }
        let (mut seen, mut time) = (Set::default(), 0);
        while !nodes.is_empty() {
            let mut later = Map::default();
            for (key, &spent) in &nodes {
                let mut least = vec![0; key.len() + 1];
                for agent in (0..key.len()).rev() {
                    let costs = if key[agent] < RESTS { self.point(agent, time, key[agent]).least } else { 0 };
                    least[agent] = least[agent + 1] + u64::from(costs);
                }
                if self.extend(&Node { key, time, least }, &mut Vec::new(), (spent, 0), &mut later) { return false; }
            }
            if self.limit.is_none() && time == self.horizon {
                later.retain(|key: &Vec<u32>, _| seen.insert(key.clone()));
            } else {
                time += 1;
            }
            nodes = later;
        }
        true
    }

    fn point(&self, agent: usize, time: u32, number: u32) -> &Point { &self.layers[agent].0[time as usize][number as usize] }

    /// Extends `chosen`, which contains (point, place before, place after) for the first agents, by each option of the next agent. Adds
    /// complete joint states to `later`. `costs`: costs of the chosen agents that have come to rest, and a lower bound on the costs of the
    /// other chosen agents. Returns true if it has found a plan, that is, all agents rest.
    fn extend(
        &self, node: &Node, chosen: &mut Vec<(u32, Place, Place)>, costs: (u64, u64), later: &mut Map<Vec<u32>, u64>,
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
        let to = if self.limit.is_none() { self.horizon.min(node.time + 1) } else { node.time + 1 };
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
        later: &mut Map<Vec<u32>, u64>,
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
