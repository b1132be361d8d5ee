#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the command `grove report`: files, messages, exit codes and run time.

    program_test.py GROVE
"""
import base64
import contextlib
import csv
import io
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import synthetic  # noqa: E402

GROVE = Path("build/release/bin/grove")
FIGURES = ["cactus_cts", "cactus_mg", "comparison_cts", "comparison_mg", "omega_study", "splits_cts", "splits_mg"]
TABLES = ["common_cts", "common_mg", "comparison_cts", "comparison_mg", "contradictions", "false_claims", "omega_study",
          "only_solver_cts", "only_solver_mg", "search_cts", "search_mg", "speedup_cts", "speedup_mg", "summary_cts",
          "summary_mg"]
MAX_SECONDS = 30  # limit on processor time: 5 s on an idle machine, more than twice that on a busy one


def few(scenarios, **options):
    """Returns rows of only a few configurations and methods, because each adds panels to draw."""
    found = synthetic.rows(scenarios, **({"maps": ("room-32-32-4",), "agents": (5,), "tasks": (10, 30)} | options))
    return (row for row in found if row["method"] not in ("cts-cbs-b", "cts-cbs-c", "optimal-cbs"))


def run(*arguments, program=None, **options):
    return subprocess.run([str(program or GROVE), "report", *map(str, arguments)], capture_output=True,
                          text=True, check=False, **options)


def run_here(*arguments):
    """Runs `grove report` in this process, because starting Python and matplotlib takes longer than most reports."""
    if str(GROVE.parent) not in sys.path:
        sys.path.insert(0, str(GROVE.parent))
    from grove_report.cli import main
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        code = main([str(each) for each in arguments])
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), err.getvalue())


class Elements(HTMLParser):
    """Collects the references in a page and checks that every element is closed."""

    EMPTY = {"meta", "link", "img", "br"}

    def __init__(self, text):
        super().__init__()
        self.references, self.open, self.balanced = [], [], True
        self.downloads = {}  # {file name: data URL}
        self.feed(text)
        self.balanced &= not self.open

    def handle_starttag(self, tag, attributes):
        self.references += [value for name, value in attributes if name in ("src", "href", "srcset")]
        if "download" in dict(attributes):
            self.downloads[dict(attributes)["download"]] = dict(attributes)["href"]
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        self.balanced &= bool(self.open) and self.open.pop() == tag


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def results(self, found, name="results.jsonl"):
        path = self.folder / name
        (synthetic.write_csv if name.endswith(".csv") else synthetic.write_jsonl)(path, found)
        return path

    def report(self, *arguments, run=run_here, **options):
        """Runs a report and returns its page and stderr."""
        done = run(*arguments, "-o", self.folder / "out", **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, f"^wrote {self.folder}/out/report.html: [1-9][0-9]* rows\n$")
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        self.assert_files_are_there(page)
        return page, done.stderr

    def assert_files_are_there(self, page):
        """Checks that each download of the page equals its file, and that the page names no other file."""
        for name, content in Elements(page).downloads.items():
            kind, data = content.split(",")
            self.assertEqual(kind, "data:text/csv;base64")
            self.assertEqual(base64.b64decode(data), (self.folder / "out" / name).read_bytes())
            page = page.replace(f">{name}</a>", "")
        shown = re.sub(r'="[^"]*"', "", page)
        self.assertEqual(set(re.findall(r"[\w-]+\.(?:csv|png|svg)", shown)) - {"results.csv", "empty-32-32.csv"}, set())

    def table(self, name):
        with (self.folder / f"out/{name}.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def error_of(self, *arguments, run=run_here, **options):
        done = run(*arguments, **options)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        start = "grove: error: "
        self.assertTrue(done.stderr.startswith(start) and done.stderr.count("\n") == 1, done.stderr)
        return done.stderr[len(start):-1].replace(f"{self.folder}/", "")


class Reports(Folder):
    def test_report_writes_all_files_and_a_self_contained_page(self):
        page, stderr = self.report(self.results(few(2)))
        self.assertEqual(stderr, "")
        expected = [f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")]
        expected += [f"{name}.csv" for name in TABLES] + ["report.html"]
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir()), sorted(expected))
        for name in FIGURES:
            xml.etree.ElementTree.parse(self.folder / f"out/{name}.svg")
            self.assertEqual((self.folder / f"out/{name}.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        elements = Elements(page)
        self.assertTrue(elements.balanced)
        self.assertEqual(sorted(elements.downloads),
                         sorted(f"{name}.csv" for name in TABLES if name not in ("contradictions", "false_claims")))
        self.assertEqual(sum(each.startswith("data:image/svg") for each in elements.references), len(FIGURES))
        for reference in elements.references:
            self.assertTrue(reference.startswith(("data:", "#")), reference[:80])
        self.assertNotIn("<script", page)
        self.assertNotIn("url(", page)

    def test_figures_of_an_earlier_report_are_removed(self):
        self.report(self.results(few(1, tasks=(10,))))
        others = [self.folder / "out" / name for name in ("notes.csv", "comparison_mg.txt", "my_cactus_mg.png")]
        for other in others:
            other.write_text("mine")
        (self.folder / "out/comparison_mg_2.png").write_text("many maps")
        self.report(self.results([row for row in few(1, tasks=(10,)) if row["problem"] == "cts"]))
        left = {path.name for path in (self.folder / "out").iterdir()}
        self.assertLessEqual({other.name for other in others}, left)
        self.assertEqual({name for name in left if "_mg" in name}, {"comparison_mg.txt", "my_cactus_mg.png"})
        self.assertIn("omega_study.png", left)

    def test_omega_study_includes_groves_default_search(self):
        study = [row for row in few(1) if row["problem"] == "cts"]
        found = study + [row | {"method": "auto", "options": "--omega 0", "omega": "0"} for row in study
                         if row["omega"] == "0"]
        page, _ = self.report(self.results(found))
        self.assertEqual({(row["method"], row["omega"]) for row in self.table("omega_study")},
                         {("auto", "0")} | {(f"cts-cbs-w{omega}", omega) for omega in synthetic.OMEGAS})
        self.assertIn(">Grove, ω = 0</td>", page)
        self.assertNotRegex(page, r">auto\b")

    def test_tables_agree_with_the_rows(self):
        found = list(few(4, agents=(20,)))
        self.report(self.results(found))
        group = [row for row in found if (row["problem"], row["method"], row["map"], row["agents"],
                                         row["tasks"]) == ("mg", "hcbs", "room-32-32-4", 20, 30)]
        entry, = [row for row in self.table("comparison_mg")
                  if (row["method"], row["map"], row["agents"], row["tasks"])
                  == ("hcbs", "room-32-32-4", "20", "30")]
        self.assertEqual(int(entry["solved"]), sum(row["solved"] for row in group))
        self.assertAlmostEqual(float(entry["mean_runtime_s"]),
                               sum(row["runtime_s"] for row in group) / len(group), places=2)
        self.assertEqual({row["omega"] for row in self.table("omega_study")}, {"0", "0.01", "0.1", "inf"})

    def test_page_and_file_list_every_cell_and_method(self):
        page, _ = self.report(self.results([row for row in few(1) if row["problem"] == "mg"]))
        table = page.split("Table: every configuration (map, N, M) and method</summary>")[1].split("</details>")[0]
        self.assertEqual(table.count("<tr>"), 1 + len(self.table("comparison_mg")))
        for column in ("success rate", "median s (failures = limit)", "mean SQR (solved runs)"):
            self.assertIn(f">{column}</th>", table)
        self.assertLessEqual({"success_rate", "median_runtime_s", "mean_sqr", "mean_cost_ratio"},
                             set(self.table("comparison_mg")[0]))

    def test_unproven_results_are_reported(self):
        first = next(few(1)) | {"solved": True, "runtime_s": 1, "lower_bound": 100, "root_cost": 100}
        found = [first | {"instance": name, "method": method, "omega": omega, "status": status, "cost": cost}
                 for name, method, omega, status, cost in (
                     ("p", "near", "0.01", "feasible", 107), ("q", "near", "0.01", "feasible", 103),
                     ("r", "near", "0.01", "optimal", 120), ("p", "any", "inf", "feasible", 105),
                     ("q", "any", "inf", "optimal", 102), ("p", "exact", "0", "optimal", 104))]
        page, _ = self.report(self.results(found))
        for text in ("(ω = 0: exact; ω = 0.01: near; ω = ∞: any)",
                     "near, ω = 0.01: 2 of 3 solved runs are outside ω (status feasible)",
                     "any, ω = ∞: no guarantee; 1 of 2 solved runs are not proven optimal (status feasible)"):
            self.assertIn(text, page)
        self.assertNotIn("of 1 solved runs", page)  # the method "exact" has no such run
        within = {row["method"]: row["within_omega"] for row in self.table("summary_mg")}
        self.assertEqual(within, {"near": "1", "any": "", "exact": "1"})
        ratios = {row["method"]: row["mean_cost_ratio"] for row in self.table("summary_mg")}
        # Best costs: p 104, q 102, r 120.
        self.assertEqual(ratios, {"near": f"{(107 / 104 + 103 / 102 + 1) / 3:.6g}",
                                  "any": f"{(105 / 104 + 1) / 2:.6g}", "exact": "1"})

    def test_equal_rows_give_identical_files(self):
        """Compares reports on the same rows as JSON and CSV, in different orders and with different seeds of hash()."""
        found, reports = list(few(1)), []
        for name, seed in (("results.jsonl", "1"), ("results.csv", "2")):
            page, _ = self.report(self.results(found, name), run=run, env={**os.environ, "PYTHONHASHSEED": seed})
            (self.folder / "out/report.html").write_text(page.replace(name, "results"), encoding="utf-8")
            reports.append({each.name: each.read_bytes() for each in (self.folder / "out").iterdir()})
            shutil.rmtree(self.folder / "out")
            random.Random(1).shuffle(found)
        self.assertEqual(reports[0].keys(), reports[1].keys())
        for name, content in reports[0].items():
            self.assertTrue(content == reports[1][name], name)

    def test_search_counters_are_reported(self):
        first, second = [row for row in few(2, tasks=(10,), study=False) if row["method"] == "auto"]
        found = [first | {"counts": "bypasses=5 prices_asked=30 prices_known=10 splits_bar=3 splits_new_kind=1"},
                 second | {"counts": "bypasses=8 prices_asked=10 prices_known=10 splits_bar=5", "solved": False},
                 first | {"method": "without counters", "counts": None}]
        page, _ = self.report(self.results(found))
        self.assertEqual(self.table("search_mg"), [
            {"method": "auto", "omega": "0.01", "time_limit_s": "180", "runs": "2", "bypasses": "13",
             "branching_cost_queries": "40", "branching_cost_hits": "20", "splits_vertex_edge": "8",
             "splits_new_kind": "1"}])
        table = page.split("Table: other counters</summary>")[1].split("</details>")[0]
        self.assertEqual(re.findall(r'<td>([^<]*)</td><td class="number">([^<]*)', table),
                         [("bypasses: another path of the same cost", "6.5"),
                          ("costs with one more constraint (strong branching): share of cache hits", "50 %")])
        self.assertIn('alt="What nodes were split on"', page)
        # Older tables lack some counters, and baselines have none.
        for counts in ("bypasses=1 splits_bar=0", None):
            page, _ = self.report(self.results([row | {"counts": counts} for row in found]))
            self.assertNotIn("What nodes were split on", page)
            self.assertEqual("Search counters" in page, counts is not None)
            self.assertEqual((self.folder / "out/search_mg.csv").exists(), counts is not None)

    def test_contradictions_are_reported_with_a_warning(self):
        found = list(few(1, study=False, tasks=(10,)))
        page, _ = self.report(self.results(found))
        self.assertNotIn("CONTRADICT", page)
        self.assertIn("No proofs contradict each other", page)
        first = next(row for row in found if row["method"] == "hcbs" and row["solved"])
        found.append(first | {"method": "other", "cost": first["cost"] + 1, "lower_bound": first["cost"] + 1})
        page, stderr = self.report(self.results(found))
        self.assertIn("PROOFS CONTRADICT EACH OTHER on 1 instance<", page)
        self.assertIn(f"optimal costs differ: {first['cost']} (", page)
        self.assertTrue(stderr.startswith("grove: warning: proofs contradict each other"), stderr)
        self.assertEqual({row["instance"] for row in self.table("contradictions")}, {first["instance"]})

    def test_several_limits_and_seeds_are_reported(self):
        found = [row for row in few(1, study=False) if row["omega"] == "0"]
        page, _ = self.report(self.results(found))
        self.assertNotIn("Before you compare", page)
        self.assertNotIn("The influence", page)  # only one limit and seed
        more = [row | {"time_limit_s": 999} for row in found if row["method"] == "mgcbs"]
        more += [row | {"seed": 7, "version": "grove 9", "instance_digest": "f00"} for row in found
                 if row["method"] == "hcbs"]
        path = self.results(found + more)
        with path.open("a", encoding="utf-8") as file:
            file.write('{"instance": "room')
        page, _ = self.report(path)
        for text in ("the last line is cut off", "One name stands for several instances",
                     "several time limits (180 s, 999 s)", "several seeds (0, 7)", "several versions",
                     "mgcbs, limit 999 s"):
            self.assertIn(text, page)

    def test_missing_configurations_are_reported(self):
        found = [row for row in few(1, study=False) if row["method"] != "hcbs" or row["tasks"] != 30]
        page, _ = self.report(self.results(found))
        self.assertIn("not every method was run on all 2 instances (hcbs, ω = 0: 1)", page)
        self.assertNotIn(("hcbs", "30"), {(row["method"], row["tasks"])
                                          for row in self.table("comparison_mg")})

    def test_names_are_escaped_in_html(self):
        name = "<b>$\\alpha$</b>_&\"'"
        found = [row | {"method": name, "map": "<i>", "error": "<u>", "status": "error", "solved": False,
                        "cost": None, "sqr": None} for row in few(1, study=False)]
        page, stderr = self.report(self.results(found))
        self.assertEqual(stderr, "")
        for tag in ("<i>", "<u>", "<b>$"):
            self.assertNotIn(tag, page)
        self.assertTrue(Elements(page).balanced)

    def test_required_columns_suffice(self):
        row = next(few(1))
        needed = ["instance", "method", "map", "agents", "tasks", "problem", "time_limit_s", "solved", "status",
                  "cost", "runtime_s"]
        for found in (row, row | {"solved": False, "cost": None, "status": "unknown"},
                      row | {"problem": "mapf", "tasks": 0, "runtime_s": 0},
                      row | {"time_limit_s": 0.001, "runtime_s": 0.002}):
            path = self.results([{name: found[name] for name in needed}])
            self.assertEqual(self.report(path)[1], "")

    def test_baselines_are_selected_by_name(self):
        path = self.results(few(3, study=False))
        self.report(path, "--baseline", "cts-cbs-a, hcbs")
        self.assertEqual({row["baseline"] for row in self.table("speedup_mg")},
                         {"best baseline", "cts-cbs-a", "hcbs"})

    def test_results_of_other_solvers_are_reported(self):
        """Checks success rates, quality over time, seeds as repetitions, and commonly solved instances."""
        found = list(synthetic.solver_rows(3, agents=(20, 60, 100)))
        found.append(found[0]
                     | {"method": "turns", "solver": "mine", "status": "unsuitable", "solved": False, "cost": None,
                        "trace": None, "error": "robots that turn"})
        page, stderr = self.report(self.results(found))
        self.assertEqual(stderr, "")
        for text in ('alt="Success rate over the number of agents"', 'alt="Quality over time"',
                     "<h3>Instances that all methods solve",
                     "Guarantees of other solvers are not checked here (eecbs, lacam, lns)", "several seeds (1, 2)",
                     "turns does not support 1 of the instances, which are omitted for it: robots that turn."):
            self.assertIn(text, page)
        for name in ("success_mapf", "anytime_mapf"):
            self.assertTrue((self.folder / f"out/{name}.svg").exists())
        entry, = [row for row in self.table("success_mapf") if (row["map"], row["agents"], row["method"])
                  == ("random-32-32-20", "100", "eecbs")]
        group = [row for row in found
                 if (row["map"], row["agents"], row["method"]) == ("random-32-32-20", 100, "eecbs")]
        self.assertEqual((entry["instances"], entry["seeds"], entry["runs"]), ("3", "2", "6"))
        self.assertEqual(entry["success_rate"], f"{sum(row['solved'] for row in group) / 6:.6g}")
        # Methods that do not improve their plans have no curve over time.
        curves = self.table("anytime_mapf")
        self.assertEqual({row["method"] for row in curves}, {"auto", "lacam", "lns"})
        last = [row for row in curves if (row["panel"], row["method"], row["time_s"]) == ("empty-32-32", "lns", "30")]
        costs = [row for row in found if row["map"] == "empty-32-32" and row["cost"]]
        best = {name: min(row["cost"] for row in costs if row["instance"] == name)
                for name in {row["instance"] for row in costs}}
        ratios = [row["cost"] / best[row["instance"]] for row in costs if row["method"] == "lns"]
        self.assertEqual((last[0]["common"], last[0]["mean_cost_ratio"]), ("9", f"{sum(ratios) / 18:.6g}"))
        common = self.table("common_mapf")
        self.assertEqual({row["method"] for row in common if row["agents"] == "20"}, {"auto", "eecbs", "lacam", "lns"})
        # Without the weakest method, more instances are solved by all methods.
        self.report(self.results(found), "--method", "Grove,lacam,lns")
        self.assertEqual({row["method"] for row in self.table("summary_mapf")}, {"auto", "lacam", "lns"})
        self.assertGreater(sum(int(row["common"]) for row in self.table("common_mapf")) / 3,
                           sum(int(row["common"]) for row in common) / 4)

    def test_false_claims_are_reported_with_a_warning(self):
        found = list(synthetic.solver_rows(1, maps=("empty-32-32",), agents=(20, 40)))
        page, _ = self.report(self.results(found))
        self.assertNotIn("FALSE CLAIMS", page)
        first, second, third, fourth = [row for row in found if row["method"] == "eecbs"]
        first.update(status="wrong", solved=False, cost=None,
                     error="the plan is wrong: agents 3 and 7 collide at time 12")
        second["claimed_cost"] -= 1
        third["claimed_lower_bound"] = 10**6
        fourth.update(status="claimed", solved=False, cost=None, error="claims a plan without writing one")
        page, stderr = self.report(self.results(found))
        self.assertEqual(stderr, "grove: warning: solvers make false claims (3 times); see "
                                 f"{self.folder}/out/false_claims.csv\n")
        self.assertIn("FALSE CLAIMS: 3<", page)
        for text in (f"eecbs seed 1: mapf: {first['instance']}: the plan is wrong: agents 3 and 7 collide at time 12",
                     f"says that its plan costs {second['claimed_cost']}; recounted: {second['cost']}",
                     "says that no plan costs less than 1000000; a checked plan costs "):
            self.assertIn(text, page)
        self.assertEqual([(row["method"], row["kind"]) for row in self.table("false_claims")],
                         [("eecbs", "plan"), ("eecbs", "cost"), ("eecbs", "lower bound")])
        entry, = [row for row in self.table("summary_mapf") if row["method"] == "eecbs"]
        self.assertEqual((entry["invalid"], entry["claimed"], entry["solved"]), ("1", "1", "2"))
        self.assertIn(">only claimed</th>", page)

    def test_logs_of_runs_are_reported(self):
        """Checks reports on logs of `grove solve`, without a table of results and in a folder with one."""
        instance = Path(__file__).resolve().parents[3] / "benchmarks/data/rooms-32x32_n5_m10.cts.json"
        for seed in (1, 2):
            subprocess.run([str(GROVE), "solve", str(instance), "--omega", "0", "--seed", str(seed), "--threads", "1",
                            "--quiet",
                            "--log", f"seed-{seed}.jsonl", "--log-format", "jsonl", "--output", f"{seed}.plan.json"],
                           cwd=self.folder, check=True)
        done = run_here(self.folder, "-o", self.folder / "out")
        self.assertEqual((done.returncode, done.stdout), (0, f"wrote {self.folder}/out/report.html: 2 logs\n"),
                         done.stderr)
        rows = self.table("runs")
        self.assertEqual({row["log"] for row in rows}, {"seed-1", "seed-2"})
        for name in ("seed-1", "seed-2"):
            last = [row for row in rows if row["log"] == name][-1]
            self.assertEqual((last["status"], last["cost"]), ("optimal", last["lower_bound"]))
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        self.assert_files_are_there(page)
        self.assertTrue(Elements(page).balanced)
        self.assertIn('alt="Bound and plan of single runs"', page)
        self.assertIn('alt="Sources of the lower bound"', page)
        sources = self.table("bound_sources")
        for name in ("seed-1", "seed-2"):
            last = [row for row in rows if row["log"] == name][-1]
            self.assertEqual(sum(int(row["steps"]) for row in sources if row["log"] == name), int(last["lower_bound"]))
        self.assertNotIn("Source of the rows", page)
        self.results(few(1, study=False, tasks=(10,)))
        done = run_here(self.folder, "-o", self.folder / "out")
        self.assertRegex(done.stdout, ": [0-9]+ rows, 2 logs\n$")

    def test_figures_of_logs_have_at_most_thirty_panels(self):
        instance = Path(__file__).resolve().parents[3] / "benchmarks/data/rooms-32x32_n5_m10.cts.json"
        subprocess.run([str(GROVE), "solve", str(instance), "--omega", "0", "--threads", "1", "--quiet",
                        "--log", "a.jsonl", "--log-format", "jsonl"], cwd=self.folder, check=True)
        log = (self.folder / "a.jsonl").read_text(encoding="utf-8")
        self.assertIn(f'"instance":"{instance}"', log)
        for number in range(30):
            other = log.replace(f'"instance":"{instance}"', f'"instance":"{number}.cts.json"')
            (self.folder / f"{number}.jsonl").write_text(other, encoding="utf-8")
        done = run_here(self.folder, "-o", self.folder / "out")
        self.assertEqual((done.returncode, done.stdout), (0, f"wrote {self.folder}/out/report.html: 31 logs\n"),
                         done.stderr)
        for name in ("runs", "bound_sources"):
            self.assertEqual(len({row["log"] for row in self.table(name)}), 31)
            figure = (self.folder / f"out/{name}.svg").read_text(encoding="utf-8")
            self.assertEqual(len(re.findall(r'id="axes_\d+"', figure)), 30)

    def test_tracker_rows_and_best_known_values(self):
        """Compares the submission with rows from `grove convert`, and results with the best known values."""
        shutil.copy(Path(__file__).resolve().parents[3] / "benchmarks/data/empty-32x32.map",
                    self.folder / "empty-32-32.map")
        data = Path(__file__).resolve().parents[3] / "benchmarks/data"
        scenario = (data / "empty-32x32.scen").read_text(encoding="utf-8")
        (self.folder / "empty-32-32-even-3.scen").write_text(scenario.replace("empty-32x32", "empty-32-32"),
                                                             encoding="utf-8")
        subprocess.run([str(GROVE), "bench", str(self.folder / "empty-32-32-even-3.scen"), "--agents", "3,8", "--run",
                        "first: --omega 0", "--run", "second: --omega inf", "--keep-plans", "--output-dir", "table",
                        "--time-limit", "10", "--quiet"], cwd=self.folder, check=True, capture_output=True)
        table, out = self.folder / "table", self.folder / "rows.csv"
        self.assertEqual(self.error_of(table, "--tracker", out), "--tracker: found plans of several methods; expected "
                         "--tracker-method first or second")
        done = run_here(table, "--tracker", out, "--tracker-method", "first")
        self.assertEqual((done.returncode, done.stdout), (0, f"wrote {out}: 2 rows of first for MAPF Tracker\n"),
                         done.stderr)
        with out.open(encoding="utf-8", newline="") as file:
            submitted = list(csv.DictReader(file))
        for row, agents in zip(submitted, (3, 8)):
            subprocess.run([str(GROVE), "convert", "--plan", f"table/plans/first/empty-32-32-even-3-{agents}.plan.json",
                            "empty-32-32-even-3.scen", "one.csv", "--map", "empty-32-32.map", "--agents", str(agents),
                            "--to",
                            "tracker-csv"], cwd=self.folder, check=True, capture_output=True)
            with (self.folder / "one.csv").open(encoding="utf-8", newline="") as file:
                self.assertEqual(list(csv.DictReader(file)), [row])
        cost = int(submitted[1]["solution_cost"])
        known = self.folder / "empty-32-32.csv"
        known.write_text(f"scen_type,type_id,agents,lower_cost,solution_cost\neven,3,8,{cost - 1},{cost + 1}\n",
                         encoding="utf-8")
        page, stderr = self.report(table, "--best-known", known)
        self.assertEqual(stderr, "")
        first, second = self.table("best_known")
        self.assertEqual((first["method"], first["better_plan"], first["higher_bound"], first["closes"]),
                         ("first", "true", "true", "true"))
        self.assertEqual((second["method"], second["cost_ratio"] != ""), ("second", True))
        self.assertIn("<h3>Improvements on the best known values</h3>", page)
        known.write_text(f"scen_type,type_id,agents,lower_cost,solution_cost\neven,3,8,{cost + 1},{cost - 1}\n",
                         encoding="utf-8")
        page, stderr = self.report(table, "--best-known", known)
        self.assertIn("grove: warning: proofs contradict each other", stderr)
        self.assertIn(f"MAPF Tracker has a lower bound of {cost + 1}; a plan costs {cost}", page)
        self.assertIn(f"MAPF Tracker has a plan of cost {cost - 1}, below a proven lower bound: {cost} (first", page)
        # A plan file that has changed since the run is not submitted, and the existing submission stays unchanged.
        before = out.read_bytes()
        for name in (3, 8):
            plan = table / f"plans/first/empty-32-32-even-3-{name}.plan.json"
            found = json.loads(plan.read_text(encoding="utf-8"))
            found["agents"][0]["path"].insert(1, [31, 31])
            plan.write_text(json.dumps(found), encoding="utf-8")
        self.assertIn("/plans/first/empty-32-32-even-3-3.plan.json: agent 0 jumps at time 1",
                      self.error_of(table, "--tracker", out, "--tracker-method", "first"))
        self.assertEqual(out.read_bytes(), before)

    def test_20000_rows_are_fast_and_legible_at_500_pixels(self):
        path = self.results(synthetic.rows(53), "results.csv")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.report(path, run=run)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        # Processor time, because the machine can be busy. The report uses one thread.
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"{path.read_text().count(chr(10)) - 1} rows: {spent:.1f} s", file=sys.stderr)
        self.assertLess(spent, MAX_SECONDS)
        self.assertTrue((self.folder / "out/comparison_mg_3.svg").exists())  # three maps in three columns
        for path in (self.folder / "out").glob("*.svg"):
            svg = path.read_text(encoding="utf-8")
            width = float(re.search(r'width="([0-9.]+)pt"', svg).group(1))
            letters = [100 * float(scale) for scale in re.findall(r"scale\(([0-9.]+) -", svg)]  # sizes in points
            self.assertGreater(len(letters), 10, path)
            self.assertGreaterEqual(500 / width * min(letters), 10, path)


class Usage(Folder):
    def test_help_lists_options_and_examples(self):
        for argument in ("--help", "-h"):
            done = run(argument)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            for expected in ("usage: grove report", "--baseline NAMES", "Exit codes:", "Examples:"):
                self.assertIn(expected, done.stdout)
        self.assertIn("report", subprocess.run([str(GROVE), "--help"], capture_output=True, text=True,
                                               check=True).stdout)

    def test_wrong_options_are_refused(self):
        path = self.results(few(1))
        hint = " (see 'grove report --help')"
        out = ("-o", self.folder / "out")
        self.assertEqual(self.error_of(*out), "the following arguments are required: RESULTS" + hint)
        self.assertEqual(self.error_of(path), "the following arguments are required: -o/--output" + hint)
        self.assertEqual(self.error_of(path, *out, "--tracker-method", "auto"),
                         "--tracker-method: requires --tracker" + hint)
        self.assertIn("--method: found 'frob', which is not in the results; expected one of Grove, auto, ",
                      self.error_of(path, *out, "--method", "frob"))
        self.assertEqual(self.error_of(path, *out, "--bogus"), "unrecognized arguments: --bogus" + hint)
        self.assertEqual(self.error_of(path, *out, "--baseline", "a,,b"),
                         "--baseline: found 'a,,b'; expected a comma-separated list of names" + hint)
        self.assertEqual(self.error_of(path, *out, "--study-agents", "x"),
                         "--study-agents: found 'x'; expected an integer of at least 0" + hint)
        self.assertEqual(self.error_of(path, *out, "--problem=mapf"),
                         "--problem: found 'mapf', which is not in the results; expected one of cts, mg")
        self.assertIn("--baseline: found 'frob', which is not in the results; expected one of Grove, auto, ",
                      self.error_of(path, *out, "--baseline", "frob"))
        for study in (("--study", "auto"), ("--study-agents", "20")):
            self.assertIn("--study, --study-map, --study-agents: no rows with several omegas are left",
                          self.error_of(path, *out, *study))
        shutil.rmtree(self.folder / "out")
        # `grove report` takes the names of other commands as file names.
        self.assertEqual(self.error_of("solve", "check", *out), "solve: no such file or directory")
        self.assertFalse((self.folder / "out").exists())

    def test_wrong_values_in_rows_are_refused(self):
        path = self.results([next(few(1)) | {"agents": "many"}])
        self.assertEqual(self.error_of(path, "-o", self.folder / "out"), "results.jsonl: row 1, column "
                         "agents: found 'many'; expected an integer of at least 0")

    def test_unwritable_output_is_an_error(self):
        path = self.results([next(few(1))])
        self.assertEqual(self.error_of(path, "-o", path), "results.jsonl: cannot be written: File exists")
        (self.folder / "out/report.html").mkdir(parents=True)
        self.assertEqual(self.error_of(path, "-o", self.folder / "out"),
                         "out/report.html: cannot be written: Is a directory")
        done = subprocess.run(["/bin/sh", "-c", 'exec "$0" report --help >/dev/full', str(GROVE)],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "grove: error: standard output: cannot be written\n"))

    def test_program_runs_through_a_symbolic_link(self):
        link = self.folder / "g"
        link.symlink_to(GROVE.resolve())
        self.assertEqual(run("--help", program=link, cwd="/").returncode, 0)

    def copy(self):
        """Copies only the program grove to a folder and returns the path of the copy."""
        (self.folder / "bin").mkdir()
        return shutil.copy(GROVE, self.folder / "bin")

    def test_missing_grove_report_is_an_error(self):
        program = self.copy()
        self.assertEqual(self.error_of(run=run, program=program), "bin/grove-report: there is no such program; "
                         "expected it beside grove (build target grove), or in ../libexec/grove (Debian package grove)")

    def test_missing_python_is_an_error(self):
        program = self.copy()
        (self.folder / "bin/grove-report").write_text("#!/no/such/python3\n")
        (self.folder / "bin/grove-report").chmod(0o755)
        self.assertEqual(self.error_of(run=run, program=program), "bin/grove-report: there is no /usr/bin/python3; "
                         "expected the Debian package python3")

    def test_missing_matplotlib_is_an_error(self):
        (self.folder / "matplotlib.py").write_text(
            "raise ModuleNotFoundError(\"No module named 'matplotlib'\", name='matplotlib')\n")
        path = self.results(few(1))
        environment = {**os.environ, "PYTHONPATH": str(self.folder)}
        self.assertEqual(self.error_of(path, "-o", self.folder / "out", run=run, env=environment),
                         "/usr/bin/python3 has no module matplotlib, which draws the figures; "
                         "expected the Debian package python3-matplotlib")
        self.assertEqual(run("--help", env=environment).returncode, 0)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-") and Path(sys.argv[1]).exists():
        GROVE = Path(sys.argv.pop(1)).resolve()
    unittest.main()
