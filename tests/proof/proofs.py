# SPDX-License-Identifier: MIT
"""Writes certificates of tiny instances by a conflict-based search that records its steps and uses any of the rules."""
import itertools
import random

from worlds import INF, least_cost


def text(constraint):
    agent, kind, *rest = constraint
    return " ".join(["inf" if part == INF else str(part) for part in (agent, kind, *rest)])


class TooLong(Exception):
    pass


class Prover:
    """Proves bounds and writes the proofs.

    rules: optional rules that it uses at random: pass, rest, stop, lemma, later, joint. known: cache of costs and
    paths by (agent, constraints), which several provers can share."""

    def __init__(self, instance, rng, following=True, rules=(), most=3000, known=None):
        self.instance, self.rng, self.following, self.rules, self.most = instance, rng, following, set(rules), most
        self.lemmas, self.lines, self.known = [], [], {} if known is None else known

    def least(self, agent, constraints):
        own = frozenset(d[1:] for d in constraints if d[0] == agent)
        if (agent, own) not in self.known:
            self.known[agent, own] = least_cost(self.instance, agent, sorted(own, key=str))
        return self.known[agent, own]

    def certificate(self, bound):
        """Returns a certificate that no plan costs less than `bound`. Raises TooLong if the proof is too long."""
        all_agents = list(range(len(self.instance.agents)))
        if "lemma" in self.rules:
            for _ in range(self.rng.randint(0, 3)):
                self.lemma(sorted(self.rng.sample(all_agents, min(2, len(all_agents)))),
                           self.some_constraints(all_agents))
        head = ["grove-proof 1", f"instance {self.instance.checksum()}",
                f"following {'yes' if self.following else 'no'}"]
        theorem = [f"theorem {bound}", *self.proof(all_agents, bound, [])]
        return "\n".join([*head, *self.lines, *theorem, "end"]) + "\n"

    def some_constraints(self, agents):
        found, places = [], range(self.instance.world.count)
        for _ in range(self.rng.choice([0, 0, 0, 1])):
            found.append((self.rng.choice(agents), "bar", self.rng.choice(places), *[self.rng.randint(0, 4)] * 2))
        return found

    def lemma(self, agents, constraints, bound=None):
        """Adds a lemma and returns its number, or None if no proof is found."""
        constraints = [d for d in constraints if d[0] in agents]
        try:
            bound = self.best(agents, constraints) if bound is None else bound
            proof = self.proof(agents, bound, constraints)
        except TooLong:
            return None
        self.lines += [" ".join(map(str, ["lemma", "inf" if bound == INF else bound, *agents])),
                       *("demand " + text(d) for d in constraints), *proof]
        self.lemmas.append((agents, bound, constraints))
        return len(self.lemmas) - 1

    def best(self, agents, constraints):
        """Returns the highest bound for which a proof of limited size is found, mostly the least cost."""
        found = sum(self.least(agent, constraints)[0] for agent in agents)
        for bound in itertools.count(found if found < INF else INF):
            if bound == INF:
                return INF
            try:
                Prover(self.instance, self.rng, self.following, (), 40,
                       self.known).proof(agents, bound + 1, constraints)
            except TooLong:
                return bound

    def proof(self, agents, bound, constraints):
        """Returns the lines of a proof. Raises TooLong after `most` steps other than leaves, because the proof of a
        false claim would not end."""
        self.left = self.most
        found, todo = [], [constraints]
        while todo:
            now = todo.pop()
            step, alternatives = self.step(agents, bound, now)
            found += step
            todo += reversed(alternatives)
        return found

    def step(self, agents, bound, constraints):
        """Returns the lines of one rule, and the sets of constraints for which proofs must follow."""
        costs = {agent: self.least(agent, constraints)[0] for agent in agents}
        if sum(costs.values()) >= bound:
            return ["leaf"], []
        names = [n for n, (own, _, needed) in enumerate(self.lemmas) if set(own) <= set(agents)
                 and set(needed) <= set(constraints)]
        if self.cover(costs, names) >= bound:
            return [" ".join(["leaf", *map(str, names)])], []
        self.left -= 1
        if self.left < 0:
            raise TooLong
        rng = self.rng
        if "joint" in self.rules and bound < INF and self.left < self.most - 2 and rng.random() < 0.5:
            return ["joint"], []
        if "later" in self.rules and rng.random() < 0.3 and (found := self.later(agents, constraints)):
            return found
        if "stop" in self.rules and rng.random() < 0.2 and (found := self.order(agents, constraints)):
            return self.split(agents, constraints, *found)
        return self.split(agents, constraints, *self.conflict(agents, constraints))

    def split(self, agents, constraints, one, two):
        if self.rng.random() < 0.5 and one[1] not in ("norest", "rest", "stop"):
            one, two = two, one
        sides = []
        for side in (one, two):
            bars = [(a, "bar", side[2], side[3], INF) for a in agents if a != side[0]] if side[1] == "rest" else []
            sides.append([*constraints, side, *bars])
        return [f"split {text(one)} | {text(two)}"], sides

    def cover(self, costs, names):
        """Returns the least sum of agent costs that satisfies the lemmas, or the sum of `costs` plus 8 if that is less.
        INF if the bound of a lemma is INF."""
        if any(self.lemmas[n][1] == INF for n in names):
            return INF
        total, spare = sum(costs.values()), list(costs)
        for more in range(8):
            for choice in itertools.combinations_with_replacement(spare, more):
                if all(sum(costs[a] + choice.count(a) for a in self.lemmas[n][0]) >= self.lemmas[n][1] for n in names):
                    return total + more
        return total + 8

    def later(self, agents, constraints):
        plain = [agent for agent in agents if self.instance.plain_goal(agent) is not None]
        if len(plain) < 2:
            return None
        pair = self.rng.sample(plain, 2)
        ends = [self.least(agent, constraints)[0] for agent in pair]
        if INF in ends or "lemma" not in self.rules:
            return None
        ends[self.rng.randrange(2)] += self.rng.randint(0, 1)
        rules, self.rules = self.rules, set()
        left, most, self.most = self.left, self.most, 40
        number = self.lemma(sorted(pair), constraints, sum(ends) + 1)
        self.rules, self.left, self.most = rules, left, most
        if number is None:
            return None
        sides = [[*constraints, (agent, "norest", self.instance.plain_goal(agent), end)]
                 for agent, end in zip(pair, ends)]
        return [f"later {pair[0]} {ends[0]} {pair[1]} {ends[1]} {number}"], sides

    def order(self, agents, constraints):
        choices = [(agent, k, j) for agent in agents for stops in [self.instance.stops(agent)]
                   for k in range(len(stops)) for j in stops
                   if len(stops) > 1
                   and not any(d[:4] == (agent, kind, k, j) for d in constraints for kind in ("stop", "nostop"))]
        if not choices:
            return None
        agent, k, j = self.rng.choice(choices)
        return (agent, "stop", k, j), (agent, "nostop", k, j)

    def conflict(self, agents, constraints):
        """Returns a split on a random conflict of the least-cost paths. Each side excludes one of the two paths.
        Raises TooLong if there is no conflict."""
        paths = {agent: self.least(agent, constraints)[1] for agent in agents}
        latest = max(map(len, paths.values())) + 1
        at = {agent: path + [path[-1]] * (latest - len(path)) for agent, path in paths.items()}
        found = []
        for time, (one, two) in itertools.product(range(latest), itertools.combinations(agents, 2)):
            p, q, before = at[one][time], at[two][time], time - 1
            if p == q:
                found.append(((one, "bar", p, time, time), (two, "bar", p, time, time)))
                for a, b in ((one, two), (two, one)):
                    if "rest" in self.rules and time >= len(paths[a]) - 1:
                        found.append(((a, "norest", p, time), (a, "rest", p, time)))
            elif time and (p, q) == (at[two][before], at[one][before]):
                found.append(((one, "move", q, p, time, time), (two, "move", p, q, time, time)))
                found += self.passes(one, two, at, time)
            elif time and not self.following and q != at[two][before] == p:
                found.append(((one, "bar", p, time, time), (two, "bar", p, before, before)))
            elif time and not self.following and p != at[one][before] == q:
                found.append(((two, "bar", q, time, time), (one, "bar", q, before, before)))
            if p == q:
                found += self.passes(one, two, at, time)
        if not found:
            raise TooLong  # a plan of lower cost exists
        rare = [pair for pair in found if pair[0][1] in ("norest", "pass")]
        return self.rng.choice(rare if rare and self.rng.random() < 0.5 else found[:6])

    def passes(self, one, two, at, time):
        """Returns pass splits, as wide as permitted, for two agents that meet within a chain and both traverse it."""
        chain = self.instance.world.chain(at[one][time]) or self.instance.world.chain(at[two][time])
        if "pass" not in self.rules or not chain:
            return []
        exits = [((a, f, p), when) for a in (one, two) for f, p in ((chain[-2], chain[-1]), (chain[1], chain[0]))
                 for when in range(1, len(at[a])) if (at[a][when - 1], at[a][when]) == (f, p)]
        length = len(chain) - 1
        return [((a, "pass", f, p, s, r + length), (b, "pass", g, q, r, s + length))
                for ((a, f, p), s), ((b, g, q), r) in itertools.combinations(exits, 2)
                if a != b and (f, p) != (g, q) and s - r <= length and r - s <= length]


