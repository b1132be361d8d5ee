// SPDX-License-Identifier: MIT
//! Model of one agent for the searches: its poses, its stops, and its least remaining costs. These costs respect constraints on the order
//! of stops and ignore all other constraints.
use crate::instance::{Agent, Instance, Place, World};
use crate::orders::{After, Bound, Orders};
use crate::priced::{self, Completions};
use crate::tokens::Map;
use std::rc::Rc;

/// The time `inf`. It is later than every time that a certificate can name.
pub const NEVER: u32 = 1 << 30;

/// A list of numbers for each index from 0 to `count` - 1, in compressed rows.
struct Lists {
    first: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    fn of(count: usize, pairs: &[(u32, u32)]) -> Lists {
        let mut first = vec![0u32; count + 1];
        pairs.iter().for_each(|pair| first[pair.0 as usize + 1] += 1);
        (0..count).for_each(|i| first[i + 1] += first[i]);
        let (mut free, mut items) = (first.clone(), vec![0; pairs.len()]);
        for &(from, to) in pairs {
            items[free[from as usize] as usize] = to;
            free[from as usize] += 1;
        }
        Lists { first, items }
    }

    fn at(&self, i: u32) -> &[u32] { &self.items[self.first[i as usize] as usize..self.first[i as usize + 1] as usize] }
}

/// The poses of all agents with the same `turn` (duration of a quarter turn in time steps; 0: the agents do not turn), and the steps
/// between poses.
pub struct Poses {
    turn: u32,
    each: u32,
    place: Vec<Place>,
    next: Lists,
    back: Lists,
}

impl Poses {
    pub fn of(world: &World, turn: u32) -> Poses {
        let each = if turn == 0 { 1 } else { 4 + 8 * (turn - 1) };
        let places = world.links.len() as u32;
        let count = places.checked_mul(each).expect("fewer poses");
        let place = (0..count).map(|pose| pose / each).collect();
        let mut poses = Poses { turn, each, place, next: Lists::of(0, &[]), back: Lists::of(0, &[]) };
        let mut steps = Vec::new();
        for place in (0..places).filter(|&place| world.passable[place as usize]) {
            if turn == 0 {
                steps.extend(world.links[place as usize].iter().map(|&next| (place, next)));
                continue;
            }
            for from in 0..4 {
                steps.extend(world.ahead(place, from).map(|next| (place * each + from, next * each + from)));
                for to in [(from + 1) % 4, (from + 3) % 4] {
                    steps.extend((0..turn).map(|k| (poses.pose(place, (from, to, k)), poses.pose(place, (from, to, k + 1)))));
                }
            }
        }
        poses.next = Lists::of(count as usize, &steps);
        steps.iter_mut().for_each(|step| *step = (step.1, step.0));
        poses.back = Lists::of(count as usize, &steps);
        poses
    }

    fn pose(&self, place: Place, (from, to, k): (u32, u32, u32)) -> u32 {
        let within = match k {
            _ if self.turn == 0 => 0,
            0 => from,
            _ if k == self.turn => to,
            _ => 4 + (from * 2 + u32::from(to == (from + 1) % 4)) * (self.turn - 1) + k - 1,
        };
        place * self.each + within
    }

    pub fn place(&self, pose: u32) -> Place { self.place[pose as usize] }

    pub fn next(&self, pose: u32) -> &[u32] { self.next.at(pose) }

    fn on(&self, place: Place) -> std::ops::Range<u32> { place * self.each..(place + 1) * self.each }

    fn is_within_turn(&self, pose: u32) -> bool { self.turn > 0 && pose % self.each >= 4 }

    /// Returns the pose with this number on a place, in the numbering of docs/proof.md. None: there is no such pose.
    pub fn numbered(&self, place: Place, number: u32) -> Option<u32> {
        if number >= self.each { return None; }
        if number < 4 { return Some(place * self.each + number); }
        let (turn, k) = ((number - 4) / (self.turn - 1), (number - 4) % (self.turn - 1) + 1);
        let from = turn % 4;
        Some(self.pose(place, (from, (from + if turn < 4 { 1 } else { 3 }) % 4, k)))
    }

