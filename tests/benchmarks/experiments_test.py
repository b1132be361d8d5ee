#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The experiments' scripts, on maps of our own making.

    experiments_test.py GROVE    GROVE: the program; without it, what runs it is skipped
"""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

import experiments  # noqa: E402
from harness import runs, tables  # noqa: E402
from harness.instances import Case, Maps, scenario_with_enough_rows  # noqa: E402

GROVE = pathlib.Path("build/release/bin/grove")
DATA = BENCHMARKS / "data"
MAP = "empty-32-32"  # what the folders of the tests call the one of the data folder


def row(**values):
    return dict.fromkeys(runs.COLUMNS) | {"solver": "grove", "map": "m", "agents": 5, "tasks": 9,
                                          "scenario": 1} | values


class Folder(unittest.TestCase):
    """Tests with a folder of maps: one map, two scenarios of 200 rows."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(DATA / "empty-32x32.map", self.folder / f"{MAP}.map")
        rows = (DATA / "empty-32x32.scen").read_text().replace("empty-32x32", MAP).splitlines()
        for number, order in ((1, 1), (2, -1)):
            (self.folder / f"{MAP}-random-{number}.scen").write_text(
                "\n".join([rows[0], *rows[1:][::order]]) + "\n")
        self.maps = Maps(self.folder)


class Instances(Folder):
    def test_a_long_enough_scenario_is_used_as_it_is(self):
        case = Case(MAP, 100, 100, 1)
        self.assertEqual(scenario_with_enough_rows(self.maps, case, self.folder),
                         self.maps.scenario(case))

    def test_a_short_one_is_followed_by_the_next(self):
        longer = scenario_with_enough_rows(self.maps, Case(MAP, 150, 100, 1), self.folder)
        lines = longer.read_text().splitlines()
        self.assertEqual(len(lines), 1 + 400)
        self.assertEqual(sum(line.startswith("version") for line in lines), 1)

    def test_missing_files(self):
        self.assertIsNone(self.maps.missing(Case(MAP, 5, 9, 1)))
        self.assertEqual(self.maps.missing(Case(MAP, 5, 9, 3)).name, f"{MAP}-random-3.scen")
        self.assertEqual(self.maps.missing(Case("no", 5, 9, 1)).name, "no.map")


class Results(unittest.TestCase):
    def test_first_plan(self):
        log = ("     expanded   open   memory      time\n"
               "B           0      0     8 MB     0.10s\n"
               "C           3      1     8 MB     1.25s\n"
               "*           9      0     8 MB     2.00s\n")
        self.assertEqual(runs.first_plan_seconds(log), 1.25)
        self.assertIsNone(runs.first_plan_seconds(log[:100]))

    def test_gap(self):
        self.assertEqual(runs.gap_percent(101, 100), 1)
        self.assertEqual(runs.gap_percent(0, 0), 0)
        self.assertIsNone(runs.gap_percent(None, 100))
        self.assertIsNone(runs.gap_percent(1, 0))

    def test_within_one_percent_is_exact(self):
        self.assertTrue(tables.within_one_percent(row(cost=707, lower_bound=700)))
        self.assertFalse(tables.within_one_percent(row(cost=708, lower_bound=700)))
        self.assertFalse(tables.within_one_percent(row(lower_bound=700)))


class Tables(unittest.TestCase):
    def entries(self, text):
        return [[entry.strip() for entry in line.strip("|").split("|")]
                for line in text.splitlines()[2:]]

    def test_proofs(self):
        rows = [row(status="optimal", cost=10, lower_bound=10, seconds=1.0),
                row(status="feasible", cost=20, lower_bound=10, seconds=5.0),
                row(status="unknown", lower_bound=10, seconds=9.0, agents=7)]
        self.assertEqual(self.entries(tables.proofs(rows)),
                         [["m", "5", "2", "1", "1", "0", "3.00"],
                          ["m", "7", "1", "0", "0", "1", "9.00"],
                          ["all", "", "3", "1", "1", "1", "5.00"]])

    def test_comparison(self):
        rows = [row(status="optimal", seconds=1.0), row(status="feasible", seconds=9.0),
                row(solver="other", status="solved", seconds=2.0),
                row(solver="other", status="unknown", seconds=9.0)]
        self.assertEqual(self.entries(tables.comparison(rows)),
                         [["m", "5", "1/2", "1.00", "1/2", "2.00"]])

    def test_ablation_compares_what_both_solved(self):
        solved = {"status": "optimal", "cost": 1, "lower_bound": 1}
        rows = [row(**solved, nodes=9, seconds=0.999), row(**solved, nodes=9, seconds=1, scenario=2),
                row(**solved, nodes=39, seconds=1.999, solver="less"),
                row(status="unknown", nodes=999, seconds=9, scenario=2, solver="less")]
        self.assertEqual(self.entries(tables.ablation(rows, "grove")),
                         [["grove", "2/2", "2", "2", "2", "1.00", "1.00"],
                          ["less", "1/2", "1", "1", "1", "4.00", "2.00"]])

    def test_no_plan_at_all(self):
        rows = [row(status="failed")]
        for make in (tables.cells, tables.proofs, tables.plans, tables.comparison):
            self.assertEqual(len(make(rows).splitlines()) > 2, True)


