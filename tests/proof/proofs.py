# SPDX-License-Identifier: MIT
"""Makes certificates of tiny instances: conflict-based search that writes down what it does, in any of the rules."""
import itertools
import random

from worlds import INF, least_cost


def text(demand):
    agent, kind, *rest = demand
    return " ".join(["inf" if part == INF else str(part) for part in (agent, kind, *rest)])


class TooLong(Exception):
    pass


class Prover:
    """rules: which of pass, rest, stop, lemma, later, joint it may use, where it likes; known: costs, from one to the other."""

    def __init__(self, instance, rng, following=True, rules=(), most=3000, known=None):
        self.instance, self.rng, self.following, self.rules, self.most = instance, rng, following, set(rules), most
        self.lemmas, self.lines, self.known = [], [], {} if known is None else known

    def least(self, agent, demands):
        own = frozenset(d[1:] for d in demands if d[0] == agent)
        if (agent, own) not in self.known:
            self.known[agent, own] = least_cost(self.instance, agent, sorted(own, key=str))
        return self.known[agent, own]

    def certificate(self, bound):
        """The text that shows that no plan costs less. Raises TooLong."""
        everybody = list(range(len(self.instance.agents)))
        if "lemma" in self.rules:
            for _ in range(self.rng.randint(0, 3)):
                self.lemma(sorted(self.rng.sample(everybody, min(2, len(everybody)))), self.some_demands(everybody))
        head = ["grove-proof 1", f"instance {self.instance.checksum()}", f"following {'yes' if self.following else 'no'}"]
        theorem = [f"theorem {bound}", *self.proof(everybody, bound, [])]
        return "\n".join([*head, *self.lines, *theorem, "end"]) + "\n"

    def some_demands(self, agents):
        found, places = [], range(self.instance.world.count)
        for _ in range(self.rng.choice([0, 0, 0, 1])):
            found.append((self.rng.choice(agents), "bar", self.rng.choice(places), *[self.rng.randint(0, 4)] * 2))
        return found

    def lemma(self, agents, demands, bound=None):
        """Its number; None: nothing is found."""
        demands = [d for d in demands if d[0] in agents]
        try:
            bound = self.best(agents, demands) if bound is None else bound
            proof = self.proof(agents, bound, demands)
        except TooLong:
            return None
        self.lines += [" ".join(map(str, ["lemma", "inf" if bound == INF else bound, *agents])), *("demand " + text(d) for d in demands), *proof]
        self.lemmas.append((agents, bound, demands))
        return len(self.lemmas) - 1

    def best(self, agents, demands):
        """The most that a proof of some size shows: what the least cost is, mostly."""
        found = sum(self.least(agent, demands)[0] for agent in agents)
        for bound in itertools.count(found if found < INF else INF):
            if bound == INF:
                return INF
            try:
                Prover(self.instance, self.rng, self.following, (), 40, self.known).proof(agents, bound + 1, demands)
            except TooLong:
                return bound

    def proof(self, agents, bound, demands):
        """Lines. `most` splits, no more: a proof of what is false would not end."""
        self.left = self.most
        found, todo = [], [demands]
        while todo:
            now = todo.pop()
            step, alternatives = self.step(agents, bound, now)
            found += step
            todo += reversed(alternatives)
        return found

    def step(self, agents, bound, demands):
        """The lines of a rule, and the demands under which proofs must follow."""
        costs = {agent: self.least(agent, demands)[0] for agent in agents}
        if sum(costs.values()) >= bound:
            return ["leaf"], []
        names = [n for n, (own, _, needed) in enumerate(self.lemmas) if set(own) <= set(agents) and set(needed) <= set(demands)]
        if self.cover(costs, names) >= bound:
            return [" ".join(["leaf", *map(str, names)])], []
        self.left -= 1
        if self.left < 0:
            raise TooLong
        rng = self.rng
        if "joint" in self.rules and bound < INF and self.left < self.most - 2 and rng.random() < 0.5:
            return ["joint"], []
        if "later" in self.rules and rng.random() < 0.3 and (found := self.later(agents, demands)):
            return found
        if "stop" in self.rules and rng.random() < 0.2 and (found := self.order(agents, demands)):
            return self.split(agents, demands, *found)
        return self.split(agents, demands, *self.conflict(agents, demands))

    def split(self, agents, demands, one, two):
        if self.rng.random() < 0.5 and one[1] not in ("norest", "rest", "stop"):
            one, two = two, one
        sides = []
        for side in (one, two):
            bars = [(a, "bar", side[2], side[3], INF) for a in agents if a != side[0]] if side[1] == "rest" else []
            sides.append([*demands, side, *bars])
        return [f"split {text(one)} | {text(two)}"], sides

    def cover(self, costs, names):
        """The least sum of costs that lemmas allow."""
        if any(self.lemmas[n][1] == INF for n in names):
            return INF
        total, spare = sum(costs.values()), list(costs)
        for more in range(8):
            for choice in itertools.combinations_with_replacement(spare, more):
                if all(sum(costs[a] + choice.count(a) for a in self.lemmas[n][0]) >= self.lemmas[n][1] for n in names):
                    return total + more
        return total + 8

    def later(self, agents, demands):
        plain = [agent for agent in agents if self.instance.plain_goal(agent) is not None]
        if len(plain) < 2:
            return None
        pair = self.rng.sample(plain, 2)
        ends = [self.least(agent, demands)[0] for agent in pair]
        if INF in ends or "lemma" not in self.rules:
            return None
        ends[self.rng.randrange(2)] += self.rng.randint(0, 1)
        rules, self.rules = self.rules, set()
        left, most, self.most = self.left, self.most, 40
        number = self.lemma(sorted(pair), demands, sum(ends) + 1)
        self.rules, self.left, self.most = rules, left, most
        if number is None:
            return None
        sides = [[*demands, (agent, "norest", self.instance.plain_goal(agent), end)] for agent, end in zip(pair, ends)]
        return [f"later {pair[0]} {ends[0]} {pair[1]} {ends[1]} {number}"], sides

    def order(self, agents, demands):
        choices = [(agent, k, j) for agent in agents for stops in [self.instance.stops(agent)] for k in range(len(stops)) for j in stops
                   if len(stops) > 1 and not any(d[:4] == (agent, kind, k, j) for d in demands for kind in ("stop", "nostop"))]
        if not choices:
            return None
        agent, k, j = self.rng.choice(choices)
        return (agent, "stop", k, j), (agent, "nostop", k, j)

    def conflict(self, agents, demands):
        """A split in which neither side allows the paths that cost least."""
        paths = {agent: self.least(agent, demands)[1] for agent in agents}
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
            raise TooLong  # a plan that costs less
        rare = [pair for pair in found if pair[0][1] in ("norest", "pass")]
        return self.rng.choice(rare if rare and self.rng.random() < 0.5 else found[:6])

    def passes(self, one, two, at, time):
        """The split of two that meet within a chain, if both traverse it: as wide as it may be."""
        chain = self.instance.world.chain(at[one][time]) or self.instance.world.chain(at[two][time])
        if "pass" not in self.rules or not chain:
            return []
        exits = [((a, f, p), when) for a in (one, two) for f, p in ((chain[-2], chain[-1]), (chain[1], chain[0]))
                 for when in range(1, len(at[a])) if (at[a][when - 1], at[a][when]) == (f, p)]
        length = len(chain) - 1
        return [((a, "pass", f, p, s, r + length), (b, "pass", g, q, r, s + length))
                for ((a, f, p), s), ((b, g, q), r) in itertools.combinations(exits, 2)
                if a != b and (f, p) != (g, q) and s - r <= length and r - s <= length]


