// SPDX-License-Identifier: MIT
//! Orders of stops: for each set of stops done and the post of the last of them, the least remaining cost. With many stops, computes these
//! costs only for orders that cost little more than the best one.
use crate::agent::NEVER;
use crate::tokens::Map;

/// The first limit exceeds Bound::root by at least this number of time steps. The limit is then raised until it excludes no order, or
/// exceeds the cost of the best order by at least this number of time steps.
const SLACK: u32 = 2;

/// Maximum number of cached trees. A larger cache is emptied.
const MAX_TREES: usize = 4_000_000;

/// Costs between stops. A stop may be done in several poses; a post is (stop, pose).
pub struct Orders<'a> {
    pub posts: &'a [(usize, u32)],
    /// Distances from the start to posts.
    pub first: &'a [u32],
    /// Distances between posts, row by row: from post i to post j at i * posts.len() + j.
    pub legs: Vec<u32>,
    /// Distances from posts to the end.
    pub last: Vec<u32>,
    pub durations: Vec<u32>,
    /// The stop whose task the agent executes at time 0, its post, and the time at which this execution ends.
    pub working: Option<(usize, u32, u32)>,
    /// `allowed[k]`: the set of stops that may be at position k, from 0, of the order.
    pub allowed: &'a [u64],
}

/// The remaining cost for each set of stops done and the post of the last of them.
pub type After = Map<(u64, u32), u32>;

impl Orders<'_> {
    /// Returns (1) the remaining costs for all sets and posts on paths that cost up to a limit, (2) this limit, which is at least `wanted`
    /// (NEVER: all paths), and (3) the least cost of a path (NEVER: there is no path), or 0 if `wanted` is NEVER.
    pub fn after(&self, bound: &mut Option<Bound>, wanted: u32) -> (After, u32, u32) {
        if wanted == NEVER { return (self.within(NEVER, None).0, NEVER, 0); }
        let bound = bound.get_or_insert_with(|| Bound::of(self));
        if bound.trees.len() > MAX_TREES { bound.trees = Map::default(); }
        let mut limit = wanted.max(bound.root + SLACK);
        loop {
            let (after, least, dropped) = self.within(limit, Some(bound));
            if !dropped { return (after, NEVER, least); }
            if least < NEVER && limit >= least + SLACK { return (after, limit, least); }
            limit = if least < NEVER { least } else { limit } + SLACK;
        }
    }

    /// Returns the remaining costs for paths that cost up to `limit`, the least cost, and whether the limit has excluded any path.
    fn within(&self, limit: u32, mut bound: Option<&mut Bound>) -> (After, u32, bool) {
        let all = (1u64 << self.durations.len()) - 1;
        let (mut layers, mut now, mut dropped) = (Vec::new(), After::default(), false);
        let mut add = |layer: &mut After, done: u64, post: usize, cost: u32| {
            let remains = bound.as_mut().map_or(0, |bound| bound.remains(&self.durations, all & !done, self.posts[post].0));
            if cost >= NEVER || remains == NEVER { return; }
            if cost + remains > limit { dropped = true; return; }
            let best = layer.entry((done, post as u32)).or_insert(cost);
            *best = cost.min(*best);
        };
        match self.working {
            Some((stop, post, end)) if self.allowed[0] >> stop & 1 == 1 => add(&mut now, 1 << stop, post as usize, end),
            Some(_) => (),
            None => self.open(0).for_each(|(post, stop)| add(&mut now, 1 << stop, post, self.first[post] + self.durations[stop])),
        }
        while !now.is_empty() {
            let mut later = After::default();
            for (&(done, from), &cost) in &now {
                for (post, stop) in self.open(done) { add(&mut later, done | 1 << stop, post, cost + self.leg(from, post, stop)); }
            }
            layers.push(std::mem::replace(&mut now, later));
        }
        let (mut after, mut least) = (After::default(), NEVER);
        for (&(done, post), &cost) in layers.iter().rev().flatten() {
            let next = |(to, stop): (usize, usize)| after.get(&(done | 1 << stop, to as u32)).map(|rest| rest + self.leg(post, to, stop));
            let rest = if done == all { self.last[post as usize] } else { self.open(done).filter_map(next).min().unwrap_or(NEVER) };
            if rest < NEVER && cost + rest <= limit {
                after.insert((done, post), rest);
                least = least.min(cost + rest);
            } else {
                dropped |= rest < NEVER;
            }
        }
        (after, least, dropped)
    }

    /// Returns the posts that may be next after the stops `done`, each with its stop.
    fn open(&self, done: u64) -> impl Iterator<Item = (usize, usize)> + '_ {
        let open = self.allowed.get(done.count_ones() as usize).copied().unwrap_or(0) & !done;
        self.posts.iter().enumerate().map(|(post, &(stop, _))| (post, stop)).filter(move |&(_, stop)| open >> stop & 1 == 1)
    }

    pub fn leg(&self, from: u32, to: usize, stop: usize) -> u32 {
        self.legs[from as usize * self.posts.len() + to] + self.durations[stop]
    }
}

