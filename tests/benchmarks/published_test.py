#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the comparison of published results with those of Grove: the pages agree with the result files."""
import pathlib
import sys
import unittest
from types import SimpleNamespace

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import published  # noqa: E402


def measured(success, runtime=10.0, sqr=None):
    return SimpleNamespace(success=success, solved=round(100 * success), mean_runtime_s=runtime, mean_sqr=sqr)


def configurations():
    """Returns two configurations on a room map.

    In the first, A has a higher success rate and a lower runtime than all baselines, and B solves twice as many
    instances as the best baseline. In the second, only B solves any instances.
    """
    baselines = {name: measured(0.4, 5.0, 1.0) for name in published.BASELINES}
    nothing = dict.fromkeys(published.BASELINES, measured(0))
    configuration = SimpleNamespace(map="room-1", agents=5, tasks=10)
    other = SimpleNamespace(map="room-1", agents=5, tasks=20)
    return {_Key(configuration): {published.A: measured(0.5, 4.0, 0.99), published.B: measured(0.8, 0.5, 0.95),
                         published.C: measured(0.75, 2.0, 0.97), **baselines},
            _Key(other): {published.A: measured(0), published.B: measured(0.2, 9.0, 0.9), published.C: measured(0),
                          **nothing}}


class _Key:
    def __init__(self, configuration):
        self.map, self.agents, self.tasks = configuration.map, configuration.agents, configuration.tasks

    def __lt__(self, other):
        return self.tasks < other.tasks


class Pages(unittest.TestCase):
    def test_pages_agree_with_the_result_files(self):
        rows = published.our_rows()
        for name, (table, page) in published.PARTS.items():
            with self.subTest(name):
                shown = published.marked(name).search(page.read_text(encoding="utf-8"))
                self.assertIsNotNone(shown)
                self.assertEqual(shown.group(), shown.group(1) + table(rows))

    def test_tables_list_every_statement_of_the_paper(self):
        rows = published.our_rows()
        tables = published.claims_table(rows) + published.omega_table(rows)
        for each in published.published():
            self.assertIn(f"| {each['published']} |", tables)


class Claims(unittest.TestCase):
    def test_claims_are_computed_from_the_configurations(self):
        for claim, text in {
            "success-ratio": "2 times at most (room, N = 5, M = 10: B against Optimal-CBS)",
            "speed-up": "10 times at most (room, N = 5, M = 10: B against Optimal-CBS)",
            "quality-loss": "5.0 % at most (room, N = 5, M = 10: B)",
            "quality-a": "1.0 to 1.0 % less, in the median 1.0 %",
            "room-success-a": "than all: 1 of the 1 configurations in which A or a baseline solves any; "
                              "lower than the best: 0",
            "room-runtime-a": "than the fastest: 1 of 2 configurations, 1.2 times at most",
            "success-b": "of the best baseline's: 2.0 to 2.0 times, in the median 2.0 times; "
                         "in 1 configurations B alone solves any",
            "runtime-b": "than the fastest baseline's: ten times and more in 1 of 2 configurations, 10 times at most",
            "quality-b": "at least 0.90 (room, N = 5, M = 20)",
            "success-c": "within 10 points: 1 of 2 configurations",
            "runtime-c": "2 of 2 configurations",
        }.items():
            with self.subTest(claim):
                self.assertEqual(published.CLAIMS[claim](configurations()), text)


if __name__ == "__main__":
    unittest.main()
