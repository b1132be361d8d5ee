// SPDX-License-Identifier: MIT
//! Covering (docs/proof.md, 4, leaf): whole numbers, one for each agent, of which some sums must reach what lemmas say.

/// Agents whose numbers together are at least so much.
pub type Need = (Vec<u32>, u64);

/// More nodes of a search than this are too many: then what is found at once must do.
const MAX_NODES: u32 = 200_000;

/// A lower bound of the sum of all numbers: the least, if that is not too hard to find.
pub fn least(mut needs: Vec<Need>) -> u64 {
    needs.retain(|need| need.1 > 0);
    needs.sort_unstable_by(|one, two| two.1.cmp(&one.1));
    let mut sum = 0;
    while let Some(first) = needs.pop() {
        let (mut part, mut at) = (vec![first], 0);
        while at < part.len() {
            let (near, far) = needs.into_iter().partition(|need| need.0.iter().any(|agent| part[at].0.contains(agent)));
            part.extend::<Vec<Need>>(near);
            needs = far;
            at += 1;
        }
        part.sort_unstable_by(|one, two| two.1.cmp(&one.1));
        let mut search = Search { best: u64::MAX, nodes: 0 };
        search.descend(&part, 0);
        sum += if search.nodes <= MAX_NODES { search.best } else { packing(&part) };
    }
    sum
}

/// What needs without a common agent add up to.
fn packing(needs: &[Need]) -> u64 {
    let mut taken: Vec<&Need> = Vec::new();
    for need in needs {
        if !taken.iter().any(|other| other.0.iter().any(|agent| need.0.contains(agent))) { taken.push(need); }
    }
    taken.iter().map(|need| need.1).sum()
}

struct Search {
    best: u64,
    nodes: u32,
}

impl Search {
    fn descend(&mut self, needs: &[Need], spent: u64) {
        self.nodes += 1;
        if self.nodes > MAX_NODES || spent + packing(needs) >= self.best { return; }
        if needs.is_empty() {
            self.best = spent;
            return;
        }
        let uses = |agent: &u32| needs.iter().filter(|need| need.0.contains(agent)).count();
        let agent = *needs[0].0.iter().max_by_key(|agent| uses(agent)).expect("an agent of each need");
        let most = needs.iter().filter(|need| need.0.contains(&agent)).map(|need| need.1).max().unwrap_or(0);
        for value in 0..=most {
            let fixed = |need: &Need| match need.0.contains(&agent) {
                true => (need.0.iter().copied().filter(|&other| other != agent).collect(), need.1.saturating_sub(value)),
                false => need.clone(),
            };
            let rest: Vec<Need> = needs.iter().map(fixed).filter(|need: &Need| need.1 > 0).collect();
            if rest.iter().all(|need| !need.0.is_empty()) { self.descend(&rest, spent + value); }
        }
    }
}