/// Lower bound of Held and Karp. A path through all remaining stops to the end consists of an edge to one of them, a spanning tree of them,
/// and an edge from one of them to the end. Each stop has a multiplier (`prices`) that is added to the cost of each of its edges.
/// Subgradient ascent changes the multipliers so that the degrees in the minimum tree approach those of a path. Any multipliers give a
/// valid bound. All values except `root` are in 64ths of a time step.
pub struct Bound {
    nodes: usize,
    /// Costs of edges, including the multipliers of both nodes. Nodes are the stops, the end and the start, in this order; the multipliers
    /// of end and start are 0.
    costs: Vec<i64>,
    prices: Vec<i64>,
    /// Cache, by set of remaining stops: value of tree() plus the durations of the stops.
    trees: Map<u64, i64>,
    /// In time steps: a lower bound on the cost of the best order if no task execution is in progress at time 0; otherwise an estimate.
    root: u32,
}

/// Cost of an edge that does not exist. Sums of costs of existing edges are less.
const UNREACHABLE: i64 = 1 << 50;

/// Converts 64ths of a time step to whole time steps, rounded up.
fn whole(value: i64) -> u32 { ((value.max(0) + 63) / 64).min(i64::from(NEVER) - 1) as u32 }

/// Returns the stops of a set of bits in ascending order.
pub fn stops(mut set: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let stop = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        Some(stop).filter(|&stop| stop < 64)
    })
}

impl Bound {
    fn of(orders: &Orders) -> Bound {
        let count = orders.durations.len();
        let (nodes, end, start, all) = (count + 2, count, count + 1, (1 << count) - 1);
        let mut plain = vec![UNREACHABLE; nodes * nodes];
        let mut put = |one: usize, two: usize, cost: u32| {
            let cost = if cost < NEVER { i64::from(cost) * 64 } else { UNREACHABLE };
            for at in [one * nodes + two, two * nodes + one] { plain[at] = cost.min(plain[at]); }
        };
        for (from, &(one, _)) in orders.posts.iter().enumerate() {
            put(one, end, orders.last[from]);
            put(one, start, orders.first[from]);
            for (to, &(two, _)) in orders.posts.iter().enumerate() { put(one, two, orders.legs[from * orders.posts.len() + to]); }
        }
        let mut bound = Bound { nodes, costs: Vec::new(), prices: vec![0; nodes], trees: Map::default(), root: 0 };
        let (mut step, mut best) = (400, (i64::MIN, Vec::new()));
        for round in 0..400 {
            bound.set_costs(&plain);
            let mut degrees = [0; 64];
            let (first, next) = bound.nearest(start, all);
            degrees[next] = 1;
            let value = first + bound.tree(all, &mut degrees);
            if value > best.0 { best = (value, bound.prices.clone()); }
            stops(all).for_each(|stop| bound.prices[stop] += step * (degrees[stop] - 2));
            if round % 10 == 9 { step = (step * 9 / 10).max(1); }
        }
        bound.prices = best.1;
        bound.set_costs(&plain);
        bound.root = if best.0 < UNREACHABLE / 2 { whole(best.0) + orders.durations.iter().sum::<u32>() } else { 0 };
        bound
    }

    fn set_costs(&mut self, plain: &[i64]) {
        let prices = self.prices.iter().flat_map(|one| self.prices.iter().map(move |two| one + two));
        self.costs = plain.iter().zip(prices).map(|(cost, prices)| cost + prices).collect();
    }

    /// Returns the cost and the stop of the cheapest edge from a node to one of the stops `open`.
    fn nearest(&self, node: usize, open: u64) -> (i64, usize) {
        let costs = &self.costs[node * self.nodes..];
        stops(open).map(|stop| (costs[stop], stop)).min().expect("a stop")
    }

    /// Returns the cost of a minimum spanning tree of the stops `open` plus the cheapest edge to the end, minus twice the multiplier of
    /// each of these stops, because each has two edges in a path. Adds the degrees of the stops to `degrees`.
    fn tree(&self, open: u64, degrees: &mut [i64; 64]) -> i64 {
        let (cost, before) = self.nearest(self.nodes - 2, open);
        let mut value = cost - 2 * stops(open).map(|stop| self.prices[stop]).sum::<i64>();
        degrees[before] += 1;
        let mut last = open.trailing_zeros() as usize;
        let (mut left, mut count) = ([(i64::MAX, 0, 0); 64], 0);
        for stop in stops(open & (open - 1)) {
            left[count] = (i64::MAX, stop, last);
            count += 1;
        }
        while count > 0 {
            let mut nearest = 0;
            for at in 0..count {
                let cost = self.costs[last * self.nodes + left[at].1];
                if cost < left[at].0 { left[at] = (cost, left[at].1, last); }
                if left[at].0 < left[nearest].0 { nearest = at; }
            }
            let (cost, stop, near) = left[nearest];
            value += cost;
            degrees[stop] += 1;
            degrees[near] += 1;
            last = stop;
            count -= 1;
            left[nearest] = left[count];
        }
        value
    }

    /// Returns a lower bound on the remaining cost if the stops `open` are left and `last` was done last. Returns NEVER if a required edge
    /// does not exist.
    fn remains(&mut self, durations: &[u32], open: u64, last: usize) -> u32 {
        let (mut value, mut edge) = (0, self.costs[last * self.nodes + self.nodes - 2]);
        if open != 0 {
            edge = self.nearest(last, open).0;
            value = self.trees.get(&open).copied().unwrap_or_else(|| {
                let work: u32 = stops(open).map(|stop| durations[stop]).sum();
                let value = self.tree(open, &mut [0; 64]) + 64 * i64::from(work);
                self.trees.insert(open, value);
                value
            });
        }
        value += edge - self.prices[last];
        if value < UNREACHABLE / 2 { whole(value) } else { NEVER }
    }
}