class FaultyProver(Prover):
    """Proves claims that can be false, with one kind of fault that makes the proof easier. A checker that does not
    detect the fault accepts the certificate."""

    FAULTS = ("wide bar", "rest", "stop", "lemma", "scope", "later", "joint", "same agent")

    def __init__(self, instance, rng, fault, following, known):
        rules = {"rest", "pass", "stop", "lemma", "later"} | ({"joint"} if fault == "joint" else set())
        super().__init__(instance, rng, following, rules, 30, known)
        self.fault, self.is_faulty = fault, False

    def split(self, agents, constraints, one, two):
        a, b = list(one), list(two)
        if self.rng.random() < 0.7:
            if self.fault == "wide bar" and a[1] == "bar":
                a[4] += 2
            elif self.fault == "rest" and a[1] == "norest":
                a[3] += 2
            elif self.fault == "stop" and a[1] == "stop":
                b[3] = self.rng.choice([j for j in self.instance.stops(a[0]) if j != a[3]])
            elif self.fault == "same agent" and a[1] in ("bar", "move"):
                b = [a[0], *b[1:]]
            self.is_faulty |= tuple(a) != one or tuple(b) != two
        return super().split(agents, constraints, tuple(a), tuple(b))

    def lemma(self, agents, constraints, bound=None):
        number = super().lemma(agents, constraints, bound)
        if number is not None and self.fault in ("lemma", "scope"):
            own, bound, constraints = self.lemmas[number]
            if self.fault == "lemma" and bound < INF:
                # A lemma with too high a bound, whose proof consists of a leaf that does not show it.
                self.lines += [" ".join(map(str, ["lemma", bound + 2, *own])),
                               *("demand " + text(d) for d in constraints), "leaf"]
                self.lemmas.append((own, bound + 2, constraints))
                self.is_faulty = True
            elif self.fault == "scope":
                self.lemmas[number] = (own, bound, [])
                self.is_faulty |= bool(constraints)
        return number

    def some_constraints(self, agents):
        # Bars without an end, so that lemmas have high bounds under their constraints.
        if self.fault == "scope":
            return [(agent, "bar", place, 0, INF) for agent in agents
                    for place in self.rng.sample(range(self.instance.world.count), 2)]
        return super().some_constraints(agents)

    def later(self, agents, constraints):
        found = super().later(agents, constraints)
        if found and self.fault == "later":
            (line,), sides = found
            _, a, t, b, u, number = line.split(" ")
            sides = [[*side[:-1], (*side[-1][:3], side[-1][3] + 2)] for side in sides]
            self.is_faulty = True
            return [f"later {a} {int(t) + 2} {b} {int(u) + 2} {number}"], sides
        return found

    def step(self, agents, bound, constraints):
        found = super().step(agents, bound, constraints)
        self.is_faulty |= self.fault == "joint" and found[0] == ["joint"]
        return found
