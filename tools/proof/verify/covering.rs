// SPDX-License-Identifier: MIT
//! Covering problem of a leaf (docs/proof.md, section 4): choose a whole number >= 0 for each agent and minimise the sum of all numbers,
//! so that for each row the numbers of its agents sum up to at least its bound.

/// A row: agents, and a lower bound on the sum of their numbers.
pub type Row = (Vec<u32>, u64);

/// Maximum number of nodes of a search. If a search exceeds it, least() uses the bound of packing() instead.
const MAX_NODES: u32 = 200_000;

/// Returns a lower bound on the minimum sum of all numbers. The bound equals the minimum unless a search exceeds MAX_NODES. Solves each
/// connected component of the rows separately.
pub fn least(mut rows: Vec<Row>) -> u64 {
    rows.retain(|row| row.1 > 0);
    rows.sort_unstable_by(|one, two| two.1.cmp(&one.1));
    let mut sum = 0;
    while let Some(first) = rows.pop() {
        let (mut part, mut at) = (vec![first], 0);
        while at < part.len() {
            let (near, far) = rows.into_iter().partition(|row| row.0.iter().any(|agent| part[at].0.contains(agent)));
            part.extend::<Vec<Row>>(near);
            rows = far;
            at += 1;
        }
        part.sort_unstable_by(|one, two| two.1.cmp(&one.1));
        let mut search = Search { best: u64::MAX, nodes: 0 };
        search.descend(&part, 0);
        sum += if search.nodes <= MAX_NODES { search.best } else { packing(&part) };
    }
    sum
}

/// Returns the sum of the bounds of greedily chosen rows that have no agents in common. This is a lower bound on the minimum.
fn packing(rows: &[Row]) -> u64 {
    let mut taken: Vec<&Row> = Vec::new();
    for row in rows {
        if !taken.iter().any(|other| other.0.iter().any(|agent| row.0.contains(agent))) { taken.push(row); }
    }
    taken.iter().map(|row| row.1).sum()
}

/// Branch and bound.
struct Search {
    best: u64,
    nodes: u32,
}

impl Search {
    fn descend(&mut self, rows: &[Row], spent: u64) {
        self.nodes += 1;
        if self.nodes > MAX_NODES || spent + packing(rows) >= self.best { return; }
        if rows.is_empty() {
            self.best = spent;
            return;
        }
        let uses = |agent: &u32| rows.iter().filter(|row| row.0.contains(agent)).count();
        let agent = *rows[0].0.iter().max_by_key(|agent| uses(agent)).expect("an agent of each row");
        let most = rows.iter().filter(|row| row.0.contains(&agent)).map(|row| row.1).max().unwrap_or(0);
        for value in 0..=most {
            let fixed = |row: &Row| match row.0.contains(&agent) {
                true => (row.0.iter().copied().filter(|&other| other != agent).collect(), row.1.saturating_sub(value)),
                false => row.clone(),
            };
            let rest: Vec<Row> = rows.iter().map(fixed).filter(|row: &Row| row.1 > 0).collect();
            if rest.iter().all(|row| !row.0.is_empty()) { self.descend(&rest, spent + value); }
        }
    }
}