class OtherSolvers(Folder):
    def result(self, script, pattern, time_limit=5):
        (self.folder / "solver.py").write_text(script)
        command = f"{sys.executable} {self.folder}/solver.py {{scen}} {{agents}} {{output}}"
        return runs.row_of(runs.Job(runs.OtherSolver("other", command, pattern),
                                    Case(MAP, 7, None, 1), time_limit), self.maps)

    def test_cost_from_the_output(self):
        found = self.result("import sys\nprint('agents', sys.argv[2], 'cost=123')", r"cost=(\d+)")
        self.assertEqual((found["status"], found["cost"]), ("solved", 123))

    def test_cost_from_its_file(self):
        found = self.result("import sys\nopen(sys.argv[3], 'w').write('a,b\\n1,77\\n')",
                            r"^1,(\d+)$")
        self.assertEqual((found["status"], found["cost"]), ("solved", 77))

    def test_no_match_is_no_plan(self):
        self.assertEqual(self.result("print('timeout')", r"cost=(\d+)")["status"], "unknown")

    def test_a_program_that_is_not_there(self):
        job = runs.Job(runs.OtherSolver("other", "/no/such/program", "x"), Case(MAP, 7, None, 1), 1)
        self.assertEqual(runs.row_of(job, self.maps)["status"], "failed")


class WithTheProgram(Folder):
    def setUp(self):
        if not GROVE.exists():
            self.skipTest(f"there is no {GROVE}")
        super().setUp()

    def experiment(self, *words, code=0):
        done = subprocess.run(
            [sys.executable, BENCHMARKS / "experiments.py", words[0], "--grove", GROVE, "--maps",
             self.folder, "--csv", self.folder / "rows.csv", *words[1:]],
            capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        with open(self.folder / "rows.csv", newline="", encoding="utf-8") as file:
            return done, list(csv.DictReader(file))

    def test_paper(self):
        done, rows = self.experiment("paper", "--agents", "2", "3", "--tasks", "4", "--scenarios",
                                     "1", "2", "-j", "2", "--", "--omega", "0")
        self.assertEqual([row["status"] for row in rows], 4 * ["optimal"])
        self.assertTrue(all(row["first_plan_s"] for row in rows))
        self.assertIn("| all |  | 4 | 4 | 4 | 0 |", done.stdout)
        self.assertIn("skipped 4 of 12 cases: there is no", done.stderr)

    def test_mg(self):
        _, rows = self.experiment("paper", "--map", MAP, "--agents", "2", "--tasks", "3",
                                  "--scenarios", "1", "--mg")
        self.assertEqual(len(rows), 1)

    def test_classical_beside_another_solver(self):
        done, rows = self.experiment(
            "classical", "--scenarios", "1", "--time-limit", "1", "--other", "echo",
            "echo cost {agents}", r"cost (\d+)")
        self.assertEqual({row["solver"] for row in rows}, {"grove", "echo"})
        self.assertEqual([row["cost"] for row in rows if row["solver"] == "echo"], ["100", "150"])
        self.assertIn("echo: solved", done.stdout)

    def test_ablation_knows_all_techniques(self):
        names = experiments.technique_names(GROVE)
        self.assertGreater(len(names), 2)
        done, rows = self.experiment("ablation", "--agents", "2", "--tasks", "3", "--scenarios", "1")
        self.assertEqual({row["solver"] for row in rows},
                         {"grove", *(f"without {name}" for name in names)})
        self.assertNotIn("failed", [row["status"] for row in rows])

    def test_failures_are_rows_and_an_exit_code(self):
        done, rows = self.experiment("paper", "--agents", "2", "--tasks", "3", "--scenarios", "1",
                                     "--", "--no-such-option", code=1)
        self.assertEqual([row["status"] for row in rows], ["failed"])
        self.assertIn("--no-such-option", done.stderr)

    def test_nothing_to_run(self):
        self.experiment("large", code=1)
        self.experiment("crowded", code=1)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        GROVE = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