    /// Returns, for each pose, the minimum over all sources of the cost of going to the source plus the cost of the source; NEVER if no
    /// source is reachable. A source is (cost, pose).
    fn spread(&self, mut sources: Vec<(u32, u32)>) -> Vec<u32> {
        sources.sort_unstable_by(|one, two| two.cmp(one));
        let mut found = vec![NEVER; self.place.len()];
        let (mut now, mut wave, mut cost) = (Vec::new(), Vec::new(), 0);
        while !wave.is_empty() || sources.last().map_or(false, |source| source.0 < NEVER) {
            if wave.is_empty() { cost = sources[sources.len() - 1].0; }
            while sources.last().map_or(false, |source| source.0 == cost) { wave.extend(sources.pop().map(|source| source.1)); }
            std::mem::swap(&mut now, &mut wave);
            for pose in now.drain(..) {
                if found[pose as usize] == NEVER {
                    found[pose as usize] = cost;
                    wave.extend(self.back.at(pose).iter().filter(|&&before| found[before as usize] == NEVER));
                }
            }
            cost += 1;
        }
        found
    }
}

pub struct Stop {
    pub task: u32,
    pub place: Place,
    pub duration: u32,
}

/// A set of stops done. `rest` contains (remaining cost from the arrival at the post, post) for each post that may be next, in ascending
/// order of cost.
struct Done {
    stops: u64,
    rest: Vec<(u32, u32)>,
}

/// A restriction of the order of stops, with the remaining costs of paths that cost at most `limit`. `allowed[k]` is the set of stops that
/// may be at position k of the order.
struct Choice {
    allowed: Vec<u64>,
    after: After,
    limit: u32,
    least: u32,
    numbers: Map<u64, u32>,
    done: Vec<Done>,
}

/// Where an agent with a choice may rest, and at which price.
pub enum Rest {
    /// On these places, at these prices.
    On(Vec<(Place, u32)>),
    Anywhere,
}

/// Prices of an agent with a choice (docs/proof.md, "choices"). All costs of paths are then prices.
pub struct AgentPrices {
    /// By stop: for leaving it out. NEVER: it must do the stop.
    pub skip: Vec<u32>,
    pub rest: Rest,
}

impl AgentPrices {
    fn of_rest(&self, place: Place) -> u32 {
        match &self.rest {
            Rest::Anywhere => 0,
            Rest::On(places) => places.iter().find(|known| known.0 == place).map_or(NEVER, |known| known.1),
        }
    }
}

/// With at most this number of stops, the first computation of remaining costs covers all paths.
const MAX_STOPS_AT_ONCE: usize = 5;
/// With at most this number of stops, the computation covers all paths if the first limit does not suffice.
const MAX_STOPS_COMPLETE: usize = 11;
/// With more stops, the limit is raised only for costs less than this number of steps above the cost of the best order.
const MAX_EXCESS: u32 = 200;

pub struct AgentModel {
    pub poses: Rc<Poses>,
    pub start: u32,
    /// The stop whose task the agent executes at time 0, and the time at which this execution ends.
    pub working: Option<(u32, u32)>,
    pub stops: Vec<Stop>,
    /// For each place, the set of stops there as bits. Empty if the agent has no tasks.
    stops_at: Vec<u64>,
    /// True if the agent has no goal and no stop takes time. If it has stops, it must then rest on the place of its last stop.
    pub rests_on_last: bool,
    /// The goal, if the agent need not turn there or execute a task there.
    pub plain_goal: Option<Place>,
    /// For each pose, the least cost of going to a pose in which the agent may end.
    ends: Vec<u32>,
    /// Posts. A post is a stop and a pose in which it may be done.
    posts: Vec<(usize, u32)>,
    /// Distance from each pose to each post, one row per pose.
    distances: Vec<u32>,
    bound: Option<Bound>,
    /// Restrictions with known remaining costs; `now` is the index of the current one.
    choices: Vec<Choice>,
    now: usize,
    /// For an agent with a choice: its prices, and lower bounds on remaining prices.
    priced: Option<(AgentPrices, Completions)>,
}

