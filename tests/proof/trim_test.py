#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `grove proof trim`: trimmed certificates are verified as before, unneeded parts are removed, and invalid
files stay unchanged.

    trim_test.py GROVE_VERIFY GROVE
    GROVE_FUZZ_FACTOR=20: 20 times as many instances
"""
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import checkers
from generated_test import FACTOR, claim, instances, mutants
from proofs import Prover, TooLong, text
from worlds import INF

GROVE = Path(sys.argv.pop(2)).resolve()
OLD = Path(__file__).resolve().parent / "old"


def trim(certificate, *options):
    """Trims a certificate. Returns the exit code, the output, the content of the file afterwards, and the names of the
    files in its folder. certificate: text or bytes."""
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "c.proof"
        file.write_bytes(certificate if isinstance(certificate, bytes) else certificate.encode())
        done = subprocess.run([GROVE, "proof", "trim", file, *options], capture_output=True, text=True, timeout=60,
                              check=False)
        output = (done.stdout + done.stderr).replace(f"{name}/", "")
        return done.returncode, output, file.read_bytes(), sorted(path.name for path in Path(name).iterdir())


def trimmed(certificate):
    code, output, after, files = trim(certificate)
    assert (code, files) == (0, ["c.proof"]), output
    return after if isinstance(certificate, bytes) else after.decode()


class Padder(Prover):
    """Writes proofs with unneeded parts: lemmas about all agents, harmless splits, and leaves that name every usable
    lemma."""

    def __init__(self, instance, rng, following):
        super().__init__(instance, rng, following, [rule for rule in ("rest", "pass", "stop", "lemma", "later", "joint")
                                                    if rng.random() < 0.6], 60)
        self.pool, self.pads, self.all_agents = [], 0, list(range(len(instance.agents)))

    def random_sides(self):
        """Returns the two sides of a random split, often on a constraint of a lemma."""
        rng, places = self.rng, range(self.instance.world.count)
        a, b = rng.sample(self.all_agents, 2)
        constraint = rng.choice(self.pool) if self.pool and rng.random() < 0.7 else (
            a, rng.choice(["bar", "rest", "norest"]), rng.choice(places), rng.randint(0, 3))
        a, kind, place, time = constraint[:4]
        if kind in ("rest", "norest"):
            return rng.sample([(a, "norest", place, time), (a, "rest", place, time)], 2)
        if constraint[-1] == INF:  # a bar that a rest of another agent implies
            b = rng.choice([agent for agent in self.all_agents if agent != a])
            return rng.sample([(b, "norest", place, time), (b, "rest", place, time)], 2)
        b = b if b != a else next(agent for agent in self.all_agents if agent != a)
        return rng.sample([(a, "bar", place, time, time), (b, "bar", place, time, time)], 2)

    def certificate(self, bound):
        self.bound = bound
        for _ in range(self.rng.randint(0, 3) if len(self.all_agents) > 1 else 0):
            constraints = []
            for _ in range(self.rng.choice([0, 1, 1, 2])):
                side = self.random_sides()[0]
                extra = [(b, "bar", side[2], side[3], INF) for b in self.all_agents if b != side[0]]
                constraints.append(self.rng.choice(extra) if side[1] == "rest" and self.rng.random() < 0.5 else side)
            self.pads = self.rng.choice([0, 2])
            if self.lemma(self.all_agents, constraints,
                          self.rng.choice([bound, bound, bound, max(0, bound - 1)])) is not None:
                self.pool += constraints
        self.pads = 5
        return super().certificate(bound)

    def step(self, agents, bound, constraints):
        strong = [n for n, (own, least, needed) in enumerate(self.lemmas) if set(own) <= set(agents) and least >= bound
                  and set(needed) <= set(constraints)]
        names = [n for n, (own, _, needed) in enumerate(self.lemmas) if set(own) <= set(agents)
                 and set(needed) <= set(constraints)]
        if strong and self.rng.random() < 0.6:
            return [" ".join(["leaf", *map(str, names), str(self.rng.choice(names))])], []
        if agents == self.all_agents and len(agents) > 1 and self.pads > 0 and self.rng.random() < 0.6:
            self.pads -= 1
            one, two = self.random_sides()
            if one[1] in ("rest", "norest") or self.rng.random() < 0.8:
                return self.split(agents, constraints, one, two)
        return super().step(agents, bound, constraints)


class Trimmed(unittest.TestCase):
    def test_trimmed_certificates_are_verified(self):
        seen = Counter()
        for rng, kind, instance, following, least in instances(60, first=3 * 10**6):
            if least == INF:
                continue
            try:
                certificate = Padder(instance, rng, following).certificate(least)
            except TooLong:
                seen["too long"] += 1
                continue
            before = checkers.verify(instance, certificate)
            self.assertEqual(before.text,
                             f"verified: no plan costs less than {least}{checkers.following_note(following)}\n",
                             f"{kind}\n{certificate}")
            short = trimmed(certificate)
            after = checkers.verify(instance, short)
            self.assertEqual(after.text, before.text, f"{kind}\n{certificate}\n--- trimmed:\n{short}")
            self.assertEqual(trimmed(short), short, certificate)
            for word in ("lemma", "demand", "split", "later", "leaf"):
                seen[word] += sum(line.startswith(word) for line in certificate.split("\n"))
                seen[word] -= sum(line.startswith(word) for line in short.split("\n"))
            # Trimming must not make a false claim verifiable.
            for mutant in mutants(rng, certificate, 2):
                code, output, file, _ = trim(mutant)
                self.assertIn(code, (0, 2), output)
                if code == 0 and checkers.verify(instance, file).code == 0:
                    self.assertLessEqual(claim(file.decode()), least, mutant)
                    seen["true"] += 1
                elif code == 0 and checkers.verify(instance, mutant).code == 0:
                    self.fail(f"verified until it was trimmed:\n{mutant}")
                seen[f"mutants {code}"] += 1
        for word in ("lemma", "demand", "split", "leaf", "mutants 0", "mutants 2"):
            self.assertGreater(seen[word], 5 * FACTOR, seen)

    def test_certificates_of_removed_techniques_are_verified(self):
        for proof in OLD.glob("*.proof"):
            instance = proof.with_suffix(".cts.json")
            verdict = checkers.verify(instance, proof.read_text())
            self.assertEqual(verdict.code, 0, f"{proof}: {verdict.text}")
            self.assertEqual(checkers.verify(instance, trimmed(proof.read_text())).text, verdict.text, proof)

    HEAD = "grove-proof 1\ninstance 0123456789abcdef\nfollowing yes\n"

    def expect(self, before, after):
        self.assertEqual(trimmed(self.HEAD + before + "end\n"), self.HEAD + after + "end\n")
        self.assertEqual(trimmed(self.HEAD + after + "end\n"), self.HEAD + after + "end\n")

    def test_unused_lemmas_are_removed(self):
        self.expect("lemma 3 0\nleaf\nlemma 4 1\nleaf\nlemma 5 0 1\nleaf 1\nlemma 9 2\nleaf 0\ntheorem 8\nleaf 2\n",
                    "lemma 4 1\nleaf\nlemma 5 0 1\nleaf 0\ntheorem 8\nleaf 1\n")
        self.expect("lemma 3 0\nleaf\nlemma 9 0 1\njoint\ntheorem 8\nlater 0 3 1 5 1\nleaf\njoint\n",
                    "lemma 9 0 1\njoint\ntheorem 8\nlater 0 3 1 5 0\nleaf\njoint\n")

    def test_duplicate_lemmas_are_removed(self):
        self.expect("lemma 5 0 1\ndemand 0 bar 1 2 2\njoint\nlemma 5 0 1\ndemand 0 bar 1 2 2\ndemand 0 bar 1 2 2\n"
                    "joint\ntheorem 8\n"
                    "split 0 bar 1 2 2 | 1 bar 1 2 2\nleaf 1\nleaf\n",
                    "lemma 5 0 1\ndemand 0 bar 1 2 2\njoint\ntheorem 8\n"
                    "split 0 bar 1 2 2 | 1 bar 1 2 2\nleaf 0\nleaf\n")
        # The second lemma has the higher bound.
        self.expect("lemma 5 0 1\njoint\nlemma 6 0 1\njoint\ntheorem 8\nleaf 1\n",
                    "lemma 6 0 1\njoint\ntheorem 8\nleaf 0\n")

    def test_implied_lemma_names_are_removed(self):
        self.expect("lemma 5 0 1\njoint\nlemma 4 0 1 2\njoint\nlemma 7 0 2\njoint\nlemma 0 1\nleaf\n"
                    "theorem 20\nleaf 0 1 2 2 3\n",
                    "lemma 5 0 1\njoint\nlemma 7 0 2\njoint\ntheorem 20\nleaf 0 1\n")
        # Two lemmas without a common agent suffice, whatever the individual costs of the agents are.
        self.expect("lemma 5 0 1\njoint\nlemma 6 0 2\njoint\nlemma 7 2 3\njoint\ntheorem 12\nleaf 0 1 2\n",
                    "lemma 5 0 1\njoint\nlemma 7 2 3\njoint\ntheorem 12\nleaf 0 1\n")

    def test_unneeded_splits_are_removed(self):
        inf = "lemma inf 0\ndemand 0 bar 1 2 2\nleaf\n"
        split, other = "split 0 bar 1 2 2 | 1 bar 1 2 2\n", "split 2 move 1 4 6 6 | 3 move 4 1 6 6\n"
        self.expect(f"{inf}theorem 8\n{split}{other}leaf 0\nleaf\njoint\n", f"{inf}theorem 8\n{split}leaf 0\njoint\n")
        self.expect(f"{inf}theorem 8\n{split}{other}joint\nleaf 0\njoint\n", f"{inf}theorem 8\n{split}leaf 0\njoint\n")
        # The costs of agents can depend on the constraints, so both splits stay.
        for kept in (f"{inf}theorem 8\n{split}leaf 0\n{other}leaf\nleaf\n",
                     f"{inf}theorem 8\n{other}{split}leaf 0\nleaf\njoint\n"):
            self.expect(kept, kept)
        # The lemma alone proves the theorem.
        self.expect(f"lemma 8 0 1 2 3\njoint\ntheorem 8\n{split}{other}leaf 0\nleaf\nleaf\n",
                    "lemma 8 0 1 2 3\njoint\ntheorem 8\nleaf 0\n")

    def test_one_of_two_splits_with_a_needed_constraint_stays(self):
        """Checks a constraint that both the outer and the inner split impose. One of the splits stays, either the
        outer or the inner one."""
        inf = "lemma inf 0\ndemand 0 bar 1 2 2\nleaf\n"
        outer, inner = "split 0 bar 1 2 2 | 1 bar 1 2 2\n", "split 0 bar 1 2 2 | 3 bar 1 2 2\n"
        self.expect(f"{inf}theorem 8\n{outer}{inner}leaf 0\njoint\njoint\n", f"{inf}theorem 8\n{outer}leaf 0\njoint\n")
        self.expect(f"{inf}theorem 8\n{inner}{outer}leaf 0\njoint\nsplit 2 bar 9 1 1 | 1 bar 9 1 1\njoint\njoint\n",
                    f"{inf}theorem 8\n{inner}leaf 0\nsplit 2 bar 9 1 1 | 1 bar 9 1 1\njoint\njoint\n")

    def test_splits_by_constraints_in_force_are_removed(self):
        split = "split 0 bar 1 2 2 | 1 bar 1 2 2\n"
        self.expect(f"theorem 8\n{split}{split}leaf\njoint\njoint\n", f"theorem 8\n{split}leaf\njoint\n")
        self.expect(f"theorem 8\n{split}leaf\n{split}leaf\njoint\n", f"theorem 8\n{split}leaf\njoint\n")
        later = "lemma 9 0 1\njoint\ntheorem 8\nlater 0 3 1 5 0\n"
        self.expect(f"{later}later 0 3 1 5 0\nleaf\njoint\nleaf\n", f"{later}leaf\nleaf\n")

    def test_rest_implies_bars_for_other_agents(self):
        inf = "lemma inf 1\ndemand 1 bar 4 2 inf\nleaf\n"
        rest = "split 0 norest 4 2 | 0 rest 4 2\n"
        kept = f"{inf}theorem 8\n{rest}joint\nleaf 0\n"
        self.expect(kept, kept)
        self.expect(f"{inf}theorem 8\n{rest}joint\nsplit 2 norest 4 2 | 2 rest 4 2\njoint\nleaf 0\n",
                    f"{inf}theorem 8\n{rest}joint\nleaf 0\n")
        # A rest among the constraints of a lemma implies no bars, so the split within its proof stays.
        kept = f"{inf}lemma 8 0 1\ndemand 0 rest 4 2\n{rest}joint\nleaf 0\n" \
            "theorem 9\nsplit 0 norest 4 2 | 0 rest 4 2\njoint\nleaf 1\n"
        self.expect(kept, kept)

    def test_later_imposes_norest_at_an_unknown_goal(self):
        inf = "lemma inf 0 1\ndemand 0 norest 7 3\njoint\n"
        kept = f"{inf}lemma 9 0 1\njoint\ntheorem 8\nlater 0 3 1 5 1\nleaf 0\njoint\n"
        self.expect(kept, kept)
        self.expect(f"{inf}lemma 9 0 1\njoint\ntheorem 8\nlater 1 3 0 5 1\nsplit 0 norest 7 3 | 0 rest 7 3\nleaf 0\n"
                    f"joint\nleaf\n",
                    f"{inf}lemma 9 0 1\njoint\ntheorem 8\nlater 1 3 0 5 1\nsplit 0 norest 7 3 | 0 rest 7 3\nleaf 0\n"
                    f"joint\nleaf\n")

    def test_unneeded_constraints_of_lemmas_are_removed(self):
        self.expect("lemma 5 0 1\njoint\nlemma 5 0 1 2\ndemand 2 bar 1 1 1\nleaf 0\n"
                    "theorem 9\nsplit 2 bar 1 1 1 | 0 bar 1 1 1\nleaf 1\nleaf\n",
                    "lemma 5 0 1\njoint\nlemma 5 0 1 2\nleaf 0\n"
                    "theorem 9\nsplit 2 bar 1 1 1 | 0 bar 1 1 1\nleaf 1\nleaf\n")

    def test_rows_of_price_zero_are_removed(self):
        self.expect("theorem 8\nprices\nplace 1 2 0\nedge 1 2 3 7\nfinish 0 1 1 2 0\nend\n",
                    "theorem 8\nprices\nedge 1 2 3 7\nend\n")

    def test_formulas_remain(self):
        formula = "formula\nagent 0 1\nwithin 0 0\nvisit 0 1 1\nrests 0 2 inf\nsum -1\nclause -1 2\ndrop 0\nclause\n" \
            "core 0\nend\n"
        self.expect(f"theorem 8\n{formula}", f"theorem 8\n{formula}")
        self.expect(f"lemma 9 0 1\njoint\ntheorem 8\n{formula}", f"theorem 8\n{formula}")

    def test_deep_certificates_are_trimmed(self):
        deep = 100000
        split = "".join(f"split 0 bar 1 {t} {t} | 1 bar 1 {t} {t}\nleaf\n" for t in range(deep))
        self.expect(f"lemma 9 0 1\njoint\ntheorem 10\n{split}leaf 0\n",
                    f"lemma 9 0 1\njoint\ntheorem 10\n{split}leaf 0\n")
        self.expect(f"lemma 9 0 1\njoint\ntheorem 9\n{split}leaf 0\n", "lemma 9 0 1\njoint\ntheorem 9\nleaf 0\n")


class Files(unittest.TestCase):
    TEXT = Trimmed.HEAD + "lemma 3 0\nleaf\ntheorem 4\nsplit 0 bar 1 2 2 | 1 bar 1 2 2\nleaf\nleaf\nend\n"

    def test_output_reports_sizes(self):
        code, output, after, _ = trim(self.TEXT)
        self.assertEqual((code, output),
                         (0, f"wrote c.proof: 8 lines, {len(after)} bytes; before: 10 lines, {len(self.TEXT)} bytes\n"))

    @unittest.skipUnless(shutil.which("zstd"), "no zstd")
    def test_compressed_certificates_stay_compressed(self):
        packed = subprocess.run(["zstd", "-c"], input=self.TEXT.encode(), capture_output=True, check=True).stdout
        after = trimmed(packed)
        self.assertEqual(subprocess.run(["zstd", "-dc"], input=after, capture_output=True, check=True).stdout.decode(),
                         trimmed(self.TEXT))
        for size in range(5, len(packed), 7):
            code, output, after, files = trim(packed[:size])
            if code != 0:
                self.assertRegex(output, "^grove: error: c.proof: .*expected")
                self.assertEqual((code, after, files), (2, packed[:size], ["c.proof"]))

    @unittest.skipUnless(shutil.which("zstd"), "no zstd")
    def test_decompression_bomb_keeps_the_memory_limit(self):
        """Trims less than 60,000 bytes that decompress to hundreds of megabytes of lemmas."""
        def pack(text):
            return subprocess.run(["zstd", "-19", "-c"], input=text, capture_output=True, check=True).stdout
        lemma = b"lemma 3 0\ndemand 0 bar 1 2 2\ndemand 0 bar 1 3 3\nleaf\n"
        # Packed in parts, because the measured memory peak of a child starts at that of its parent.
        packed = pack(Trimmed.HEAD.encode()) + 100 * pack(50_000 * lemma)
        self.assertLess(len(packed), 60_000)
        code, output, after, files = trim(packed, "--memory-limit", "0.2")
        self.assertEqual((code, after, files), (2, packed, ["c.proof"]))
        self.assertRegex(output, "^grove: error: c.proof: needs more memory than 0.2 GB to be trimmed; ")
        self.assertLess(1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 0.2e9 + 150e6)

    def test_output_option_leaves_the_input_unchanged(self):
        with tempfile.TemporaryDirectory() as name:
            to = Path(name) / "to"
            code, output, after, _ = trim(self.TEXT, "-o", to)
            self.assertEqual((code, after.decode()), (0, self.TEXT))
            self.assertTrue(output.startswith("wrote "), output)
            self.assertEqual(to.read_text(), trimmed(self.TEXT))
            code, output, after, _ = trim(self.TEXT, "-o", to / "none")
            self.assertEqual((code, after.decode()), (2, self.TEXT))

    def test_invalid_certificates_stay_unchanged(self):
        for text_there, expected in [("", "line 1: the file ends; expected a line, ended by LF"),
                                     ("grove-proof 2\n", "line 1: found '2'; expected '1'"),
                                     (self.TEXT.replace("0123", "012"),
                                      "line 2: found '012456789abcdef'; expected a checksum, 16 digits of 0 to f"),
                                     (self.TEXT.replace("leaf\nend", "leaf 1\nend"),
                                      "line 9: found '1'; expected the number of an earlier lemma, from 0 to 0"),
                                     (self.TEXT[:-1], "line 10: the file ends within it; expected a line, ended by LF"),
                                     (self.TEXT + "\n", "line 10: found more after it; expected nothing after 'end'"),
                                     ("x" * 5000000, "line 1: it is too long; expected at most 4194304 bytes")]:
            code, output, after, files = trim(text_there)
            self.assertEqual((code, output), (2, f"grove: error: c.proof: {expected}\n"))
            self.assertEqual((after.decode(), files), (text_there, ["c.proof"]))

    def test_missing_and_irregular_files_are_refused(self):
        for path, reason in (("none", "cannot be read: No such file or directory"),
                             ("/dev/null", "expected a file, which can be read more than once")):
            done = subprocess.run([GROVE, "proof", "trim", path], capture_output=True, text=True, timeout=60,
                                  check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", f"grove: error: {path}: {reason}\n"))


if __name__ == "__main__":
    checkers.main(unittest)
