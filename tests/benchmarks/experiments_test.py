#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests experiments.py and its harness on small maps.

    experiments_test.py [GROVE]    GROVE: the program, build/release/bin/grove by default; tests that run it are skipped
                                   if it does not exist
"""
import csv
import json
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
MAP = "empty-32-32"  # map name in the test folders; the data folder calls it empty-32x32


def row(**values):
    found = dict.fromkeys(runs.COLUMNS) | {"method": "Grove", "map": "m", "agents": 5, "tasks": 9,
                                           "scenario": 1} | values
    return found | {"solved": found["status"] in ("optimal", "bounded") or found["method"] != "Grove"}


class Folder(unittest.TestCase):
    """Provides a folder with one map and two scenarios of 200 rows each."""

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
    def test_scenario_with_enough_rows_is_used_unchanged(self):
        case = Case(MAP, 100, 100, 1)
        self.assertEqual(scenario_with_enough_rows(self.maps, case, self.folder),
                         self.maps.scenario(case))

    def test_short_scenario_is_extended_by_the_next(self):
        longer = scenario_with_enough_rows(self.maps, Case(MAP, 150, 100, 1), self.folder)
        lines = longer.read_text().splitlines()
        self.assertEqual(len(lines), 1 + 400)
        self.assertEqual(sum(line.startswith("version") for line in lines), 1)

    def test_missing_files_are_named(self):
        self.assertIsNone(self.maps.missing(Case(MAP, 5, 9, 1)))
        self.assertEqual(self.maps.missing(Case(MAP, 5, 9, 3)).name, f"{MAP}-random-3.scen")
        self.assertEqual(self.maps.missing(Case("no", 5, 9, 1)).name, "no.map")


class Results(unittest.TestCase):
    def test_time_of_the_first_plan_is_read_from_the_log(self):
        log = ("     expanded   open   memory      time\n"
               "B           0      0     8 MB     0.10s\n"
               "C           3      1     8 MB     1.25s\n"
               "*           9      0     8 MB     2.00s\n")
        self.assertEqual(runs.first_plan_seconds(log), 1.25)
        self.assertIsNone(runs.first_plan_seconds(log[:100]))

    def test_gap_is_relative_to_the_bound(self):
        self.assertEqual(runs.gap(101, 100), 0.01)
        self.assertEqual(runs.gap(0, 0), 0)
        self.assertIsNone(runs.gap(None, 100))
        self.assertIsNone(runs.gap(1, 0))

    def test_ids_of_cases_differ(self):
        cases = [Case("m", 5, None, 1), Case("m", 5, None, 2), Case("m", 5, 9, 1), Case("m", 5, 9, 1, mg=True)]
        self.assertEqual([case.id for case in cases],
                         ["m-random-1-5", "m-random-2-5", "experiments/m_s1_n5_m9", "experiments/m_s1_n5_m9_mg"])
        self.assertEqual([case.problem for case in cases], ["mapf", "mapf", "cts", "mg"])

    def test_within_one_percent_is_computed_exactly(self):
        self.assertTrue(tables.within_one_percent(row(cost=707, lower_bound=700)))
        self.assertFalse(tables.within_one_percent(row(cost=708, lower_bound=700)))
        self.assertFalse(tables.within_one_percent(row(lower_bound=700)))


class Tables(unittest.TestCase):
    def entries(self, text):
        return [[entry.strip() for entry in line.strip("|").split("|")]
                for line in text.splitlines()[2:]]

    def test_table_of_proofs(self):
        rows = [row(status="optimal", cost=10, lower_bound=10, wall_s=1.0),
                row(status="feasible", cost=20, lower_bound=10, wall_s=5.0),
                row(status="unknown", lower_bound=10, wall_s=9.0, agents=7)]
        self.assertEqual(self.entries(tables.proofs(rows)),
                         [["m", "5", "2", "1", "1", "0", "3.00"],
                          ["m", "7", "1", "0", "0", "1", "9.00"],
                          ["all", "", "3", "1", "1", "1", "5.00"]])

    def test_table_of_the_comparison(self):
        rows = [row(status="optimal", wall_s=1.0), row(status="feasible", wall_s=9.0),
                row(method="other", status="feasible", wall_s=2.0),
                row(method="other", status="unknown", wall_s=9.0) | {"solved": False}]
        self.assertEqual(self.entries(tables.comparison(rows)),
                         [["m", "5", "1/2", "1.00", "1/2", "2.00"]])

    def test_ablation_compares_instances_solved_by_both(self):
        solved = {"status": "optimal", "cost": 1, "lower_bound": 1}
        rows = [row(**solved, nodes=9, wall_s=0.999), row(**solved, nodes=9, wall_s=1, scenario=2),
                row(**solved, nodes=39, wall_s=1.999, method="less"),
                row(status="unknown", nodes=999, wall_s=9, scenario=2, method="less")]
        self.assertEqual(self.entries(tables.ablation(rows, "Grove")),
                         [["Grove", "2/2", "2", "2", "2", "1.00", "1.00"],
                          ["less", "1/2", "1", "1", "1", "4.00", "2.00"]])

    def test_tables_without_any_plan(self):
        rows = [row(status="error")]
        for make in (tables.cells, tables.proofs, tables.plans, tables.comparison):
            self.assertEqual(len(make(rows).splitlines()) > 2, True)


class OtherSolvers(Folder):
    def result(self, script, pattern, time_limit=5):
        (self.folder / "solver.py").write_text(script)
        command = f"{sys.executable} {self.folder}/solver.py {{scen}} {{agents}} {{output}}"
        return runs.row_of(runs.Job(runs.OtherSolver(GROVE, "other", command, pattern),
                                    Case(MAP, 7, None, 1), time_limit), self.maps)

    def test_cost_is_read_from_the_output(self):
        found = self.result("import sys\nprint('agents', sys.argv[2], 'cost=123')", r"cost=(\d+)")
        self.assertEqual((found["status"], found["solved"], found["cost"]), ("feasible", True, 123))
        self.assertIs(found["checked"], False)

    def test_cost_is_read_from_the_output_file(self):
        found = self.result("import sys\nopen(sys.argv[3], 'w').write('a,b\\n1,77\\n')",
                            r"^1,(\d+)$")
        self.assertEqual((found["status"], found["solved"], found["cost"]), ("feasible", True, 77))

    def test_output_without_a_match_is_unknown(self):
        found = self.result("print('timeout')", r"cost=(\d+)")
        self.assertEqual((found["status"], found["solved"], found["runtime_s"]), ("unknown", False, 5))

    def test_negative_cost_is_an_error(self):
        found = self.result("print('cost=-1')", r"cost=(-?\d+)")
        self.assertEqual((found["status"], found["error"]), ("error", f"{MAP} 7 scenario 1: claims a cost of -1"))

    def test_missing_program_is_an_error(self):
        job = runs.Job(runs.OtherSolver(GROVE, "other", "/no/such/program", "(x)"), Case(MAP, 7, None, 1), 1)
        self.assertEqual(runs.row_of(job, self.maps)["status"], "error")


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

    def test_paper_experiment_writes_rows_and_tables(self):
        done, rows = self.experiment("paper", "--agents", "2", "3", "--tasks", "4", "--scenarios",
                                     "1", "2", "-j", "2", "--", "--omega", "0")
        self.assertEqual([row["status"] for row in rows], 4 * ["optimal"])
        self.assertTrue(all(row["first_plan_s"] for row in rows))
        self.assertIn("| all |  | 4 | 4 | 4 | 0 |", done.stdout)
        self.assertIn("skipped 4 of 12 cases: ", done.stderr)

    def test_mg_experiment_writes_a_row(self):
        _, rows = self.experiment("paper", "--map", MAP, "--agents", "2", "--tasks", "3",
                                  "--scenarios", "1", "--mg")
        self.assertEqual(len(rows), 1)

    def test_classical_experiment_compares_another_solver(self):
        done, rows = self.experiment(
            "classical", "--scenarios", "1", "--time-limit", "1", "--other", "echo",
            "echo cost 99{agents}", r"cost (\d+)")
        self.assertEqual({row["method"] for row in rows}, {"Grove", "echo"})
        self.assertEqual([row["cost"] for row in rows if row["method"] == "echo"], ["99100", "99150"])
        self.assertIn("echo: solved", done.stdout)
        self.assertIn("2 plans of echo are unchecked claims", done.stderr)

    def test_claims_below_a_proven_bound_are_reported(self):
        # No plan costs less than a proven lower bound, so a lower claimed cost must be false.
        done, rows = self.experiment(
            "classical", "--scenarios", "1", "--time-limit", "1", "--other", "echo",
            "echo cost {agents}", r"cost (\d+)", code=1)
        self.assertIn("\nPROOFS CONTRADICT EACH OTHER", done.stderr)
        bounds = {row["agents"]: row["lower_bound"] for row in rows if row["method"] == "Grove"}
        self.assertIn(f"{MAP}-random-1-100: a plan costs 100 (echo), "
                      f"below a proven lower bound: {bounds['100']} (Grove", done.stderr)
        report = subprocess.run([GROVE, "report", self.folder / "rows.csv", "-o", self.folder / "report"],
                                capture_output=True, text=True, check=False)
        self.assertEqual(report.returncode, 0, report.stderr)
        self.assertIn("proofs contradict each other", report.stderr)

    def with_paths(self, change):
        """Returns the row of a solver that writes Grove's plan after `change` has modified its paths or cost."""
        case = Case(MAP, 5, None, 1)
        (self.folder / "solver.py").write_text(f"""
import json, subprocess, sys
map_file, scen, output = sys.argv[1:]
instance = [scen, "--map", map_file, "--agents", "5"]
subprocess.run(["{GROVE}", "solve", *instance, "--quiet", "--output", "{self.folder}/p.json"], check=True)
plan = json.load(open("{self.folder}/p.json"))
paths = [[(y, x) for x, y in agent["path"]] for agent in plan["agents"]]
cost = plan["cost"]
{change}
with open(output, "w") as file:
    for i, path in enumerate(paths):
        file.write(f"Agent {{i}}: " + "".join(f"({{r}},{{c}})->" for r, c in path) + "\\n")
print("cost", cost)
""")
        command = f"{sys.executable} {self.folder}/solver.py {{map}} {{scen}} {{output}}"
        return runs.row_of(runs.Job(runs.OtherSolver(GROVE, "other", command, r"cost (\d+)"), case, 5), self.maps)

    def test_paths_of_another_solver_are_checked(self):
        row = self.with_paths("")
        self.assertEqual((row["status"], row["checked"]), ("feasible", True), row["error"])
        for change, error in (("cost -= 1", "its paths cost"), ("del paths[0][1]", "jumps"),
                              ("paths[0].pop()", "expected its goal"), ("del paths[4]", "has no path")):
            row = self.with_paths(change)
            self.assertEqual((row["status"], row["solved"]), ("error", False))
            self.assertIn(error, row["error"])
            self.assertIn("claims a plan of cost", row["error"])
            self.assertNotIn("\n", row["error"])

    def test_regex_without_a_group_is_refused(self):
        done = subprocess.run([sys.executable, BENCHMARKS / "experiments.py", "classical", "--other", "x", "y", "z"],
                              capture_output=True, text=True, check=False)
        self.assertIn("--other x: found 'z'; expected a group that is the cost", done.stderr)

    def test_grove_report_reads_the_rows(self):
        self.experiment("paper", "--agents", "2", "--tasks", "4", "--scenarios", "1", "--map", MAP, "--", "--omega",
                        "0")
        subprocess.run([GROVE, "report", self.folder / "rows.csv", "-o", self.folder / "report"], check=True,
                       capture_output=True)
        with open(self.folder / "report/summary_cts.csv", encoding="utf-8") as file:
            row, = csv.DictReader(file)
        self.assertEqual((row["method"], row["omega"], row["solved"], row["within_omega"]), ("Grove", "0", "1", "1"))
        with open(self.folder / "report/search_cts.csv", encoding="utf-8") as file:
            row, = csv.DictReader(file)
        self.assertGreater(int(row["nodes_generated"]), 0)
        self.assertNotIn("seed", row)

    def test_ablation_runs_without_each_technique(self):
        names = experiments.technique_names(GROVE)
        self.assertGreater(len(names), 2)
        done, rows = self.experiment("ablation", "--agents", "2", "--tasks", "3", "--scenarios", "1")
        self.assertEqual({row["method"] for row in rows},
                         {"Grove", *(f"without {name}" for name in names)})
        self.assertNotIn("error", [row["status"] for row in rows])

    def test_ablation_of_instances_in_a_folder(self):
        (self.folder / "line.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
        (self.folder / "line.cts.json").write_text(json.dumps(
            {"map": "line.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}], "tasks": []}))
        done, rows = self.experiment("ablation", "--technique", "primal", "--instances", self.folder)
        self.assertEqual([(row["instance"], row["method"], row["status"], row["cost"]) for row in rows],
                         [("line", "Grove", "optimal", "2"), ("line", "without primal", "optimal", "2")])

    def test_failures_are_rows_and_set_the_exit_code(self):
        done, rows = self.experiment("paper", "--agents", "2", "--tasks", "3", "--scenarios", "1",
                                     "--", "--no-such-option", code=1)
        self.assertEqual([row["status"] for row in rows], ["error"])
        self.assertIn("--no-such-option", done.stderr)

    def test_experiments_without_instances_fail(self):
        self.experiment("large", code=1)
        self.experiment("crowded", code=1)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        GROVE = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
