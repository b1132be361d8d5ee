// SPDX-License-Identifier: MIT
//! Orders of stops of an agent that may leave out stops at a price (docs/proof.md, "choices"): for each set of stops done and the post of
//! the last of them, the least remaining price. Considers only sets that occur in an order whose price is within a limit.
use crate::agent::NEVER;
use crate::orders::{stops, After, Orders};
use crate::tokens::Map;
use std::collections::HashSet;

/// Numbers of stops that a walk remembers at a stop, in the order in which they are tried.
const MEMORIES: [usize; 3] = [7, 10, 13];
/// Of the stops that the agent must visit, all walks remember this number.
const MAX_REQUIRED: usize = 5;
/// The forward pass stores at most this number of states; beyond it, the orders are too expensive.
const MAX_STATES: usize = 20_000_000;

/// Returns the price of leaving out all stops of `set`; NEVER if the agent must visit one of them.
pub fn price_without(skip: &[u32], set: u64) -> u32 {
    stops(set).fold(0, |sum, stop| if skip[stop] < NEVER && sum < NEVER { sum + skip[stop] } else { NEVER })
}

/// A completion: a walk from a stop to the end, which may repeat stops that it has forgotten. `cost`: its cost, minus the prices of the
/// stops after the first. `memory`: stops that it certainly visits, without the first.
struct Completion {
    cost: i64,
    memory: u64,
}

/// Lower bounds on the remaining price (ng-routes: Baldacci, Mingozzi and Roberti 2011).
pub struct Completions {
    /// By stop, in ascending order of cost.
    of: Vec<Vec<Completion>>,
    /// Stops that the agent must visit and that all walks remember.
    required: u64,
    skip: Vec<u32>,
}

impl Completions {
    /// Requires one post per stop, in the order of the stops.
    pub fn of(orders: &Orders, skip: &[u32]) -> Completions {
        let mut found = Completions { of: Vec::new(), required: 0, skip: skip.to_vec() };
        (0..skip.len()).filter(|&stop| skip[stop] == NEVER).take(MAX_REQUIRED).for_each(|stop| found.required |= 1 << stop);
        for size in MEMORIES { if found.make(orders, size) { break; } }
        found
    }

    /// Makes the completions with memories of `size` stops. Returns false if a walk gains prices without end; its cost is then the least
    /// cost of any order: minus the sum of all prices.
    fn make(&mut self, orders: &Orders, size: usize) -> bool {
        let count = self.skip.len();
        let prize = |stop: usize| if self.skip[stop] < NEVER { i64::from(self.skip[stop]) } else { 0 };
        let floor = -(0..count).map(prize).sum::<i64>();
        let near: Vec<u64> = (0..count).map(|stop| self.required | nearest(orders, stop, size)).collect();
        let mut known: Vec<Map<u64, i64>> = (0..count).map(|_| Map::default()).collect();
        let mut now: Vec<(usize, u64)> = Vec::new();
        for stop in (0..count).filter(|&stop| orders.last[stop] < NEVER) {
            known[stop].insert(0, i64::from(orders.last[stop]));
            now.push((stop, 0));
        }
        let mut ends = true;
        while !now.is_empty() {
            let mut later = HashSet::new();
            for (to, memory) in now.drain(..) {
                let rest = known[to][&memory] - prize(to);
                for from in (0..count).filter(|&from| from != to && memory >> from & 1 == 0) {
                    let leg = orders.leg(from as u32, to, to);
                    if leg >= NEVER { continue; }
                    let key = (memory | 1 << to) & near[from] & !(1 << from);
                    let cost = (rest + i64::from(leg)).max(floor);
                    ends &= cost > floor;
                    let best = known[from].entry(key).or_insert(i64::MAX);
                    if cost < *best {
                        *best = cost;
                        later.insert((from, key));
                    }
                }
            }
            now = later.into_iter().collect();
        }
        let list = |map: Map<u64, i64>| {
            let mut list: Vec<Completion> = map.into_iter().map(|(memory, cost)| Completion { cost, memory }).collect();
            list.sort_unstable_by_key(|completion| completion.cost);
            list
        };
        self.of = known.into_iter().map(list).collect();
        ends
    }

