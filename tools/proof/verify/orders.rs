// SPDX-License-Identifier: MIT
//! Orders of stops: what remains at least when some are done. Of many stops only for what is not far from the best order.
use crate::agent::NEVER;
use crate::tokens::Map;

/// How much more than the best order, at first.
const SLACK: u32 = 2;

/// With more of them known it begins anew.
const MAX_TREES: usize = 4_000_000;

/// Stops may be done in several poses each: these are posts, (stop, pose).
pub struct Orders<'a> {
    pub posts: &'a [(usize, u32)],
    /// What the way takes from the start, from post to post, and from posts to the end.
    pub first: &'a [u32],
    pub legs: Vec<u32>,
    pub last: Vec<u32>,
    pub durations: Vec<u32>,
    /// The stop, post and time at which it begins, at work.
    pub working: Option<(usize, u32, u32)>,
    pub allowed: &'a [u64],
}

/// Of sets of stops done, with the post of the last.
pub type After = Map<(u64, u32), u32>;

impl Orders<'_> {
    /// What remains then at least, of all that a path up to a limit may come to; that limit (NEVER: of all paths), and the least cost.
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

    /// Also the least cost, and whether the limit left anything out.
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

    /// Posts, with their stops, at which one may go on.
    fn open(&self, done: u64) -> impl Iterator<Item = (usize, usize)> + '_ {
        let open = self.allowed.get(done.count_ones() as usize).copied().unwrap_or(0) & !done;
        self.posts.iter().enumerate().map(|(post, &(stop, _))| (post, stop)).filter(move |&(_, stop)| open >> stop & 1 == 1)
    }

    fn leg(&self, from: u32, to: usize, stop: usize) -> u32 {
        self.legs[from as usize * self.posts.len() + to] + self.durations[stop]
    }
}

/// Held and Karp's bound: who goes on through all remaining stops to the end comes to one of them, spans them by a tree, and leaves one
/// for the end; where these have other degrees than a path, stops have a price for each edge that meets them. Any prices give a bound;
/// these are good ones. In 64ths of a step.
pub struct Bound {
    nodes: usize,
    /// Of edges, with the prices of their ends. Nodes are the stops, the end, and the start; these two have none.
    costs: Vec<i64>,
    prices: Vec<i64>,
    /// Of sets of stops: their tree with the end.
    trees: Map<u64, i64>,
    root: u32,
}

/// There is no way; sums of what there is stay below.
const UNREACHABLE: i64 = 1 << 50;

/// Whole steps, of 64ths.
fn whole(value: i64) -> u32 { ((value.max(0) + 63) / 64).min(i64::from(NEVER) - 1) as u32 }

/// The stops of a set.
fn stops(mut set: u64) -> impl Iterator<Item = usize> {
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

    /// The cheapest edge from a node to one of these stops.
    fn nearest(&self, node: usize, open: u64) -> (i64, usize) {
        let costs = &self.costs[node * self.nodes..];
        stops(open).map(|stop| (costs[stop], stop)).min().expect("a stop")
    }

    /// A least spanning tree of these stops, with the edge to the end, without what a path pays as prices.
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

    /// What remains at least when these stops are open, and one was done last; NEVER: there is no way.
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
