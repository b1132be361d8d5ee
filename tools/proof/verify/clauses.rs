// SPDX-License-Identifier: MIT
//! Clauses and unit propagation (two watched literals), for steps that follow by reverse unit propagation (RUP). A step is accepted if
//! unit propagation refutes the negation of the clause. There is no search.

/// A literal: twice the number of its variable, plus 1 if it is negated.
pub type Literal = u32;

pub fn not(literal: Literal) -> Literal { literal ^ 1 }

/// A clause in `arena`, by the index of its header. NONE: the clause is true forever, or has become a unit.
pub type Handle = u32;
const NONE: u32 = u32::MAX;
/// In a header: the clause is dropped.
const DROPPED: u32 = 1 << 31;

/// A watcher: a clause, and one of its literals. While that literal is true, the clause need not be visited.
#[derive(Clone, Copy)]
struct Watch {
    clause: Handle,
    blocker: Literal,
}

#[derive(Default)]
pub struct Clauses {
    /// By literal: 1 true, -1 false, 0 unknown.
    values: Vec<i8>,
    /// True literals in the order of their assignment. The first `root` are true forever.
    trail: Vec<Literal>,
    head: usize,
    /// Clauses. Each has a header with its length, and its literals. The first two are watched.
    arena: Vec<u32>,
    /// By literal: the clauses that watch it, to be visited when it becomes false.
    watches: Vec<Vec<Watch>>,
    /// By variable: the index of its group, or NONE, and its owner.
    group_of: Vec<(u32, u32)>,
    /// Variables of which those with different owners exclude each other, with their owners.
    groups: Vec<Vec<(u32, u32)>>,
    /// The clauses are contradictory.
    pub refuted: bool,
}

impl Clauses {
    pub fn new(variables: usize) -> Clauses {
        let (values, watches, group_of) = (vec![0; 2 * variables], vec![Vec::new(); 2 * variables], vec![(NONE, 0); variables]);
        Clauses { values, watches, group_of, ..Clauses::default() }
    }

    /// Adds a group of variables, each with an owner: two of them with different owners are never both true. A variable is in one group at
    /// most. Must be called before all clauses.
    pub fn add_group(&mut self, members: Vec<(u32, u32)>) {
        assert!(self.trail.is_empty() && self.groups.len() < NONE as usize, "groups come first");
        for &(owner, variable) in &members {
            assert!(self.group_of[variable as usize].0 == NONE, "a variable is in one group");
            self.group_of[variable as usize] = (self.groups.len() as u32, owner);
        }
        self.groups.push(members);
    }

    /// Adds a clause that follows from the others, or is an axiom.
    pub fn add(&mut self, literals: &[Literal]) -> Handle {
        let mut clause: Vec<Literal> = literals.iter().copied().filter(|&literal| self.value(literal) >= 0).collect();
        clause.sort_unstable();
        clause.dedup();
        let holds = clause.iter().any(|&literal| self.value(literal) > 0) || clause.windows(2).any(|two| two[0] == not(two[1]));
        if self.refuted || holds { return NONE; }
        if clause.len() < 2 {
            self.refuted = clause.is_empty() || !self.assume(clause[0]) || !self.propagate();
            return NONE;
        }
        let at = self.arena.len();
        assert!(at + clause.len() < DROPPED as usize, "fewer clauses");
        for (watched, other) in [(clause[0], clause[1]), (clause[1], clause[0])] {
            self.watches[watched as usize].push(Watch { clause: at as u32, blocker: other });
        }
        self.arena.push(clause.len() as u32);
        self.arena.extend(clause);
        at as u32
    }

    /// Drops a clause. Consequences that are true forever remain.
    pub fn drop(&mut self, handle: Handle) { if handle != NONE { self.arena[handle as usize] |= DROPPED; } }