impl AgentModel {
    pub fn of(instance: &Instance, agent: &Agent, poses: Rc<Poses>) -> AgentModel {
        let mut tasks: Vec<u32> = agent.tasks.iter().chain(&agent.options).copied().collect();
        tasks.sort_unstable();
        let timed = |place| tasks.iter().any(|&t| instance.tasks[t as usize].place == place && instance.tasks[t as usize].duration > 0);
        let mut stops: Vec<Stop> = Vec::new();
        let mut stops_at = vec![0u64; if tasks.is_empty() { 0 } else { instance.world.links.len() }];
        for &task in &tasks {
            let (place, duration) = (instance.tasks[task as usize].place, instance.tasks[task as usize].duration);
            if duration > 0 || (!timed(place) && stops_at[place as usize] == 0) {
                assert!(stops.len() < 63, "an agent with more than 63 stops");
                stops_at[place as usize] |= 1 << stops.len();
                stops.push(Stop { task, place, duration });
            }
        }
        let number_of = |task| stops.iter().position(|stop| stop.task == task).expect("a stop") as u32;
        let working = agent.working.map(|(task, done)| (number_of(task), instance.tasks[task as usize].duration - done));
        let ends: Vec<(u32, u32)> = match (agent.goal, agent.goal_heading) {
            (Some(goal), Some(heading)) => vec![(0, poses.pose(goal, (heading, heading, 0)))],
            (Some(goal), None) => poses.on(goal).map(|pose| (0, pose)).collect(),
            (None, _) if stops.is_empty() => (0..poses.place.len() as u32).map(|pose| (0, pose)).collect(),
            (None, _) => stops.iter().flat_map(|stop| poses.on(stop.place)).map(|pose| (0, pose)).collect(),
        };
        let plain = |goal: &Place| agent.goal_heading.is_none() && !timed(*goal);
        let mut model = AgentModel {
            start: poses.pose(agent.start, agent.looks),
            working,
            rests_on_last: agent.goal.is_none() && stops.iter().all(|stop| stop.duration == 0),
            plain_goal: agent.goal.filter(plain),
            ends: poses.spread(ends),
            posts: Vec::new(),
            distances: Vec::new(),
            bound: None,
            choices: Vec::new(),
            now: 0,
            priced: None,
            poses,
            stops,
            stops_at,
        };
        let on = |(stop, at): (usize, &Stop)| model.poses.on(at.place).map(move |pose| (stop, pose));
        model.posts = model.stops.iter().enumerate().flat_map(on).collect();
        let to: Vec<Vec<u32>> = model.posts.iter().map(|&(_, pose)| model.poses.spread(vec![(0, pose)])).collect();
        model.distances = (0..model.poses.place.len()).flat_map(|pose| to.iter().map(move |row| row[pose])).collect();
        model
    }

    fn distances(&self, pose: u32) -> &[u32] { &self.distances[pose as usize * self.posts.len()..][..self.posts.len()] }

    /// Sets the prices of an agent with a choice that turns freely. Returns its least price; NEVER: it has no path. None: the orders of its
    /// stops are too expensive. From now on all costs are prices, without constraints on the order of stops.
    pub fn set_prices(&mut self, prices: AgentPrices) -> Option<u32> {
        assert!(self.poses.turn == 0, "agents with choices turn freely");
        self.ends = match &prices.rest {
            Rest::Anywhere => vec![0; self.poses.place.len()],
            Rest::On(places) => self.poses.spread(places.iter().flat_map(|&(place, price)| self.poses.on(place).map(move |pose| (price, pose))).collect()),
        };
        let free = if self.working.is_none() { priced::price_without(&prices.skip, self.all()) } else { NEVER };
        let free = free.saturating_add(self.ends[self.start as usize]).min(NEVER);
        let bounds = Completions::of(&self.orders(&[]), &prices.skip);
        self.priced = Some((prices, bounds));
        let (mut limit, mut step) = (free.min(self.least_bound()), 1);
        let longest = self.longest();
        while limit <= longest {
            let (after, found) = self.orders_within(limit)?;
            let least = free.min(found);
            if least <= limit {
                self.set_orders(after, limit, least);
                return Some(least);
            }
            if limit == longest { break; }
            limit = limit.saturating_add(step).min(longest);
            step *= 2;
        }
        Some(NEVER)
    }