class Liar(Prover):
    """Proves what may be false, by one kind of lie that makes it easier: a checker that does not see it accepts the rest."""

    LIES = ("wide bar", "rest", "stop", "lemma", "scope", "later", "joint", "same agent")

    def __init__(self, instance, rng, lie, following, known):
        rules = {"rest", "pass", "stop", "lemma", "later"} | ({"joint"} if lie == "joint" else set())
        super().__init__(instance, rng, following, rules, 30, known)
        self.lie, self.lied = lie, False

    def split(self, agents, demands, one, two):
        a, b = list(one), list(two)
        if self.rng.random() < 0.7:
            if self.lie == "wide bar" and a[1] == "bar":
                a[4] += 2
            elif self.lie == "rest" and a[1] == "norest":
                a[3] += 2
            elif self.lie == "stop" and a[1] == "stop":
                b[3] = self.rng.choice([j for j in self.instance.stops(a[0]) if j != a[3]])
            elif self.lie == "same agent" and a[1] in ("bar", "move"):
                b = [a[0], *b[1:]]
            self.lied |= tuple(a) != one or tuple(b) != two
        return super().split(agents, demands, tuple(a), tuple(b))

    def lemma(self, agents, demands, bound=None):
        number = super().lemma(agents, demands, bound)
        if number is not None and self.lie in ("lemma", "scope"):
            own, bound, demands = self.lemmas[number]
            if self.lie == "lemma" and bound < INF:
                # A dearer lemma whose proof ends in a leaf that does not show it.
                self.lines += [" ".join(map(str, ["lemma", bound + 2, *own])), *("demand " + text(d) for d in demands), "leaf"]
                self.lemmas.append((own, bound + 2, demands))
                self.lied = True
            elif self.lie == "scope":
                self.lemmas[number] = (own, bound, [])
                self.lied |= bool(demands)
        return number

    def some_demands(self, agents):
        # For lemmas that say much, where they hold.
        if self.lie == "scope":
            return [(agent, "bar", place, 0, INF) for agent in agents for place in self.rng.sample(range(self.instance.world.count), 2)]
        return super().some_demands(agents)

    def later(self, agents, demands):
        found = super().later(agents, demands)
        if found and self.lie == "later":
            (line,), sides = found
            _, a, t, b, u, number = line.split(" ")
            sides = [[*side[:-1], (*side[-1][:3], side[-1][3] + 2)] for side in sides]
            self.lied = True
            return [f"later {a} {int(t) + 2} {b} {int(u) + 2} {number}"], sides
        return found

    def step(self, agents, bound, demands):
        found = super().step(agents, bound, demands)
        self.lied |= self.lie == "joint" and found[0] == ["joint"]
        return found