    /// Returns a lower bound on the remaining price after `stop`, if the stops of `left` are not done; NEVER if there is no order.
    fn remains(&self, stop: usize, left: u64) -> u32 {
        let fits = |at: &&Completion| at.memory & !left == 0 && at.memory & self.required == left & self.required;
        let found = self.of[stop].iter().find(fits);
        let all: i64 = stops(left).filter(|&stop| self.skip[stop] < NEVER).map(|stop| i64::from(self.skip[stop])).sum();
        found.map_or(NEVER, |found| (all + found.cost).clamp(0, i64::from(NEVER)) as u32)
    }
}

/// Returns the set of the `size` stops to which, or from which, a stop is nearest.
fn nearest(orders: &Orders, stop: usize, size: usize) -> u64 {
    let far = |other: usize| orders.leg(stop as u32, other, other).min(orders.leg(other as u32, stop, stop));
    let mut others: Vec<(u32, usize)> = (0..orders.durations.len()).filter(|&other| other != stop).map(|other| (far(other), other)).collect();
    others.sort_unstable();
    others.iter().take(size).fold(0, |set, other| set | 1 << other.1)
}

/// A set of stops done, the post of the last of them, and the least cost up to it.
type State = (u64, u32, u32);

/// Returns the states after the first stop.
fn first(orders: &Orders) -> Vec<State> {
    match orders.working {
        Some((stop, post, end)) => vec![(1 << stop, post, end)],
        None => orders.posts.iter().enumerate().map(|(post, &(stop, _))| (1 << stop, post as u32, orders.first[post] + orders.durations[stop])).collect(),
    }
}

/// Returns a lower bound on the price of every path that does a stop.
pub fn least_bound(orders: &Orders, bounds: &Completions) -> u32 {
    let all = (1u64 << orders.durations.len()) - 1;
    let price = |(done, post, cost): State| cost.saturating_add(bounds.remains(orders.posts[post as usize].0, all & !done)).min(NEVER);
    first(orders).into_iter().map(price).min().unwrap_or(NEVER)
}

/// Returns the remaining prices of all sets and posts on orders that are possible within `limit`, and the least price of a path that
/// does a stop (NEVER: above the limit). Returns None if this is too expensive.
pub fn within(orders: &Orders, bounds: &Completions, limit: u32) -> Option<(After, u32)> {
    let all = (1u64 << orders.durations.len()) - 1;
    let mut now = After::default();
    let reach = |layer: &mut After, (done, post, cost): State| {
        let remains = bounds.remains(orders.posts[post as usize].0, all & !done);
        if cost >= NEVER || remains >= NEVER || cost + remains > limit { return; }
        let best = layer.entry((done, post)).or_insert(cost);
        *best = cost.min(*best);
    };
    for state in first(orders) { reach(&mut now, state); }
    let (mut layers, mut states) = (Vec::new(), 0);
    while !now.is_empty() {
        states += now.len();
        let mut later = After::default();
        for (&(done, from), &cost) in &now {
            if states + later.len() > MAX_STATES { return None; }
            for stop in stops(all & !done) { reach(&mut later, (done | 1 << stop, stop as u32, cost + orders.leg(from, stop, stop))); }
        }
        layers.push(std::mem::replace(&mut now, later));
    }
    let (mut after, mut least) = (After::default(), NEVER);
    for (&(done, post), &cost) in layers.iter().rev().flatten() {
        let ends = price_without(&bounds.skip, all & !done).saturating_add(orders.last[post as usize]);
        let next = |stop: usize| after.get(&(done | 1 << stop, stop as u32)).map(|rest| rest + orders.leg(post, stop, stop));
        let rest = stops(all & !done).filter_map(next).min().unwrap_or(NEVER).min(ends);
        if rest >= NEVER || cost + rest > limit { continue; }
        after.insert((done, post), rest);
        least = least.min(cost + rest);
    }
    Some((after, least))
}
