// SPDX-License-Identifier: MIT
//! All paths of one agent up to a cost, as a graph in layers of time (docs/proof.md, "formula").
use crate::agent::{AgentModel, NEVER};
use crate::tokens::Map;

/// What an agent does at one time. `done`: index of its set of stops done, from AgentModel::number(). `work`: 0, or 1 plus the stop whose
/// task it executes or, if `steps` is the duration of the task, has executed and only waited since. `since`: the time of its last arrival,
/// NEVER if it will leave its place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Spot {
    pub pose: u32,
    pub done: u32,
    pub work: u32,
    pub steps: u32,
    pub since: u32,
    /// Of an agent with prices: the path ends here.
    pub ends: bool,
}

pub struct Node {
    pub spot: Spot,
    pub time: u32,
    /// The least cost of a path through this node; NEVER if it exceeds the cap.
    pub least: u32,
    /// Whether the path ends here.
    pub ends: bool,
    /// Whether every path through this node continues with one of `next`, whatever it costs.
    pub complete: bool,
    /// Range of the successors in Paths::next.
    next: (u32, u32),
}

pub struct Paths {
    /// In ascending order of time.
    pub nodes: Vec<Node>,
    next: Vec<u32>,
    pub starts: Vec<u32>,
    index: Map<(u32, Spot), u32>,
    is_priced: bool,
}

impl Paths {
    /// Returns the graph of all paths that cost at most `cap`. None: the costs to go are too expensive to compute.
    pub fn of(model: &mut AgentModel, cap: u32) -> Option<Paths> {
        if !model.raise_limit(cap) { return None; }
        let mut paths = Paths { nodes: Vec::new(), next: Vec::new(), starts: Vec::new(), index: Map::default(), is_priced: model.is_priced() };
        let spots = starts(model);
        for spot in with_ends(model, spots) { if let Some(start) = paths.reach(model, spot, 0, cap) { paths.starts.push(start); } }
        let (mut at, mut found) = (0, Vec::new());
        while at < paths.nodes.len() {
            let (spot, time) = (paths.nodes[at].spot, paths.nodes[at].time);
            let (first, mut complete) = (paths.next.len() as u32, true);
            if !spot.ends { steps(model, spot, time, &mut found); }
            for step in with_ends(model, std::mem::take(&mut found)) {
                match paths.reach(model, step, time + 1, cap) {
                    Some(next) => paths.next.push(next),
                    None => complete &= is_dead(model, &step),
                }
            }
            paths.nodes[at].next = (first, paths.next.len() as u32);
            paths.nodes[at].complete = complete;
            at += 1;
        }
        paths.least_costs(cap);
        Some(paths)
    }

    pub fn next(&self, node: &Node) -> &[u32] { &self.next[node.next.0 as usize..node.next.1 as usize] }

    /// Returns what a plain agent does in a pose: without stops.
    pub fn plain(&self, pose: u32, since: u32) -> Option<Spot> {
        self.nodes.first().map(|node| Spot { pose, since, ends: self.is_priced && since < NEVER, ..node.spot })
    }

    /// Returns the index of a node.
    pub fn find(&self, time: u32, spot: Spot) -> Option<u32> { self.index.get(&(time, spot)).copied() }

    /// Adds a node unless all paths through it cost more than `cap`.
    fn reach(&mut self, model: &mut AgentModel, spot: Spot, time: u32, cap: u32) -> Option<u32> {
        if let Some(&known) = self.index.get(&(time, spot)) { return Some(known); }
        let remains = remains(model, &spot);
        if remains >= NEVER || time + remains > cap || (spot.since < NEVER && is_dead(model, &spot)) { return None; }
        let number = self.nodes.len() as u32;
        let ends = if self.is_priced { spot.ends } else { spot.since < NEVER && remains == 0 && model.done(spot.done) == model.all() };
        let least = if ends { time + remains } else { NEVER };
        self.nodes.push(Node { spot, time, least, ends, complete: false, next: (0, 0) });
        self.index.insert((time, spot), number);
        Some(number)
    }

    fn least_costs(&mut self, cap: u32) {
        for at in (0..self.nodes.len()).rev() {
            let node = &self.nodes[at];
            let next = self.next(node).iter().map(|&next| self.nodes[next as usize].least);
            let least = if node.ends { node.least } else { next.clone().min().unwrap_or(NEVER) };
            let complete = node.complete && next.clone().all(|least| least <= cap);
            self.nodes[at].complete = complete;
            self.nodes[at].least = if least <= cap { least } else { NEVER };
        }
    }
}

