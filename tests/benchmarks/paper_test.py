#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the experiments of the paper on a few instances: all runs are present, proofs agree, and later runs add
instances.

    paper_test.py GROVE
"""
import csv
import itertools
import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from waiting import HANG_S, wait_until  # noqa: E402

PAPER = Path(__file__).resolve().parent.parent.parent / "benchmarks/paper.py"
GROVE = None
METHODS = {"auto", "cts-cbs-a", "cts-cbs-b", "cts-cbs-c", "optimal-cbs", "hcbs", "mgcbs", "s-cbs"}
STUDY = {"auto", "cts-cbs_0", "cts-cbs_0.01", "cts-cbs_0.1", "cts-cbs_inf"}


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Paper(unittest.TestCase):
    def run_paper(self, folder, *options):
        done = subprocess.run([sys.executable, PAPER, folder, "--grove", GROVE, "--scenarios", "1", "--tasks", "4",
                               "--time-limit", "0.3", *options], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_results_are_extended_with_more_agents(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for agents in ("2", "2,3"):
                self.run_paper(folder, "--agents", agents)
                comparison, study = (rows(folder / f"{part}/results.csv") for part in ("comparison", "study"))
                self.assertEqual({(row["method"], row["agents"]) for row in comparison},
                                 set(itertools.product(METHODS, agents.split(","))))
                self.assertEqual({row["problem"] for row in comparison}, {"mg"})
                self.assertEqual({row["method"] for row in study}, STUDY)
                self.assertEqual({(row["problem"], row["agents"]) for row in study}, {("cts", "2")})
                self.assertTrue(all(row["map"].startswith("room") for row in study))
                self.assertEqual(rows(folder / "report/contradictions.csv"), [])
                self.assertTrue((folder / "report/omega_study.svg").exists())

    def test_other_settings_in_the_same_folder_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "settings.json").write_text('{"movingai": null, "time_limit": 3.0}')
            error = self.refused(name, "--time-limit", "2", "--grove", GROVE)
            self.assertIn("expected the same maps and time limit, or another folder", error)

    def test_missing_program_is_an_error(self):
        with tempfile.TemporaryDirectory() as name:
            self.assertIn("tools/quickstart", self.refused(name, "--grove", "/no/such/grove"))
            self.assertFalse((Path(name) / "settings.json").exists())  # written after the instances

    def test_signals_reach_the_bench(self):
        with tempfile.TemporaryDirectory() as name:
            running = subprocess.Popen([sys.executable, PAPER, name, "--grove", GROVE, "--agents", "20", "--tasks",
                                        "50"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            wait_until("a run", (Path(name) / "comparison/.running").exists, running)
            running.send_signal(signal.SIGTERM)
            _, err = running.communicate(timeout=HANG_S)
            self.assertEqual(running.returncode, 130, err)
            self.assertIn("repeat the command to resume", err)
            self.assertNotIn("Traceback", err)

    def refused(self, *arguments):
        done = subprocess.run([sys.executable, PAPER, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.stderr


if __name__ == "__main__":
    GROVE = Path(sys.argv.pop(1)).resolve()
    os.environ.pop("GROVE_MOVINGAI", None)  # so that the test uses generated maps
    unittest.main()
