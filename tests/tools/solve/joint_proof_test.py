#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the warning about certificates that consist of a joint search only.

    joint_proof_test.py GROVE
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest


def corridor(goals):
    return {"agents": [{"id": f"a{i}", "start": [3 * i, 0], "goal": [x, 0]} for i, x in enumerate(goals)], "tasks": []}


DENSE = {"agents": [{"id": f"a{i}", "start": start, "goal": goal} for i, (start, goal) in enumerate(
    [([3, 0], [3, 3]), ([0, 0], [2, 3]), ([1, 0], [0, 2]), ([2, 0], [1, 0]), ([3, 2], [1, 1]), ([1, 3], [3, 0])])],
    "tasks": [{"id": f"t{i}", "cell": cell, "agents": agents} for i, (cell, agents) in enumerate(
        [([1, 3], ["a3"]), ([3, 0], ["a0", "a2"]), ([0, 2], ["a5"]), ([1, 0], ["a3"]), ([1, 1], ["a3"])])]}


class JointProof(unittest.TestCase):
    grove = ""

    def solve(self, rows, instance):
        """Solves the instance and returns standard error and the plan file."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "m.map").write_text(f"type octile\nheight {len(rows)}\nwidth {len(rows[0])}\nmap\n"
                                          + "\n".join(rows) + "\n")
            (folder / "i.cts.json").write_text(json.dumps({"map": "m.map", **instance}))
            done = subprocess.run([self.grove, "solve", "i.cts.json", "--omega", "0", "--threads", "1", "--quiet",
                                   "--proof", "c.proof", "-o", "p.json"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stderr, json.loads((folder / "p.json").read_text())

    def test_warning_without_a_joint_search(self):
        stderr, plan = self.solve(["." * 60], corridor([50, 1]))
        self.assertEqual(plan["status"], "infeasible")
        self.assertIn("c.proof: the proof is a joint search of all agents that Grove did not need", stderr)

    def test_warning_with_a_joint_search(self):
        stderr, plan = self.solve(["....", "@..@", "..@.", "...."], DENSE)
        self.assertIn("0 splits, 0 leaves", plan["stats"]["proof"])
        self.assertIn(f"the search had {plan['stats']['joint_states']} joint states", stderr)

    def test_no_warning_of_a_tree_search_proof(self):
        stderr, plan = self.solve(["." * 6, "." * 6], corridor([4, 1]))
        self.assertEqual(plan["status"], "optimal")
        self.assertNotIn("joint search", stderr)


if __name__ == "__main__":
    JointProof.grove = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
