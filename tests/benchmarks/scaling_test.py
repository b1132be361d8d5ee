#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the script of the scaling study makes of its figures, and that its README shows them."""
import pathlib
import sys
import tempfile
import unittest

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import scaling  # noqa: E402

RESULTS = BENCHMARKS / "results/scaling"


class Results(unittest.TestCase):
    def test_shares_of_the_time_sum_to_one(self):
        for row in scaling.read(RESULTS / "simulated.csv"):
            shares = scaling.shares(row).values()
            self.assertAlmostEqual(sum(shares), 1, delta=1e-3, msg=row)
            self.assertGreaterEqual(min(shares), 0, row)

    def test_the_readme_shows_what_the_files_say(self):
        readme = (RESULTS / "README.md").read_text(encoding="utf-8")
        simulated, free, compared = (scaling.read(RESULTS / f"{name}.csv")
                                     for name in ("simulated", "bound", "compared"))
        self.assertIn(scaling.simulated_table(simulated, free), readme)
        self.assertIn(scaling.compared_table(compared), readme)


class Study(unittest.TestCase):
    def test_rows_of_an_instance_are_replaced(self):
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "rows.csv"
            first, second = (str(case) for case in scaling.HARD[:2])
            scaling.merge(path, [{"instance": second, "ranks": "1"}])
            scaling.merge(path, [{"instance": first, "ranks": "1"}])
            scaling.merge(path, [{"instance": second, "ranks": "2"}])
            self.assertEqual(scaling.read(path), [{"instance": first, "ranks": "1"},
                                                  {"instance": second, "ranks": "2"}])


if __name__ == "__main__":
    unittest.main()
