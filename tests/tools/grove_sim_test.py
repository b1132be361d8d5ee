#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the command line of grove-sim: its tables and the input that it refuses.

    grove_sim_test.py GROVE_SIM
"""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

GROVE_SIM = Path(sys.argv[1]).resolve()
DATA = Path(__file__).resolve().parents[2] / "benchmarks/data"
EASY = DATA / "rooms-32x32_n5_m10.cts.json"
LONG = DATA / "rooms-32x32_n10_m30.cts.json"
ONE_WAY = DATA / "yard.cts.json"
OPTIMAL = ["--omega", 0, "--seconds-per-work", 1e-7]


class GroveSim(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_it(self, *words):
        return subprocess.run([GROVE_SIM, *map(str, words)], cwd=self.folder, capture_output=True, text=True)

    def rows(self, *words):
        done = self.run_it(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return list(csv.DictReader(done.stdout.splitlines()))

    def refuses(self, *words, because):
        done = self.run_it(*words)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        for text in because:
            self.assertIn(text, done.stderr)

    def test_table_has_a_row_for_each_number_of_ranks(self):
        rows = self.rows(LONG, *OPTIMAL, "--ranks", "1,2,5", "--output", "table.csv", "--profile", "profile.csv")
        self.assertEqual([row["ranks"] for row in rows], ["1", "2", "5"])
        self.assertGreater(int(rows[0]["nodes"]), 0)
        self.assertEqual({row["status"] for row in rows}, {"optimal"})
        self.assertEqual(len({(row["cost"], row["lower_bound"]) for row in rows}), 1)
        self.assertEqual((float(rows[0]["speed_up"]), float(rows[0]["efficiency"])), (1, 1))
        for row in rows:
            ranks, speed_up = int(row["ranks"]), float(rows[0]["wall_s"]) / float(row["wall_s"])
            self.assertAlmostEqual(float(row["speed_up"]), speed_up, delta=0.001 * speed_up)
            self.assertAlmostEqual(float(row["efficiency"]), speed_up / ranks, delta=0.001)
        with (self.folder / "table.csv").open(newline="") as file:
            self.assertEqual(list(csv.DictReader(file)), rows)
        with (self.folder / "profile.csv").open(newline="") as file:
            self.assertEqual({row["ranks"] for row in csv.DictReader(file)}, {"1", "2", "5"})

    def test_choices_are_refused(self):
        instance = json.loads((DATA / "first.cts.json").read_text(encoding="utf-8"))
        instance["map"] = str(DATA / "first.map")
        instance["tasks"][1]["need"] = 1
        (self.folder / "need.cts.json").write_text(json.dumps(instance), encoding="utf-8")
        self.refuses("need.cts.json", because=["need.cts.json: /tasks/1/need: task 'press' has a choice of agents, which "
                                               "grove-sim does not support; expected 'grove solve', or "])

    def test_single_rank_has_no_row_unless_requested(self):
        row, = self.rows(EASY, *OPTIMAL, "--ranks", 3)
        self.assertEqual(row["ranks"], "3")

    def test_runs_with_seconds_per_work_are_repeatable(self):
        first, second = (self.rows(LONG, *OPTIMAL, "--ranks", "2,4") for _ in range(2))
        self.assertEqual(first, second)

    def test_runs_that_reach_the_time_limit_are_unfinished(self):
        rows = self.rows(LONG, *OPTIMAL, "--ranks", "1,2", "--primal-steps", 0, "--time-limit", 0)
        self.assertEqual([row["status"] for row in rows], ["unfinished"] * 2)

    def test_old_name_of_seconds_per_work_is_accepted(self):
        old, new = (self.rows(EASY, "--omega", 0, name, 1e-7, "--ranks", 2)
                    for name in ("--cost-per-work", "--seconds-per-work"))
        self.assertEqual(old, new)

    def test_seconds_per_work_are_measured_by_default(self):
        done = self.run_it(LONG, "--omega", 0, "--ranks", 1)
        self.assertRegex(done.stderr, r"grove-sim: --seconds-per-work \d")

    def test_table_is_written_without_expanded_nodes(self):
        rows = self.rows(EASY, "--omega", 1, "--ranks", "1,2", "--output", "table.csv")
        self.assertEqual([(row["nodes"], float(row["nodes_overhead"])) for row in rows], [("0", 0)] * 2)
        self.assertTrue((self.folder / "table.csv").exists())

    def test_confine_refuses_absolute_paths(self):
        elsewhere = self.folder / "i.cts.json"
        elsewhere.write_text(json.dumps(json.loads(EASY.read_text()) | {"map": str(DATA / "rooms-32x32.map")}))
        self.refuses(elsewhere, "--confine", because=["/map", "is an absolute path"])

    def test_wrong_arguments_are_refused(self):
        self.refuses("missing.cts.json", because=["missing.cts.json"])
        self.refuses(EASY, "--ranks", "0", because=["--ranks"])
        self.refuses(EASY, "--ranks", "2;3", because=["--ranks"])
        self.refuses(EASY, "--latency", "-1", because=["--latency"])
        self.refuses(ONE_WAY, "--method", "hcbs", because=[ONE_WAY.name, "method hcbs", "two-way roads"])
        self.refuses(EASY, "--method", "cts-cbs-a", because=["cts-cbs-a"])
        self.refuses(EASY, "--output", "no/such/table.csv", because=["no/such"])


if __name__ == "__main__":
    del sys.argv[1]
    unittest.main()
