#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks certificates of random tiny instances with known optimum: proven claims are verified, false claims never.

    generated_test.py GROVE_VERIFY
    GROVE_FUZZ_FACTOR=20: 20 times as many instances
"""
import os
import random
import re
import unittest
from collections import Counter

import checkers
from proofs import FaultyProver, Prover, TooLong, text
from worlds import INF, Agent, Instance, World, least_cost, optimum, random_instance

FACTOR = float(os.environ.get("GROVE_FUZZ_FACTOR", "1"))
KINDS = ("plain", "cts", "mg", "turning", "work", "roads")
RULES = ("rest", "pass", "stop", "lemma", "later", "joint")


def instances(count, kinds=KINDS, first=0):
    """Yields (rng, kind, instance, following, least cost) for `count` times FACTOR instances of all kinds in turn.

    Skips instances for which optimum() returns None.
    """
    for seed in range(first, first + int(count * FACTOR)):
        rng = random.Random(seed)
        kind = kinds[seed % len(kinds)]
        instance, following = random_instance(rng, kind), rng.random() < 0.75
        least = optimum(instance, following)
        if least is not None:
            yield rng, kind, instance, following, least


def raised(certificate, by=1):
    return re.sub(r"^theorem (\d+)$", lambda found: f"theorem {int(found.group(1)) + by}", certificate, flags=re.M)


def mutants(rng, certificate, count):
    """Yields `count` copies of a certificate that claim a bound higher by 1 and have at most one random change each."""
    lines = raised(certificate).split("\n")[:-1]
    for _ in range(count):
        mutant = list(lines)
        at = rng.randrange(3, len(mutant))
        numbers = list(re.finditer(r"\d+", mutant[at]))
        change = rng.choice(["number", "number", "number", "drop", "twice", "leaf", "swap"])
        if change == "number" and numbers and not mutant[at].startswith("theorem"):
            found = rng.choice(numbers)
            changed = max(0, int(found.group()) + rng.choice([-2, -1, 1, 2]))
            mutant[at] = mutant[at][:found.start()] + str(changed) + mutant[at][found.end():]
        elif change == "drop":
            del mutant[at]
        elif change == "twice":
            mutant.insert(at, mutant[at])
        elif change == "swap":
            other = rng.randrange(3, len(mutant))
            mutant[at], mutant[other] = mutant[other], mutant[at]
        elif mutant[at].startswith(("split", "later")):
            mutant[at] = "leaf"
        yield "\n".join(mutant) + "\n"


def claim(certificate):
    """Returns the bound that a certificate claims."""
    bound = re.findall(r"^theorem (\d+|inf)$", certificate, re.M)[-1]
    return INF if bound == "inf" else int(bound)


class Generated(unittest.TestCase):
    def test_optimum_is_verified_and_no_higher_bound(self):
        seen = Counter()
        for rng, kind, instance, following, least in instances(60):
            if least == INF:
                found = checkers.verify(instance, "\n".join(
                    ["grove-proof 1", f"instance {instance.checksum()}", f"following {'yes' if following else 'no'}",
                     "theorem inf", "joint", "end\n"]))
                self.assertEqual(found.text, f"verified: there is no plan{checkers.following_note(following)}\n")
                seen["none"] += 1
                continue
            try:
                certificate = Prover(instance, rng, following, [rule for rule in RULES if rng.random() < 0.6],
                                     150).certificate(least)
            except TooLong:
                seen["too long"] += 1
                continue
            found = checkers.verify(instance, certificate)
            self.assertEqual(found.text,
                             f"verified: no plan costs less than {least}{checkers.following_note(following)}\n",
                             f"{kind}\n{certificate}")
            self.assertEqual(checkers.verify(instance, raised(certificate)).code, 1, certificate)
            for mutant in mutants(rng, certificate, 4):
                found = checkers.verify(instance, mutant)
                self.assertIn(found.code, (0, 1, 2), mutant)
                self.assertTrue(found.code or claim(mutant) <= least, f"{kind}, least cost {least}:\n{mutant}")
                seen[found.code] += 1
            for line in certificate.split("\n"):
                seen[" ".join(re.findall("[a-z]+", line)[:2])] += 1
        for rule in ("split bar", "split move", "split norest", "split pass", "split stop", "leaf", "joint", "later",
                     "lemma", "demand bar"):
            self.assertTrue(seen[rule], f"{rule} occurs in {seen}")
        self.assertTrue(seen[1] > 80 * FACTOR and seen["none"] and seen["too long"] < 10 * FACTOR, seen)


    def test_lemma_bounds_are_exact_with_many_stops(self):
        """Checks agents with 12 stops, for which the checker does not examine all sets of stops."""
        for seed in range(int(2 * FACTOR)):
            rng = random.Random(3 * 10**6 + seed)
            world = World(rng.choice([["............."], ["......", ".@@@@.", "......"],
                                      [".......", "@.@.@.@", "@.@.@.@"]]))
            cells = [place for place in range(world.count) if world.passable(place)]
            turn = seed % 4 == 3
            agent = Agent((rng.choice(cells), *("N" if turn else "")), rng.choice([None, rng.choice(cells)]), int(turn))
            places = rng.sample(cells, 12)
            instance = Instance(world, [agent],
                                [(place, int(seed % 4 > 0 and place == places[0]), [0]) for place in places])
            bars = [(0, "bar", rng.choice(cells), *[rng.randint(1, 20)] * 2) for _ in range(3)]
            bars += [(0, "bar", place, begin, begin + rng.randint(5, 20)) for place in rng.sample(cells, 2)
                     for begin in [rng.randint(1, 30)]]
            free = least_cost(instance, 0, [])[0]
            late = [(0, "norest", place, free + rng.randint(8, 12)) for place in cells]
            order = rng.sample(range(12), 12)
            for constraints in (bars[:3], late,
                                [*bars, *((0, "stop", number, task) for number, task in enumerate(order))]):
                cost = least_cost(instance, 0, [constraint[1:] for constraint in constraints])[0]
                lemma = "\n".join([f"lemma {cost} 0".replace(f"{INF}", "inf"),
                                   *("demand " + text(constraint) for constraint in constraints), "leaf"])
                certificate = f"grove-proof 1\ninstance {instance.checksum()}\nfollowing yes\n{lemma}\n" \
                    "theorem 0\nleaf\nend\n"
                self.assertEqual(checkers.verify(instance, certificate).text, "verified: no plan costs less than 0\n",
                                 certificate)
                if cost < INF:
                    certificate = certificate.replace(f"lemma {cost}", f"lemma {cost + 1}")
                    self.assertRegex(checkers.verify(instance, certificate).text, f"costs {cost} and 0 by lemmas",
                                     certificate)

    def test_faulty_proofs_are_refused(self):
        counts = Counter()
        for number, (rng, kind, instance, following, least) in enumerate(instances(24, first=10**6)):
            known = {}
            for fault in FaultyProver.FAULTS if least < INF else ():
                prover = FaultyProver(instance, rng, fault, following, known)
                try:
                    certificate = prover.certificate(least + 1)
                except TooLong:
                    continue
                self.assertTrue(prover.is_faulty, certificate)
                found = checkers.verify(instance, certificate)
                self.assertEqual(found.code, 1,
                                 f"{number}: {fault}, {kind}, least cost {least}: {found.text}\n{certificate}")
                counts[fault] += 1
        self.assertGreaterEqual(len(counts), 6, counts)
        self.assertGreater(sum(counts.values()), 20 * FACTOR, counts)

    def test_small_checker_gives_the_same_verdicts(self):
        verdicts = Counter()
        for rng, _, instance, following, least in instances(75, ["plain"], first=2 * 10**6):
            if least == INF or any(agent.goal is None for agent in instance.agents):
                continue
            try:
                certificate = Prover(instance, rng, following, []).certificate(least)
            except TooLong:
                continue
            if not following and not self.simple(certificate):
                continue
            for proof in [certificate, raised(certificate), *mutants(rng, raised(certificate, -1), 3)]:
                one, two = checkers.verify(instance, proof), checkers.small_checker(instance, proof)
                self.assertEqual((one.code == 0, one.text if one.code == 0 else ""),
                                 (two.code == 0, two.text if two.code == 0 else ""), proof)
                verdicts[one.code == 0] += 1

        self.assertGreater(sum(verdicts.values()), 200 * FACTOR)
        self.assertGreater(min(verdicts.values()), 60 * FACTOR)

    @staticmethod
    def simple(certificate):
        """Returns whether each split of a certificate with `following no` is also valid with `following yes`."""
        return all(len(set(re.findall(r"bar \d+ (\d+)", line))) == 1
                   for line in certificate.split("\n") if " bar " in line)


if __name__ == "__main__":
    checkers.main(unittest)