fn duration(model: &AgentModel, spot: &Spot) -> u32 { if spot.work == 0 { 0 } else { model.stops[spot.work as usize - 1].duration } }

fn is_executing(model: &AgentModel, spot: &Spot) -> bool { spot.steps < duration(model, spot) }

/// Of an agent with prices, a path that has arrived on its last place may end there, or continue with a task execution.
fn with_ends(model: &AgentModel, spots: Vec<Spot>) -> Vec<Spot> {
    let ending: Vec<Spot> = spots.iter().filter(|spot| model.is_priced() && spot.since < NEVER).map(|&spot| Spot { ends: true, ..spot }).collect();
    spots.into_iter().chain(ending).collect()
}

/// Returns a lower bound on the remaining cost; for a spot where a path with prices ends, its price.
fn remains(model: &mut AgentModel, spot: &Spot) -> u32 {
    if spot.ends { return model.skipped(model.done(spot.done)).saturating_add(model.price_of_rest(model.poses.place(spot.pose))).min(NEVER); }
    if !is_executing(model, spot) { return model.remains(spot.done, spot.pose); }
    let done = model.number(model.done(spot.done) | 1 << (spot.work - 1));
    duration(model, spot) - spot.steps + model.remains(done, spot.pose)
}

/// Returns whether no path, whatever it costs, passes through this spot: the agent has arrived on its last place, but may not rest there, or
/// must still go elsewhere.
fn is_dead(model: &AgentModel, spot: &Spot) -> bool {
    let place = model.poses.place(spot.pose);
    if spot.since == NEVER { return false; }
    if model.is_priced() { return is_dead_with_prices(model, spot); }
    model.all() & !model.done(spot.done) & !model.stops_at(place) != 0 || !model.may_rest_on(place)
}

/// As is_dead(), for an agent with prices that has made its last arrival.
fn is_dead_with_prices(model: &AgentModel, spot: &Spot) -> bool {
    let (place, done) = (model.poses.place(spot.pose), model.done(spot.done));
    let here = model.stops_at(place) & !done;
    if model.price_of_rest(place) == NEVER || model.skipped(done | here) == NEVER { return true; }
    if spot.ends { is_executing(model, spot) || model.skipped(done) == NEVER } else { here & !model.has_no_duration(here) == 0 }
}

/// Returns the sets of stops that may be done after an arrival on a place. The agent counts a stop without duration on arrival, or
/// not at all; it counts it surely if the stop has no price.
fn counted(model: &AgentModel, done: u64, place: u32) -> Vec<u64> {
    let here = model.has_no_duration(model.stops_at(place) & !done);
    if model.passable(here) == 0 { vec![done | here] } else { vec![done, done | here] }
}

fn starts(model: &mut AgentModel) -> Vec<Spot> {
    let (pose, place) = (model.start, model.poses.place(model.start));
    let (work, steps) = model.working.map_or((0, 0), |(stop, end)| (stop + 1, model.stops[stop as usize].duration - end));
    let done: Vec<u32> = counted(model, 0, place).into_iter().map(|done| model.number(done)).collect();
    [NEVER, 0].iter().flat_map(|&since| done.iter().map(move |&done| Spot { pose, done, work, steps, since, ends: false })).collect()
}

/// Appends to `found` what the agent may do one step later.
fn steps(model: &mut AgentModel, spot: Spot, time: u32, found: &mut Vec<Spot>) {
    let (poses, done) = (model.poses.clone(), model.done(spot.done));
    let place = poses.place(spot.pose);
    let mut execute = |model: &mut AgentModel, stop: u32, steps: u32| {
        let ended = steps == model.stops[stop as usize].duration;
        let done = if ended { model.number(done | 1 << stop) } else { spot.done };
        found.push(Spot { work: stop + 1, steps, done, ..spot });
    };
    if is_executing(model, &spot) { return execute(model, spot.work - 1, spot.steps + 1); }
    if model.may_execute_in(spot.pose) {
        let open = model.stops_at(place) & !done;
        let open = open & !model.has_no_duration(open);
        (0..64).filter(|stop| open >> stop & 1 == 1).for_each(|stop| execute(model, stop, 1));
    }
    if spot.since == NEVER { found.push(spot); }
    for &pose in poses.next(spot.pose) {
        let to = poses.place(pose);
        let after = Spot { pose, work: 0, steps: 0, ..spot };
        if to == place {
            found.push(after);
        } else if spot.since == NEVER {
            for done in counted(model, done, to) {
                let done = model.number(done);
                found.push(Spot { done, ..after });
                found.push(Spot { done, since: time + 1, ..after });
            }
        }
    }
}