    fn set_orders(&mut self, after: After, limit: u32, least: u32) {
        self.choices = vec![Choice { allowed: Vec::new(), after, limit, least, numbers: Map::default(), done: Vec::new() }];
        self.now = 0;
    }

    /// Returns a lower bound on the price of every path that does a stop.
    fn least_bound(&self) -> u32 {
        priced::least_bound(&self.orders(&[]), &self.priced.as_ref().expect("prices").1)
    }

    /// Returns an upper bound on the least price, if the agent has a path.
    fn longest(&self) -> u32 {
        let far = self.distances.iter().chain(&self.ends).copied().filter(|&steps| steps < NEVER).max().unwrap_or(0);
        let prices = &self.priced.as_ref().expect("prices").0;
        let skip: u32 = prices.skip.iter().filter(|&&price| price < NEVER).sum();
        let work: u32 = self.stops.iter().map(|stop| stop.duration).sum();
        (self.stops.len() as u32 + 1).saturating_mul(far).saturating_add(skip + work).min(NEVER - 1)
    }

    fn orders_within(&self, limit: u32) -> Option<(After, u32)> {
        let bounds = &self.priced.as_ref().expect("prices").1;
        priced::within(&self.orders(&[]), bounds, limit)
    }

    pub fn is_priced(&self) -> bool { self.priced.is_some() }

    /// Returns the price of leaving out all stops except `done`; NEVER if the agent must do one of them.
    pub fn skipped(&self, done: u64) -> u32 {
        let left = self.all() & !done;
        match &self.priced {
            Some((prices, _)) => priced::price_without(&prices.skip, left),
            None if left == 0 => 0,
            None => NEVER,
        }
    }

    /// Returns the price of resting on a place. NEVER: the agent may not rest there. Requires prices.
    pub fn price_of_rest(&self, place: Place) -> u32 { self.priced.as_ref().expect("prices").0.of_rest(place) }

    /// Returns the stops that the agent need not count when it passes them: those with a price above 0.
    pub fn passable(&self, stops: u64) -> u64 {
        let may_pass = |j: usize| self.priced.as_ref().map_or(false, |(prices, _)| (1..NEVER).contains(&prices.skip[j]));
        (0..self.stops.len()).filter(|&j| stops >> j & 1 == 1 && may_pass(j)).fold(0, |all, j| all | 1 << j)
    }

    fn orders<'a>(&'a self, allowed: &'a [u64]) -> Orders<'a> {
        Orders {
            first: self.distances(self.start),
            legs: self.posts.iter().flat_map(|&(_, pose)| self.distances(pose)).copied().collect(),
            last: self.posts.iter().map(|&(_, pose)| self.ends[pose as usize]).collect(),
            durations: self.stops.iter().map(|stop| stop.duration).collect(),
            working: self.working.map(|(stop, end)| (stop as usize, stop * self.poses.each + self.start % self.poses.each, end)),
            posts: &self.posts,
            allowed,
        }
    }

    pub fn all(&self) -> u64 { (1 << self.stops.len()) - 1 }

    pub fn stops_at(&self, place: Place) -> u64 { self.stops_at.get(place as usize).copied().unwrap_or(0) }

    /// Returns whether the agent may rest on a place when all its stops are done.
    pub fn may_rest_on(&self, place: Place) -> bool { self.poses.on(place).any(|pose| self.ends[pose as usize] == 0) }

    /// Returns whether the paths of a formula contain task executions in this pose: in no turn except that of the start.
    pub fn may_execute_in(&self, pose: u32) -> bool { !self.poses.is_within_turn(pose) || pose == self.start }

    /// Returns whether a place and a time determine what the agent does there, except for its last arrival.
    pub fn is_plain(&self) -> bool { self.stops.is_empty() && self.poses.turn == 0 }

    pub fn has_no_duration(&self, stops: u64) -> u64 {
        (0..self.stops.len()).filter(|&j| stops >> j & 1 == 1 && self.stops[j].duration == 0).fold(0, |all, j| all | 1 << j)
    }