    /// Returns whether unit propagation refutes the negation of the clause.
    pub fn implies(&mut self, literals: &[Literal]) -> bool {
        if self.refuted { return true; }
        let root = self.trail.len();
        let consistent = literals.iter().all(|&literal| self.assume(not(literal))) && self.propagate();
        for literal in self.trail.drain(root..) {
            self.values[literal as usize] = 0;
            self.values[not(literal) as usize] = 0;
        }
        self.head = root;
        !consistent
    }

    /// Returns all clauses in DIMACS format, with the exclusions of the groups.
    pub fn dimacs(&self) -> String {
        let mut clauses: Vec<Vec<Literal>> = self.trail.iter().map(|&literal| vec![literal]).collect();
        let mut at = 0;
        while at < self.arena.len() {
            let end = at + 1 + (self.arena[at] & !DROPPED) as usize;
            clauses.push(self.arena[at + 1..end].to_vec());
            at = end;
        }
        for group in &self.groups {
            for (number, one) in group.iter().enumerate() {
                let others = group[..number].iter().filter(|other| other.0 != one.0);
                clauses.extend(others.map(|other| vec![2 * one.1 + 1, 2 * other.1 + 1]));
            }
        }
        if self.refuted { clauses.push(Vec::new()); }
        let mut text = format!("p cnf {} {}\n", self.group_of.len(), clauses.len());
        for clause in clauses {
            for literal in clause { text += &format!("{}{} ", if literal % 2 == 1 { "-" } else { "" }, literal / 2 + 1); }
            text += "0\n";
        }
        text
    }

    fn value(&self, literal: Literal) -> i8 { self.values[literal as usize] }

    /// Makes a literal true. Returns false if it is false.
    fn assume(&mut self, literal: Literal) -> bool {
        if self.value(literal) == 0 {
            self.values[literal as usize] = 1;
            self.values[not(literal) as usize] = -1;
            self.trail.push(literal);
        }
        self.value(literal) > 0
    }

    /// Returns false if there is a conflict.
    fn propagate(&mut self) -> bool {
        while self.head < self.trail.len() {
            let literal = self.trail[self.head];
            self.head += 1;
            if !self.exclude(literal) || !self.visit(not(literal)) { return false; }
        }
        true
    }

    /// Makes the variables false that a true literal excludes.
    fn exclude(&mut self, literal: Literal) -> bool {
        let (variable, negated) = (literal / 2, literal % 2 == 1);
        let (group, owner) = self.group_of[variable as usize];
        if negated || group == NONE { return true; }
        let members = std::mem::take(&mut self.groups[group as usize]);
        let consistent = members.iter().all(|&(other, excluded)| other == owner || self.assume(2 * excluded + 1));
        self.groups[group as usize] = members;
        consistent
    }

    /// Visits the clauses that watch a false literal.
    fn visit(&mut self, falsified: Literal) -> bool {
        let mut watches = std::mem::take(&mut self.watches[falsified as usize]);
        let (mut kept, mut next, mut consistent) = (0, 0, true);
        while next < watches.len() {
            let watch = watches[next];
            next += 1;
            if self.value(watch.blocker) > 0 {
                watches[kept] = watch;
                kept += 1;
                continue;
            }
            let at = watch.clause as usize;
            let length = self.arena[at];
            if length & DROPPED != 0 { continue; }
            let clause = &mut self.arena[at + 1..at + 1 + length as usize];
            if clause[0] == falsified { clause.swap(0, 1); }
            let other = clause[0];
            let values = &self.values;
            let free = if values[other as usize] > 0 { None } else { (2..clause.len()).find(|&i| values[clause[i] as usize] >= 0) };
            if let Some(free) = free {
                clause.swap(1, free);
                let found = clause[1];
                self.watches[found as usize].push(Watch { clause: watch.clause, blocker: other });
                continue;
            }
            watches[kept] = Watch { blocker: other, ..watch };
            kept += 1;
            consistent = self.assume(other);
            if !consistent { break; }
        }
        watches.copy_within(next.., kept);
        watches.truncate(kept + watches.len() - next);
        self.watches[falsified as usize] = watches;
        consistent
    }
}
