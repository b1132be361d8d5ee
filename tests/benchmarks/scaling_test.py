#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the script of the scaling study, and tests that the pages agree with its result files."""
import fractions
import json
import os
import pathlib
import sys
import tempfile
import unittest

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import scaling  # noqa: E402
from harness.instances import instance_arguments  # noqa: E402
from harness.programs import run  # noqa: E402

GROVE = os.environ["GROVE"]

RESULTS = BENCHMARKS / "results/scaling"


class Results(unittest.TestCase):
    def test_time_shares_sum_to_one(self):
        for row in scaling.read(RESULTS / "simulated.csv"):
            shares = scaling.shares(row).values()
            self.assertAlmostEqual(sum(shares), 1, delta=1e-3, msg=row)
            self.assertGreaterEqual(min(shares), 0, row)

    def test_pages_agree_with_the_result_files(self):
        pages = [path.read_text(encoding="utf-8")
                 for path in (RESULTS / "README.md", BENCHMARKS / "tried-and-rejected.md")]
        rows = {name: scaling.read(RESULTS / f"{name}.csv")
                for name in ("simulated", "bound", "long", "earlier", "weak", "compared", "processor")}
        for table in (scaling.simulated_table(rows["simulated"], rows["bound"]),
                      scaling.simulated_table(rows["long"], []), scaling.weak_table(rows["weak"]),
                      scaling.compared_table(rows["compared"]), scaling.processor_table(rows["processor"])):
            self.assertIn(table, pages[0])
        self.assertIn(scaling.earlier_table(rows["earlier"], rows["simulated"] + rows["long"]), pages[1])


class LongInstances(unittest.TestCase):
    """Tests the start plans of data/long against its README, and the omega that ends a run at a known bound."""

    def test_start_plans_are_valid_for_the_instances(self):
        page = (BENCHMARKS / "data/long/README.md").read_text(encoding="utf-8")
        self.assertEqual({str(case) for case in scaling.LONG},
                         {file.name.removesuffix(".plan.json")
                          for file in (BENCHMARKS / "data/long").glob("*.plan.json")})
        for case in scaling.LONG:
            with self.subTest(case=str(case)), tempfile.TemporaryDirectory() as name:
                instance = instance_arguments(GROVE, None, case, name)
                plan = BENCHMARKS / f"data/long/{case}.plan.json"
                run([GROVE, "check", *instance, plan])
                cost = json.loads(plan.read_text(encoding="utf-8"))["cost"]
                self.assertRegex(page, rf"\| {case} \|.*\| {cost:,} \|")

    def test_omega_ends_runs_at_the_known_bound(self):
        with tempfile.TemporaryDirectory() as name:
            plan = pathlib.Path(name) / "a.plan.json"
            for cost, bound in ((1206, 1206), (2284, 2281), (16340, 16333)):
                plan.write_text(json.dumps({"cost": cost, "lower_bound": bound}), encoding="utf-8")
                omega = fractions.Fraction(scaling.until_bound_of(plan)[1])
                self.assertLessEqual(cost, (1 + omega) * bound)
                self.assertGreater(cost, (1 + omega) * (bound - 1))


class Study(unittest.TestCase):
    def test_ranks_grow_with_the_work(self):
        self.assertEqual([scaling.ranks_for({"wall_s": str(seconds)}, 2.5) for seconds in (0.1, 3, 10, 320)],
                         [2, 2, 4, 128])

    def test_merge_replaces_rows_of_the_same_instance_and_ranks(self):
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "rows.csv"
            first, second = (str(case) for case in scaling.HARD[:2])

            def row(instance, ranks, cost):
                return {"instance": instance, "ranks": str(ranks), "cost": cost}

            scaling.merge(path, [row(second, 16, "old"), row(second, 2, "old")])
            scaling.merge(path, [row(first, 1, "new")])
            scaling.merge(path, [row(second, 16, "new")])
            self.assertEqual(scaling.read(path), [row(first, 1, "new"), row(second, 2, "old"),
                                                  row(second, 16, "new")])


if __name__ == "__main__":
    unittest.main()