    /// Sets the current restriction of the order of stops. `allowed[k]` is the set of stops that may be at position k of the order.
    pub fn choose(&mut self, allowed: &[u64]) {
        match self.choices.iter().position(|choice| choice.allowed == allowed) {
            Some(known) => self.now = known,
            None => self.add_choice(allowed.to_vec(), if self.stops.len() <= MAX_STOPS_AT_ONCE { NEVER } else { 0 }),
        }
    }

    /// Computes the remaining costs under a restriction, at least for all paths that cost up to `wanted`. Makes the restriction the
    /// current one.
    fn add_choice(&mut self, allowed: Vec<u64>, wanted: u32) {
        let size = |choice: &Choice| 10_000 + choice.after.len() + 5 * choice.done.len();
        if self.choices.iter().map(size).sum::<usize>() > 4_000_000 { self.choices.clear(); }
        let mut bound = self.bound.take();
        let (after, limit, least) = self.orders(&allowed).after(&mut bound, wanted);
        self.bound = bound;
        self.now = self.choices.len();
        self.choices.push(Choice { allowed, after, limit, least, numbers: Map::default(), done: Vec::new() });
    }

    /// Returns the limit of the current restriction. For paths that cost more, the remaining costs can be too high, so searches may miss
    /// such paths.
    pub fn limit(&self) -> u32 { self.choices[self.now].limit }

    /// Raises the limit to `cost` or more if the computation is affordable. Returns whether the limit is now at least `cost`. If it is
    /// raised, results of number() become invalid.
    pub fn raise_limit(&mut self, cost: u32) -> bool {
        if self.is_priced() {
            if self.limit() >= cost { return true; }
            let found = self.orders_within(cost);
            return found.map(|(after, least)| self.set_orders(after, cost, least)).is_some();
        }
        let few = self.stops.len() <= MAX_STOPS_COMPLETE;
        if self.limit() < cost && (few || cost < self.choices[self.now].least + MAX_EXCESS) {
            let Choice { allowed, limit, least, .. } = self.choices.swap_remove(self.now);
            self.add_choice(allowed, if few { NEVER } else { cost.max(limit + ((limit - least) / 4).max(2)) });
        }
        self.limit() >= cost
    }

    /// Returns the index of a set of stops done, under the current restriction. Adds the set if it is new.
    pub fn number(&mut self, stops: u64) -> u32 {
        let Choice { after, numbers, done, .. } = &mut self.choices[self.now];
        if let Some(&found) = numbers.get(&stops) { return found; }
        let next = |(post, &(stop, _)): (usize, &(usize, u32))| {
            let rest = after.get(&(stops | 1 << stop, post as u32)).filter(|_| stops >> stop & 1 == 0);
            rest.map(|rest| (rest + self.stops[stop].duration, post as u32))
        };
        let mut rest: Vec<(u32, u32)> = self.posts.iter().enumerate().filter_map(next).collect();
        rest.sort_unstable();
        numbers.insert(stops, done.len() as u32);
        done.push(Done { stops, rest });
        done.len() as u32 - 1
    }

    /// Returns the index of a set of stops done if it has one.
    pub fn known_number(&self, stops: u64) -> Option<u32> { self.choices[self.now].numbers.get(&stops).copied() }

    pub fn done(&self, number: u32) -> u64 { self.choices[self.now].done[number as usize].stops }

    /// Returns the least remaining cost from a pose, with the stops in set `number` done. If all paths through this state cost more than
    /// the limit, the result can be too high or NEVER.
    pub fn remains(&self, number: u32, pose: u32) -> u32 {
        let Done { stops, rest } = &self.choices[self.now].done[number as usize];
        let ends = self.skipped(*stops).saturating_add(self.ends[pose as usize]).min(NEVER);
        if *stops == self.all() { return ends; }
        let (distances, mut least) = (self.distances(pose), ends);
        for &(rest, post) in rest.iter().take_while(|rest| rest.0 < NEVER) {
            if rest >= least { break; }
            least = least.min(rest + distances[post as usize]);
        }
        least
    }
}
