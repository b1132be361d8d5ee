#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reading rows, and every figure that is computed from them, on rows small enough to do it by hand."""
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3] / "tools/report"),
                str(Path(__file__).resolve().parent)]

import synthetic  # noqa: E402
from grove_report import metrics, proofs, rows, scales, speedup, style  # noqa: E402
from grove_report.lines import Line, Lines, families  # noqa: E402
from grove_report.metrics import Cell  # noqa: E402
from grove_report.rows import BadInput, read_results  # noqa: E402
from grove_report.tables import csv_value, html_table, seconds, word  # noqa: E402

NEEDED = {"instance": "i", "method": "a", "map": "m", "agents": 5, "tasks": 10, "problem": "mg",
          "time_limit_s": 100, "solved": True, "status": "feasible", "cost": 10, "runtime_s": 1}


def row(**values):
    """A row as read, solved in a second unless told otherwise."""
    absent = {name: None if absent is rows.NEEDED else absent
              for name, (_, absent) in rows.COLUMNS.items()}
    found = rows.Row(**(absent | NEEDED | values))
    return found if found.solved else found._replace(runtime_s=found.time_limit_s)


def failed(**values):
    return row(**({"solved": False, "status": "unknown", "cost": None} | values))


def measures(found):
    """Of rows that are all there are."""
    return metrics.measures(found, metrics.best_costs(found))


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, *found):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        (synthetic.write_csv if name.endswith(".csv") else synthetic.write_jsonl)(path, found)
        return path

    def text(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def complaint(self, *arguments):
        with self.assertRaises(BadInput) as caught:
            read_results(arguments)
        self.assertNotIn("\n", str(caught.exception))
        return str(caught.exception).replace(f"{self.folder}/", "")


class Reading(Folder):
    def test_both_formats_say_the_same(self):
        made = list(synthetic.rows(1, tasks=(10, 50)))
        self.assertEqual(read_results([self.file("a.csv", *made)]).rows,
                         read_results([self.file("a.jsonl", *made)]).rows)

    def test_a_folder_is_its_results(self):
        self.file("results.csv", NEEDED)
        self.assertEqual(read_results([self.folder]).files, [(f"{self.folder}/results.csv", 1)])
        self.file("results.jsonl", NEEDED, NEEDED | {"instance": "j"})
        self.assertEqual(read_results([self.folder]).files, [(f"{self.folder}/results.jsonl", 2)])

    def test_rows_of_instances_that_cannot_be_read_are_left_out(self):
        lost = NEEDED | dict.fromkeys(("map", "agents", "tasks", "problem", "cost")) | {
            "instance": "broken", "solved": False, "status": "error", "error": "x.cts.json: no map"}
        for name in ("a.jsonl", "a.csv"):
            results = read_results([self.file(name, NEEDED, lost)])
            self.assertEqual((len(results.rows), results.unreadable), (1, ["broken"]))
        self.assertIn("column map: nothing there", self.complaint(self.file("a.jsonl", lost | {"status": "unknown"})))

    def test_a_last_line_that_is_cut_off_is_left_out(self):
        good = json.dumps(NEEDED)
        results = read_results([self.text("a.jsonl", good + "\n" + good[:20])])
        self.assertEqual((len(results.rows), results.cut_off), (1, [f"{self.folder}/a.jsonl"]))
        self.assertEqual(self.complaint(self.text("a.jsonl", good[:20])),
                         "a.jsonl: no rows; expected at least one")
        whole = read_results([self.text("a.jsonl", good)])  # only the line's end is missing
        self.assertEqual((len(whole.rows), whole.cut_off), (1, []))

    def test_a_byte_order_mark_is_no_letter(self):
        path = self.file("a.csv", NEEDED)
        path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
        self.assertEqual(len(read_results([path]).rows), 1)

    def test_absent_values(self):
        for path in (self.file("a.csv", NEEDED), self.file("a.jsonl", NEEDED)):
            read = read_results([path]).rows[0]
            self.assertEqual((read.omega, read.seed, read.sqr, read.roots, read.error),
                             ("", None, None, None, ""))

    def test_failures_count_as_the_limit_and_have_no_sqr(self):
        path = self.file("a.jsonl", NEEDED | {"solved": False, "runtime_s": 3, "sqr": 0.5})
        read = read_results([path]).rows[0]
        self.assertEqual((read.runtime_s, read.sqr), (100, None))

    def test_sqr_from_the_costs(self):
        path = self.file("a.jsonl", NEEDED | {"root_cost": 9})
        self.assertEqual(read_results([path]).rows[0].sqr, 0.9)

    def test_omega_is_a_number_however_it_is_written(self):
        for written, omega in (("0.010", "0.01"), (0, "0"), ("0.0", "0"), ("inf", "inf"), (0.1, "0.1")):
            path = self.file("a.jsonl", NEEDED | {"omega": written})
            self.assertEqual(read_results([path]).rows[0].omega, omega)

    def test_of_a_repeated_run_the_later_counts(self):
        first = NEEDED | {"ended_at": "2026-01-01", "cost": 11}
        results = read_results([self.file("a.csv", NEEDED | {"ended_at": "2026-01-02"}, first)])
        self.assertEqual(([found.cost for found in results.rows], results.repeated), ([10], 1))
        self.assertEqual(len(read_results([self.file("a.csv", first, first | {"seed": 1},
                                                     first | {"omega": "0"})]).rows), 3)

    def test_letters_that_cannot_be_shown(self):
        path = self.text("a.jsonl", json.dumps(NEEDED | {"method": "a\n\ud800\x00é"}))
        self.assertEqual(read_results([path]).rows[0].method, "a\\n\\ud800\\x00é")


class Refusals(Folder):
    def test_files(self):
        self.assertEqual(self.complaint(self.folder / "no"), "no: there is no such file or folder")
        self.assertEqual(self.complaint(self.text("a.txt", "")),
                         "a.txt: unknown kind of file; expected .csv, .jsonl or a folder")
        self.assertTrue(self.complaint(self.folder).endswith(
            ": no results.jsonl and no results.csv in this folder; expected what grove bench or grove-mpi batch writes"))
        self.assertEqual(self.complaint(self.text("a.csv", "")),
                         "a.csv: empty; expected a line with the columns' names")
        self.assertEqual(self.complaint(self.text("a.jsonl", "\n")),
                         "a.jsonl: no rows; expected at least one")
        self.assertEqual(self.complaint(self.text("a.jsonl", b"\xff")),
                         "a.jsonl: byte 0: not UTF-8 text")

    def test_columns(self):
        self.assertEqual(self.complaint(self.text("a.csv", "instance,method,cost\n")),
                         "a.csv: line 1: no column map, agents, tasks, problem, time_limit_s, solved, "
                         "status, runtime_s; expected the columns that grove bench writes")
        header = ",".join(NEEDED)
        self.assertEqual(self.complaint(self.text("a.csv", f"{header},map\n")),
                         "a.csv: line 1: column map is there twice")
        self.assertEqual(self.complaint(self.text("a.csv", f"{header}\n1,2\n")),
                         "a.csv: row 1 (line 2): 2 columns; expected 11 as in the first line")
        self.assertEqual(self.complaint(self.text("a.csv", f'{header}\n"1,2\n')),
                         "a.csv: line 2: not CSV: unexpected end of data")

    def test_json(self):
        good = json.dumps(NEEDED)
        self.assertEqual(self.complaint(self.text("a.jsonl", good + "\n" + good[:20] + "\n" + good)),
                         "a.jsonl: row 2: not JSON; expected one object a line")
        self.assertEqual(self.complaint(self.text("a.jsonl", "[1]\n")),
                         "a.jsonl: row 1: found '[1]'; expected a JSON object")

    def test_values(self):
        for column, wrong, expected in (
                ("agents", "x", "an integer of at least 0"), ("tasks", -1, "an integer of at least 0"),
                ("agents", 1.5, "an integer of at least 0"), ("cost", "1e3", "an integer of at least 0"),
                ("agents", True, "an integer of at least 0"),
                ("runtime_s", "nan", "a number of at least 0"), ("runtime_s", -1, "a number of at least 0"),
                ("runtime_s", "1e999", "a number of at least 0"), ("runtime_s", [], "a number of at least 0"),
                ("time_limit_s", 0, "a number above 0"), ("solved", "yes", "true or false"),
                ("solved", 1, "true or false"), ("omega", "nan", "a number of at least 0, or inf"),
                ("omega", "-1", "a number of at least 0, or inf"), ("method", 3, "a text"),
                ("problem", "tsp", "one of mg, cts, mixed, mapf"),
                ("counts", "bypasses", "numbers as name=7, with blanks between"),
                ("counts", {"bypasses": 7}, "numbers as name=7, with blanks between"),
                ("counts", "bypasses=-1 a=2", "numbers as name=7, with blanks between"),
                ("status", "timeout", "one of optimal, bounded, feasible, infeasible, unknown, error")):
            for name, place in (("a.csv", "row 2 (line 3)"), ("a.jsonl", "row 2")):
                if name == "a.csv" and not isinstance(wrong, str):
                    continue
                shown = wrong if isinstance(wrong, str) else json.dumps(wrong)
                path = self.file(name, NEEDED, NEEDED | {column: wrong})
                self.assertEqual(self.complaint(path), f"{name}: {place}, column {column}: "
                                                       f"found '{shown}'; expected {expected}")

    def test_what_is_not_there(self):
        for name, place in (("a.csv", "row 1 (line 2)"), ("a.jsonl", "row 1")):
            self.assertEqual(self.complaint(self.file(name, NEEDED | {"map": None})),
                             f"{name}: {place}, column map: nothing there; expected a value")
        self.assertEqual(self.complaint(self.file("a.jsonl", NEEDED | {"cost": None})),
                         "a.jsonl: row 1, column cost: nothing there in a solved row; "
                         "expected an integer")
        self.assertEqual(self.complaint(self.file("a.jsonl", NEEDED | {"status": "unknown"})),
                         "a.jsonl: row 1, column status: found 'unknown' in a solved row; "
                         "expected one of optimal, bounded, feasible")


class Measures(unittest.TestCase):
    def test_of_some_rows(self):
        found = measures([row(runtime_s=1.0, sqr=0.9, roots=4, rtsp_calls=10),
                          row(runtime_s=3.0, sqr=0.8, roots=2), failed(roots=30), failed()])
        self.assertEqual((found.runs, found.solved, found.success), (4, 2, 0.5))
        self.assertEqual(found.mean_runtime_s, (1 + 3 + 100 + 100) / 4)
        self.assertEqual(found.median_runtime_s, (3 + 100) / 2)
        self.assertEqual(found.par2_s, (1 + 3 + 200 + 200) / 4)
        self.assertAlmostEqual(found.mean_sqr, 0.85)
        self.assertEqual((found.mean_roots, found.mean_rtsp_calls), (12, 10))

    def test_none_solved(self):
        found = measures([failed(omega="0")])
        self.assertEqual((found.success, found.mean_runtime_s, found.par2_s, found.mean_sqr,
                          found.mean_cost_ratio, found.within_omega), (0, 100, 200, None, None, 0))

    def test_within_omega(self):
        def within(omega, **values):
            return metrics.within_omega(row(omega=omega, **values))
        for cost, found in ((100, True), (101, True), (102, False)):
            self.assertIs(within("0.01", cost=cost, lower_bound=100), found)
        # What the plan costs counts, not what the status says.
        self.assertIs(within("0.01", status="bounded", cost=102, lower_bound=100), False)
        # 1.1 x 110 is 121, but a little more or less in binary.
        self.assertIs(within("0.1", cost=121, lower_bound=110), True)
        self.assertIs(within("0.1", cost=122, lower_bound=110), False)
        self.assertIs(within("0", cost=10, lower_bound=10), True)
        self.assertIs(within("0", cost=10, lower_bound=9), False)
        for status, found in (("optimal", True), ("bounded", True), ("feasible", False)):
            self.assertIs(within("0.01", status=status), found)  # no bound is told
        for omega in ("inf", ""):
            self.assertIsNone(within(omega, status="optimal", lower_bound=10))

    def test_how_many_are_within_omega(self):
        found = [row(omega="0.1", cost=110, lower_bound=100), row(omega="0.1", cost=111, lower_bound=100),
                 row(omega="0.1", status="optimal"), failed(omega="0.1", cost=100, lower_bound=100)]
        self.assertEqual(measures(found).within_omega, 2)
        self.assertIsNone(measures([row(omega="inf")]).within_omega)
        self.assertIsNone(measures([row()]).within_omega)

    def test_best_costs(self):
        found = metrics.best_costs([
            row(cost=12), row(method="b", cost=11), failed(method="c", status="feasible", cost=10),
            failed(method="d", status="error", cost=1), failed(method="e"),
            row(problem="cts", cost=20), failed(instance="j")])
        self.assertEqual(found, {("mg", "i"): 10, ("cts", "i"): 20})

    def test_cost_ratio(self):
        easy = row(cost=10)
        hard = row(instance="j", cost=30)
        best = metrics.best_costs([easy, hard, row(method="b", cost=8), failed(instance="k", cost=1),
                                   row(method="b", instance="j", cost=30)])
        # 10/8 and 30/30; the failure does not count.
        self.assertEqual(metrics.measures([easy, hard, failed(instance="k", cost=2)], best).mean_cost_ratio,
                         1.125)
        free = row(cost=0)
        self.assertEqual(metrics.cost_ratio(free, metrics.best_costs([free])), 1)
        self.assertIsNone(metrics.cost_ratio(easy, metrics.best_costs([easy, free])))

    def test_the_cost_ratio_of_an_exact_method_is_not_worse_for_solving_more(self):
        """SQR is: 10/10 on the easy instance, 10/20 on the hard one, which the other does not solve."""
        exact = [row(status="optimal", cost=10, sqr=1.0),
                 row(instance="j", status="optimal", cost=20, sqr=0.5)]
        other = [row(method="b", cost=11, sqr=10 / 11), failed(method="b", instance="j")]
        best = metrics.best_costs(exact + other)
        exact, other = metrics.measures(exact, best), metrics.measures(other, best)
        self.assertLess(exact.mean_sqr, other.mean_sqr)
        self.assertEqual((exact.mean_cost_ratio, other.mean_cost_ratio), (1, 1.1))

    def test_cells_keep_methods_omegas_and_limits_apart_and_leave_gaps(self):
        made = [row(), row(omega="0"), row(time_limit_s=7.0), row(tasks=20, method="b")]
        found = metrics.by_cell(made, metrics.best_costs(made))
        self.assertEqual({cell: set(lines) for cell, lines in found.items()},
                         {Cell("m", 5, 10): {Line("a", "", 100), Line("a", "0", 100), Line("a", "", 7.0)},
                          Cell("m", 5, 20): {Line("b", "", 100)}})

    def test_the_median_run_of_several_seeds(self):
        def time_of(*runs):
            return metrics.median_runs(runs)["i"][Line("a", "", 100)].runtime_s
        self.assertEqual(time_of(row(runtime_s=5), row(runtime_s=1), row(runtime_s=3)), 3)
        self.assertEqual(time_of(row(runtime_s=5), failed()), 5)
        self.assertEqual(time_of(row(runtime_s=5), failed(), failed()), 100)
        # A success after the limit is still a success.
        self.assertEqual(time_of(row(runtime_s=101), failed()), 101)

    def test_solved_over_time(self):
        self.assertEqual(metrics.solved_over_time([row(runtime_s=5), failed(), row(runtime_s=2)]), [2, 5])

    def test_only_solvers(self):
        runs = metrics.median_runs([
            row(), failed(method="b"), row(instance="j"), row(instance="j", method="b"),
            row(instance="k"), failed(instance="l"), failed(instance="l", method="b"),
            row(instance="n"), row(instance="n", omega="0"), failed(instance="n", method="b")])
        self.assertEqual({(line.method, line.omega): [found.instance for found in rows]
                          for line, rows in metrics.only_solver(runs).items()},
                         {("a", ""): ["i", "n"], ("a", "0"): ["n"]})

    def test_beyond_the_baselines(self):
        runs = metrics.median_runs([
            row(), failed(method="base"), row(instance="j"), row(instance="j", method="base"),
            row(instance="k")])  # no baseline tried k
        self.assertEqual(metrics.beyond_baselines(runs, lambda line: line.method == "base"),
                         {Line("a", "", 100): 1})


class Speedups(unittest.TestCase):
    """Baselines x and y, method a; four instances."""

    def setUp(self):
        def times(instance, **seconds):
            return [failed(instance=instance, method=method) if time is None else
                    row(instance=instance, method=method, runtime_s=time)
                    for method, time in seconds.items()]
        runs = metrics.median_runs([
            *times("p", x=10, y=20, a=2),       # best 10
            *times("q", x=None, y=30, a=10),    # best 30
            *times("r", x=50, y=40, a=None),    # best 40
            *times("easy", x=0.5, y=90, a=9),   # best 0.5: does not count
            *times("hard", x=None, y=None, a=1)])
        self.found = {(each.map, each.baseline.method, each.line.method): each
                      for each in speedup.speedups(runs, lambda line: line.method in "xy")}

    def test_best_baseline(self):
        found = self.found["", "best baseline", "a"]
        # 10/2, 30/10, 40/100
        self.assertEqual((found.instances, found.median_ratio, found.line_failed, found.baseline_failed),
                         (3, 3.0, 1, 0))
        self.assertEqual((found.baseline_median_s, found.line_median_s), (30, 10))
        self.assertEqual(found.sure, "exactly")  # 40/100 is the smallest anyway

    def test_one_baseline(self):
        found = self.found["", "x", "a"]
        # 10/2, 100+/10, 50/100+
        self.assertEqual((found.median_ratio, found.baseline_failed, found.line_failed), (5, 1, 1))
        self.assertEqual(found.sure, "exactly")
        self.assertEqual(self.found["", "y", "x"].median_ratio, 0.8)  # 20/10, 30/100+, 40/50

    def test_what_failures_leave_open(self):
        pairs = [(failed(), row(runtime_s=10)), (row(runtime_s=10), row(runtime_s=10))]
        self.assertEqual(speedup._sure(pairs, 5.5), "at least")
        self.assertEqual(speedup._sure([(mine, other) for other, mine in pairs], 0.55), "at most")
        self.assertEqual(speedup._sure([(failed(), failed())], 1), "about")

    def test_by_map(self):
        self.assertEqual(self.found["m", "x", "a"][3:], self.found["", "x", "a"][3:])

    def test_no_time_at_all_is_a_millisecond(self):
        runs = metrics.median_runs([row(method="x", runtime_s=2), row(runtime_s=0)])
        found = speedup.speedups(runs, lambda line: line.method == "x")
        self.assertEqual([each.median_ratio for each in found if each.line.method == "a"], [2000] * 4)


class Proofs(unittest.TestCase):
    def said(self, *found):
        return [each.what for each in proofs.contradictions(found)]

    def test_agreement(self):
        optimal = {"status": "optimal", "cost": 10, "lower_bound": 10}
        rows_ = [row(**optimal), row(method="b", **optimal), row(method="c", cost=12, lower_bound=9),
                 row(instance="j", status="optimal", cost=11), failed(method="d", lower_bound=10)]
        self.assertEqual(self.said(*rows_), [])
        self.assertEqual(proofs.optimal_agreements(rows_), 1)

    def test_optimal_costs_differ(self):
        self.assertEqual(self.said(row(status="optimal", cost=10), row(method="b", status="optimal", cost=11),
                                   row(method="c", omega="0", status="optimal", cost=11)),
                         ["optimal costs differ: 10 (a), 11 (b, c ω=0)"])

    def test_a_plan_below_a_bound(self):
        self.assertEqual(self.said(row(cost=10), failed(method="b", lower_bound=11)),
                         ["a plan costs 10 (a), below a proven lower bound: 11 (b)"])
        self.assertEqual(self.said(row(cost=10), row(method="b", cost=12, root_cost=11)),
                         ["a plan costs 10 (a), below the root cost: 11 (b)"])
        self.assertEqual(self.said(row(cost=10), row(method="b", status="optimal", cost=11)),
                         ["a plan costs 10 (a), less than the optimal cost: 11 (b)"])

    def test_a_plan_of_what_has_none(self):
        self.assertEqual(self.said(row(), failed(method="b", status="infeasible")),
                         ["a plan costs 10 (a); but: infeasible (b)"])

    def test_problems_are_kept_apart_and_errors_left_out(self):
        self.assertEqual(self.said(row(status="optimal", cost=10),
                                   row(problem="cts", status="optimal", cost=11),
                                   failed(method="b", status="error", cost=3, lower_bound=99)), [])


class CommonInstances(unittest.TestCase):
    """What all solve which solve any."""

    def measured(self, found):
        return {line.method: each for line, each in
                metrics.measures_by_line(found, metrics.best_costs(found)).items()}

    def test_are_those_of_all_that_solve_any(self):
        found = [row(instance="easy", method="a", sqr=1.0, cost=10), row(instance="hard", method="a", sqr=0.5, cost=20),
                 row(instance="easy", method="b", sqr=0.8, cost=12), failed(instance="hard", method="b"),
                 failed(instance="easy", method="c"), failed(instance="hard", method="c")]
        a, b, c = (self.measured(found)[method] for method in "abc")
        self.assertEqual([each.common for each in (a, b, c)], [1, 1, 1])
        self.assertEqual((a.mean_sqr, a.common_sqr, a.common_cost_ratio), (0.75, 1.0, 1.0))
        self.assertEqual((b.mean_sqr, b.common_sqr, b.common_cost_ratio), (0.8, 0.8, 1.2))
        self.assertEqual((c.common_sqr, c.common_cost_ratio), (None, None))

    def test_need_two(self):
        alone = self.measured([row(method="a", sqr=1.0), failed(method="b")])["a"]
        self.assertEqual((alone.common, alone.common_sqr), (0, None))

    def test_with_seeds_all_solved_runs_count(self):
        found = [row(method="a", seed=1, sqr=0.8), row(method="a", seed=2, sqr=0.6), failed(method="a", seed=3),
                 row(method="b", seed=1, sqr=1.0)]
        self.assertAlmostEqual(self.measured(found)["a"].common_sqr, 0.7)


class TheLines(unittest.TestCase):
    def test_groves_own_search_has_its_name(self):
        lines = Lines([row(method="auto"), row(method="hcbs")], [])
        self.assertEqual([lines.label(line) for line in lines.all], ["Grove", "hcbs"])
        lines = Lines([row(method="auto"), row(method="Grove")], [])
        self.assertEqual({lines.label(line) for line in lines.all}, {"Grove", "auto"})

    def test_labels_tell_what_the_method_does_not(self):
        found = [row(method="a", omega="0"), row(method="a", omega="inf"), row(method="b", omega="0.01"),
                 row(method="c"), row(method="c", time_limit_s=7.5)]
        lines = Lines(found, ["b"])
        self.assertEqual([lines.label(line) for line in lines.all],
                         ["a, ω = 0", "a, ω = ∞", "c, no ω, limit 7.5 s", "c, no ω, limit 100 s", "b, ω = 0.01"])
        self.assertEqual([lines.name(line) for line in lines.all],
                         ["a", "a", "c, limit 7.5 s", "c, limit 100 s", "b"])

    def test_labels_leave_out_an_omega_that_all_share(self):
        def labels(*found):
            lines = Lines(found, [])
            return [lines.label(line) for line in lines.all]
        self.assertEqual(labels(row(omega="0"), row(method="b", omega="0")), ["a", "b"])
        # Of different problems, which no figure shows side by side.
        self.assertEqual(labels(row(omega="0"), row(method="b", omega="1", problem="cts")), ["a", "b"])

    def test_families_by_options(self):
        found = [row(method=method, omega=omega, options=options) for method, omega, options in (
            ("one", "0", "--method x --omega 0 --seed 1"), ("two", "inf", "--method x --omega=inf --seed 1"),
            ("three", "0.1", "--method x --seed 2 --omega 0.1"), ("four", "0", "--method y --omega 0"))]
        self.assertEqual([[line.method for line in family.lines] for family in families(found)],
                         [["one", "two"]])
        named = families(found, ("one", "three", "four"))
        self.assertEqual([[line.method for line in family.lines] for family in named],
                         [["four", "one", "three"]])

    def test_families_by_name(self):
        found = [row(method="x", omega=omega) for omega in ("inf", "0", "0.01")]
        found += [row(method="cts-cbs-w0", omega="0"), row(method="cts-cbs-w0.1", omega="0.1"),
                  row(method="eecbs2", omega="2"), row(method="eecbs1", omega="1")]
        self.assertEqual([(family.name, [line.omega for line in family.lines])
                          for family in families(found)],
                         [("x", ["0", "0.01", "inf"]), ("cts-cbs", ["0", "0.1"])])
        self.assertEqual(families([row(omega="0"), row(method="b", omega="0.1")]), [])

    def test_families_need_two_omegas_and_one_time_limit(self):
        same = {"options": "--method x --omega 0", "omega": "0"}
        self.assertEqual(families([row(**same), row(method="b", **same)]), [])
        self.assertEqual(families([row(omega="0"), row(omega="1", time_limit_s=7)]), [])


class Scales(unittest.TestCase):
    def test_points_side_by_side(self):
        self.assertEqual(scales.dodged([10, 30], "abc"), {"a": -0.5, "b": 0, "c": 0.5})
        self.assertEqual(scales.dodged([10, 15, 30], "ab"), {"a": -0.125, "b": 0.125})
        self.assertEqual(scales.dodged([10], "ab"), {"a": 0, "b": 0})
        self.assertEqual(scales.dodged([10, 30], "a"), {"a": 0})

    def test_rounded_down(self):
        for value, rounded in ((1, 1), (0.9, 0.3), (0.3, 0.3), (0.29, 0.1), (0.0081, 0.003), (0.002, 0.001)):
            self.assertAlmostEqual(scales.rounded_down(value), rounded, places=12)

    def test_where_time_begins(self):
        self.assertEqual(scales.first_time([row(runtime_s=0.0042), row(runtime_s=2)]), 0.003)
        self.assertEqual(scales.first_time([row(runtime_s=0), row(runtime_s=0.05)]), 0.03)
        self.assertEqual(scales.first_time([row(runtime_s=50)]), 1)
        self.assertEqual(scales.first_time([failed()]), 1)

    def test_what_lies_below_is_larger(self):
        for count in (1, 2, 8, 30):
            depths = [style.depth(rank, count) for rank in range(count)]
            self.assertEqual((depths, depths[-1]), (sorted(set(depths), reverse=True), 0))
            self.assertLessEqual(depths[0], 1)


class Tables(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual([seconds(value) for value in (0, 0.0123456, 1.23456, 12.3456, 180, 9876.5)],
                         ["<0.001", "0.0123", "1.23", "12.3", "180", "9876"])
        self.assertEqual([csv_value(value) for value in (None, 3, 0.5, math.pi, "a")],
                         ["", "3", "0.5", "3.14159", "a"])

    def test_text_is_only_text(self):
        self.assertNotIn("<script>", html_table(["<script>"], [[word("<script>", "<script>")]]))


if __name__ == "__main__":
    unittest.main()
