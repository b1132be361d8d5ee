// SPDX-License-Identifier: MIT
//! Orders of stops: what remains at least when some are done. Of many stops only for what is not far from the best order.
use crate::body::NEVER;
use std::collections::HashMap;

/// Up to so many stops all sets of them are looked at; of more, only what costs not much more than the best order.
const FEW: usize = 11;

/// Stops may be done in several poses each: these are posts, (stop, pose).
pub struct Orders<'a> {
    pub posts: &'a [(usize, u32)],
    /// What the way takes from the start, from post to post, and from posts to the end.
    pub first: &'a [u32],
    pub legs: &'a [u32],
    pub last: Vec<u32>,
    pub durations: Vec<u32>,
    /// The stop, post and time at which it begins, at work.
    pub working: Option<(usize, u32, u32)>,
    pub allowed: &'a [u64],
    /// How much more than the best order.
    pub slack: u32,
}

/// Of sets of stops done, with the post of the last.
pub type After = HashMap<(u64, u32), u32>;

impl Orders<'_> {
    /// What remains then at least, of all that a path of this cost may come to; NEVER: of all paths.
    pub fn after(&self) -> (After, u32) {
        let bound = if self.durations.len() > FEW { Some(Bound::of(self)) } else { None };
        let mut limit = bound.as_ref().map_or(NEVER, |bound| bound.root + self.slack);
        loop {
            let (after, least, dropped) = self.within(limit, &bound);
            if !dropped { return (after, NEVER); }
            if least < NEVER && limit >= least + self.slack { return (after, limit); }
            limit = if least < NEVER { least } else { limit } + self.slack;
        }
    }

    /// Also the least cost, and whether the limit left anything out.
    fn within(&self, limit: u32, bound: &Option<Bound>) -> (After, u32, bool) {
        let all = (1u64 << self.durations.len()) - 1;
        let (mut layers, mut now, mut dropped) = (Vec::new(), After::new(), false);
        let mut add = |layer: &mut After, known: &mut HashMap<(u64, usize), u32>, done: u64, post: usize, cost: u32| {
            let stop = self.posts[post].0;
            let mut remains = || bound.as_ref().map_or(0, |bound| *known.entry((done, stop)).or_insert_with(|| bound.remains(self, done, stop)));
            if cost >= NEVER { return; }
            if limit < NEVER && cost + remains() > limit { dropped = true; return; }
            let best = layer.entry((done, post as u32)).or_insert(cost);
            *best = cost.min(*best);
        };
        let mut known = HashMap::new();
        match self.working {
            Some((stop, post, end)) if self.allowed[0] >> stop & 1 == 1 => add(&mut now, &mut known, 1 << stop, post as usize, end),
            Some(_) => (),
            None => {
                for (post, stop) in self.open(0) { add(&mut now, &mut known, 1 << stop, post, self.first[post] + self.durations[stop]); }
            }
        }
        while !now.is_empty() {
            let (mut later, mut known) = (After::new(), HashMap::new());
            for (&(done, from), &cost) in &now {
                for (post, stop) in self.open(done) { add(&mut later, &mut known, done | 1 << stop, post, cost + self.leg(from, post, stop)); }
            }
            layers.push(std::mem::replace(&mut now, later));
        }
        let (mut after, mut least) = (After::new(), NEVER);
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
        self.posts.iter().enumerate().map(|(post, &(stop, _))| (post, stop)).filter(move |(_, stop)| open >> stop & 1 == 1)
    }

    fn leg(&self, from: u32, to: usize, stop: usize) -> u32 {
        self.legs[from as usize * self.posts.len() + to] + self.durations[stop]
    }
}

/// Held and Karp's bound: who goes on through all remaining stops to the end spans them by a tree; where this has other degrees than
/// a path, stops have a price for each edge that meets them. Any prices give a bound; these are good ones. In 64ths.
struct Bound {
    nodes: usize,
    costs: Vec<i64>,
    prices: Vec<i64>,
    root: u32,
}

impl Bound {
    /// Nodes are the stops, the end, and the start.
    fn of(orders: &Orders) -> Bound {
        let stops = orders.durations.len();
        let (nodes, end, start) = (stops + 2, stops, stops + 1);
        let mut costs = vec![i64::from(NEVER) * 64; nodes * nodes];
        let mut put = |one: usize, two: usize, cost: u32| {
            for at in [one * nodes + two, two * nodes + one] { costs[at] = costs[at].min(i64::from(cost) * 64); }
        };
        for (from, &(one, _)) in orders.posts.iter().enumerate() {
            put(one, end, orders.last[from]);
            put(one, start, orders.first[from]);
            for (to, &(two, _)) in orders.posts.iter().enumerate() { put(one, two, orders.legs[from * orders.posts.len() + to]); }
        }
        let mut bound = Bound { nodes, costs, prices: vec![0; nodes], root: 0 };
        let (all, mut step, mut best) = ((0..nodes).collect::<Vec<_>>(), 400, (i64::MIN, bound.prices.clone()));
        for round in 0..400 {
            let (value, degrees) = bound.tree(&all, start, end);
            if value > best.0 { best = (value, bound.prices.clone()); }
            for node in 0..nodes {
                bound.prices[node] += step * (degrees[node] - if node >= stops { 1 } else { 2 });
            }
            if round % 10 == 9 { step = (step * 9 / 10).max(1); }
        }
        bound.prices = best.1;
        let work: u32 = orders.durations.iter().sum();
        bound.root = u32::try_from((best.0 + 63) / 64).unwrap_or(0) + work;
        bound
    }

    /// Of a least spanning tree, as much as a path from one node to the other costs at least; and its degrees.
    fn tree(&self, nodes: &[usize], from: usize, to: usize) -> (i64, Vec<i64>) {
        let mut value = self.prices[from] + self.prices[to] - 2 * nodes.iter().map(|&node| self.prices[node]).sum::<i64>();
        let mut degrees = vec![0; self.nodes];
        let mut open: Vec<(i64, usize, usize)> = nodes.iter().map(|&node| (i64::MAX, node, from)).filter(|node| node.1 != from).collect();
        let mut last = from;
        while !open.is_empty() {
            let mut nearest = 0;
            for at in 0..open.len() {
                let cost = self.costs[last * self.nodes + open[at].1] + self.prices[last] + self.prices[open[at].1];
                if cost < open[at].0 { open[at] = (cost, open[at].1, last); }
                if open[at].0 < open[nearest].0 { nearest = at; }
            }
            let (cost, node, near) = open.swap_remove(nearest);
            value += cost;
            degrees[node] += 1;
            degrees[near] += 1;
            last = node;
        }
        (value, degrees)
    }

    /// What remains at least when these stops are done, this one last.
    fn remains(&self, orders: &Orders, done: u64, stop: usize) -> u32 {
        let open = (0..orders.durations.len()).filter(|stop| done >> stop & 1 == 0);
        let work: u32 = open.clone().map(|stop| orders.durations[stop]).sum();
        let nodes: Vec<usize> = open.chain([self.nodes - 2, stop]).collect();
        u32::try_from((self.tree(&nodes, stop, self.nodes - 2).0 + 63) / 64).unwrap_or(0) + work
    }
}
