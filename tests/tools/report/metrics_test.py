#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the reader of rows and every figure computed from them, with rows small enough for computing results by
hand."""
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3] / "tools/report"),
                str(Path(__file__).resolve().parent)]

import synthetic  # noqa: E402
from grove_report import anytime, logs, metrics, plans, proofs, rows, scales, speedup, style, tracker  # noqa: E402
from grove_report.lines import Line, Lines, families  # noqa: E402
from grove_report.metrics import Configuration  # noqa: E402
from grove_report.rows import BadInput, read_results  # noqa: E402
from grove_report.tables import csv_text, csv_value, html_table, seconds, text_of_cell, word  # noqa: E402

NEEDED = {"instance": "i", "method": "a", "map": "m", "agents": 5, "tasks": 10, "problem": "mg",
          "time_limit_s": 100, "solved": True, "status": "feasible", "cost": 10, "runtime_s": 1}


def row(**values):
    """Returns a row as the reader returns it; by default solved in one second."""
    absent = {name: None if absent is rows.NEEDED else absent
              for name, (_, absent) in rows.COLUMNS.items()}
    found = rows.Row(**(absent | NEEDED | values))
    return found if found.solved else found._replace(runtime_s=found.time_limit_s)


def failed(**values):
    return row(**({"solved": False, "status": "unknown", "cost": None} | values))


def measures(found):
    """Returns the measures of the rows, compared only with each other."""
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

    def error_of(self, *arguments):
        with self.assertRaises(BadInput) as caught:
            read_results(arguments)
        self.assertNotIn("\n", str(caught.exception))
        return str(caught.exception).replace(f"{self.folder}/", "")


class Reading(Folder):
    def test_csv_and_jsonl_give_the_same_rows(self):
        made = list(synthetic.rows(1, tasks=(10, 50)))
        self.assertEqual(read_results([self.file("a.csv", *made)]).rows,
                         read_results([self.file("a.jsonl", *made)]).rows)

    def test_folder_is_read_as_its_results_file(self):
        self.file("results.csv", NEEDED)
        self.assertEqual(read_results([self.folder]).files, [(f"{self.folder}/results.csv", 1)])
        self.file("results.jsonl", NEEDED, NEEDED | {"instance": "j"})
        self.assertEqual(read_results([self.folder]).files, [(f"{self.folder}/results.jsonl", 2)])

    def test_rows_of_unreadable_instances_are_omitted(self):
        lost = NEEDED | dict.fromkeys(("map", "agents", "tasks", "problem", "cost")) | {
            "instance": "broken", "solved": False, "status": "error", "error": "x.cts.json: no map"}
        for name in ("a.jsonl", "a.csv"):
            results = read_results([self.file(name, NEEDED, lost)])
            self.assertEqual((len(results.rows), results.unreadable), (1, ["broken"]))
        self.assertIn("column map: empty", self.error_of(self.file("a.jsonl", lost | {"status": "unknown"})))

    def test_incomplete_last_line_is_omitted(self):
        good = json.dumps(NEEDED)
        results = read_results([self.text("a.jsonl", good + "\n" + good[:20])])
        self.assertEqual((len(results.rows), results.cut_off), (1, [f"{self.folder}/a.jsonl"]))
        self.assertEqual(self.error_of(self.text("a.jsonl", good[:20])),
                         "a.jsonl: no rows; expected at least one")
        whole = read_results([self.text("a.jsonl", good)])  # only the last line break is missing
        self.assertEqual((len(whole.rows), whole.cut_off), (1, []))

    def test_byte_order_mark_is_ignored(self):
        path = self.file("a.csv", NEEDED)
        path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
        self.assertEqual(len(read_results([path]).rows), 1)

    def test_missing_columns_have_default_values(self):
        for path in (self.file("a.csv", NEEDED), self.file("a.jsonl", NEEDED)):
            read = read_results([path]).rows[0]
            self.assertEqual((read.omega, read.seed, read.sqr, read.roots, read.error),
                             ("", None, None, None, ""))

    def test_failure_has_the_time_limit_as_runtime_and_no_sqr(self):
        path = self.file("a.jsonl", NEEDED | {"solved": False, "runtime_s": 3, "sqr": 0.5})
        read = read_results([path]).rows[0]
        self.assertEqual((read.runtime_s, read.sqr), (100, None))

    def test_sqr_is_computed_from_the_costs(self):
        path = self.file("a.jsonl", NEEDED | {"root_cost": 9})
        self.assertEqual(read_results([path]).rows[0].sqr, 0.9)

    def test_omega_is_normalised(self):
        for written, omega in (("0.010", "0.01"), (0, "0"), ("0.0", "0"), ("inf", "inf"), (0.1, "0.1")):
            path = self.file("a.jsonl", NEEDED | {"omega": written})
            self.assertEqual(read_results([path]).rows[0].omega, omega)

    def test_latest_row_of_a_repeated_run_counts(self):
        first = NEEDED | {"ended_at": "2026-01-01", "cost": 11}
        results = read_results([self.file("a.csv", NEEDED | {"ended_at": "2026-01-02"}, first)])
        self.assertEqual(([found.cost for found in results.rows], results.repeated), ([10], 1))
        self.assertEqual(len(read_results([self.file("a.csv", first, first | {"seed": 1},
                                                     first | {"omega": "0"})]).rows), 3)

    def test_unprintable_characters_are_escaped(self):
        path = self.text("a.jsonl", json.dumps(NEEDED | {"method": "a\n\ud800\x00é"}))
        self.assertEqual(read_results([path]).rows[0].method, "a\\n\\ud800\\x00é")


class Formulas(Folder):
    """Tests cells that a spreadsheet would take for formulas."""
    GUARDED = ("=1+2", "@SUM(A1)", "+1-2", "-2+3", "\t=1", "\r=1", "=a,b", "'=1", "--omega 0")
    PLAIN = ("", "a", "-1", "-1.5e-3", "'a", "1-2")

    def test_formulas_are_prefixed_with_an_apostrophe(self):
        for text in self.GUARDED:
            self.assertEqual(csv_value(text), "'" + text)
        for text in self.PLAIN:
            self.assertEqual(csv_value(text), text)
        self.assertEqual((csv_value(-1), csv_value(-1.5), csv_value(None)), ("-1", "-1.5", ""))

    def test_formulas_are_read_back_unchanged(self):
        for text in self.GUARDED + self.PLAIN:
            self.assertEqual(text_of_cell(csv_value(text)), text)
        for text in ("=cmd|' /C calc'!A0", "-f", "'=1"):
            path = self.text("a.csv", csv_text(NEEDED, [list((NEEDED | {"method": text, "solved": "true"}).values())]))
            self.assertEqual(read_results([path]).rows[0].method, text)
            self.assertIn("'" + text, path.read_text())


class Refusals(Folder):
    def test_unreadable_files_are_refused(self):
        self.assertEqual(self.error_of(self.folder / "no"), "no: no such file or directory")
        self.assertEqual(self.error_of(self.text("a.txt", "")),
                         "a.txt: unknown file type; expected .csv, .jsonl or a directory")
        self.assertTrue(self.error_of(self.folder).endswith(
            ": no results.jsonl and no results.csv in this directory; "
            "expected what grove bench or grove-mpi batch writes"))
        self.assertEqual(self.error_of(self.text("a.csv", "")),
                         "a.csv: empty; expected a line with the names of the columns")
        self.assertEqual(self.error_of(self.text("a.jsonl", "\n")),
                         "a.jsonl: no rows; expected at least one")
        self.assertEqual(self.error_of(self.text("a.jsonl", b"\xff")),
                         "a.jsonl: byte 0: not UTF-8 text")

    def test_wrong_columns_are_refused(self):
        self.assertEqual(self.error_of(self.text("a.csv", "instance,method,cost\n")),
                         "a.csv: line 1: missing column map, agents, tasks, problem, time_limit_s, solved, "
                         "status, runtime_s; expected the columns that grove bench writes")
        header = ",".join(NEEDED)
        self.assertEqual(self.error_of(self.text("a.csv", f"{header},map\n")),
                         "a.csv: line 1: found column map twice; expected it once")
        self.assertEqual(self.error_of(self.text("a.csv", f"{header}\n1,2\n")),
                         "a.csv: row 1 (line 2): 2 columns; expected 11 as in the first line")
        self.assertEqual(self.error_of(self.text("a.csv", f'{header}\n"1,2\n')),
                         "a.csv: line 2: not CSV: unexpected end of data")

    def test_malformed_json_is_refused(self):
        good = json.dumps(NEEDED)
        self.assertEqual(self.error_of(self.text("a.jsonl", good + "\n" + good[:20] + "\n" + good)),
                         "a.jsonl: row 2: not JSON; expected one object a line")
        self.assertEqual(self.error_of(self.text("a.jsonl", "[1]\n")),
                         "a.jsonl: row 1: found '[1]'; expected a JSON object")

    def test_wrong_values_are_refused(self):
        for column, wrong, expected in (
                ("agents", "x", "an integer of at least 0"), ("tasks", -1, "an integer of at least 0"),
                ("agents", 1.5, "an integer of at least 0"), ("cost", "1e3", "an integer of at least 0"),
                ("agents", True, "an integer of at least 0"),
                ("runtime_s", "nan", "a number of at least 0"), ("runtime_s", -1, "a number of at least 0"),
                ("runtime_s", "1e999", "a number of at least 0"), ("runtime_s", [], "a number of at least 0"),
                ("time_limit_s", 0, "a number above 0"), ("solved", "yes", "true or false"),
                ("solved", 1, "true or false"), ("omega", "nan", "a number of at least 0, or inf"),
                ("omega", "-1", "a number of at least 0, or inf"), ("method", 3, "a text"),
                ("problem", "tsp", "one of mg, cts, mixed, mapf, choices"),
                ("counts", "bypasses", "numbers as name=7, separated by blanks"),
                ("counts", {"bypasses": 7}, "numbers as name=7, separated by blanks"),
                ("counts", "bypasses=-1 a=2", "numbers as name=7, separated by blanks"),
                ("status", "timeout", "one of optimal, bounded, feasible, infeasible, unknown, error, invalid, "
                 "claimed, unsupported"),
                ("trace", "0.1:5", "plans as seconds:cost:bound, separated by blanks"),
                ("trace", "0.1:x:-", "plans as seconds:cost:bound, separated by blanks")):
            for name, place in (("a.csv", "row 2 (line 3)"), ("a.jsonl", "row 2")):
                if name == "a.csv" and not isinstance(wrong, str):
                    continue
                shown = wrong if isinstance(wrong, str) else json.dumps(wrong)
                path = self.file(name, NEEDED, NEEDED | {column: wrong})
                self.assertEqual(self.error_of(path), f"{name}: {place}, column {column}: "
                                                       f"found '{shown}'; expected {expected}")

    def test_missing_values_are_refused(self):
        for name, place in (("a.csv", "row 1 (line 2)"), ("a.jsonl", "row 1")):
            self.assertEqual(self.error_of(self.file(name, NEEDED | {"map": None})),
                             f"{name}: {place}, column map: empty; expected a value")
        self.assertEqual(self.error_of(self.file("a.jsonl", NEEDED | {"cost": None})),
                         "a.jsonl: row 1, column cost: empty in a solved row; "
                         "expected an integer")
        self.assertEqual(self.error_of(self.file("a.jsonl", NEEDED | {"status": "unknown"})),
                         "a.jsonl: row 1, column status: found 'unknown' in a solved row; "
                         "expected one of optimal, bounded, feasible")


class Measures(unittest.TestCase):
    def test_measures_of_four_rows(self):
        found = measures([row(runtime_s=1.0, sqr=0.9, roots=4, rtsp_calls=10),
                          row(instance="j", runtime_s=3.0, sqr=0.8, roots=2),
                          failed(instance="k", roots=30), failed(instance="l")])
        self.assertEqual((found.instances, found.runs, found.solved, found.success), (4, 4, 2, 0.5))
        self.assertEqual(found.mean_runtime_s, (1 + 3 + 100 + 100) / 4)
        self.assertEqual(found.median_runtime_s, (3 + 100) / 2)
        self.assertEqual(found.par2_s, (1 + 3 + 200 + 200) / 4)
        self.assertAlmostEqual(found.mean_sqr, 0.85)
        self.assertEqual((found.mean_roots, found.mean_rtsp_calls), (12, 10))

    def test_seeds_share_the_weight_of_an_instance(self):
        """Checks that an instance with many seeds has the same weight as an instance with one seed."""
        found = measures([*(row(seed=seed, runtime_s=2.0, sqr=0.5, cost=20) for seed in (1, 2, 3)), failed(seed=4),
                          row(instance="j", seed=1, runtime_s=10.0, sqr=1.0, cost=30), failed(instance="k", seed=1)])
        self.assertEqual((found.instances, found.seeds, found.runs, found.solved), (3, 4, 6, 4))
        self.assertAlmostEqual(found.success, (3 / 4 + 1 + 0) / 3)
        self.assertAlmostEqual(found.mean_runtime_s, ((2 + 2 + 2 + 100) / 4 + 10 + 100) / 3)
        self.assertAlmostEqual(found.median_runtime_s, 26.5)
        self.assertAlmostEqual(found.par2_s, ((2 + 2 + 2 + 200) / 4 + 10 + 200) / 3)
        self.assertEqual((found.mean_sqr, found.mean_cost_ratio), (0.75, 1))

    def test_claims_are_counted_but_not_solved(self):
        found = measures([row(), failed(instance="j", status="claimed", claimed_cost=5),
                          failed(instance="k", status="invalid", cost=3), failed(instance="l")])
        self.assertEqual((found.claimed, found.invalid, found.success), (1, 1, 0.25))
        self.assertEqual(metrics.best_costs([failed(status="claimed", cost=5), failed(status="invalid", cost=3)]), {})

    def test_measures_without_solved_rows(self):
        found = measures([failed(omega="0")])
        self.assertEqual((found.success, found.mean_runtime_s, found.par2_s, found.mean_sqr,
                          found.mean_cost_ratio, found.within_omega), (0, 100, 200, None, None, 0))

    def test_within_omega(self):
        def within(omega, **values):
            return metrics.within_omega(row(omega=omega, **values))
        for cost, found in ((100, True), (101, True), (102, False)):
            self.assertIs(within("0.01", cost=cost, lower_bound=100), found)
        # The cost and the bound count, not the status.
        self.assertIs(within("0.01", status="bounded", cost=102, lower_bound=100), False)
        # 1.1 x 110 is 121, but not exactly in binary.
        self.assertIs(within("0.1", cost=121, lower_bound=110), True)
        self.assertIs(within("0.1", cost=122, lower_bound=110), False)
        self.assertIs(within("0", cost=10, lower_bound=10), True)
        self.assertIs(within("0", cost=10, lower_bound=9), False)
        for status, found in (("optimal", True), ("bounded", True), ("feasible", False)):
            self.assertIs(within("0.01", status=status), found)  # without a bound the status counts
        for omega in ("inf", ""):
            self.assertIsNone(within(omega, status="optimal", lower_bound=10))

    def test_rows_within_omega_are_counted(self):
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
        # 10/8 and 30/30; the failed run does not count.
        self.assertEqual(metrics.measures([easy, hard, failed(instance="k", cost=2)], best).mean_cost_ratio,
                         1.125)
        free = row(cost=0)
        self.assertEqual(metrics.cost_ratio(free, metrics.best_costs([free])), 1)
        self.assertIsNone(metrics.cost_ratio(easy, metrics.best_costs([easy, free])))

    def test_cost_ratio_does_not_penalise_solving_harder_instances(self):
        """Checks that only the mean SQR is worse: 10/10 on the easy instance, 10/20 on one that no other method
        solves."""
        exact = [row(status="optimal", cost=10, sqr=1.0),
                 row(instance="j", status="optimal", cost=20, sqr=0.5)]
        other = [row(method="b", cost=11, sqr=10 / 11), failed(method="b", instance="j")]
        best = metrics.best_costs(exact + other)
        exact, other = metrics.measures(exact, best), metrics.measures(other, best)
        self.assertLess(exact.mean_sqr, other.mean_sqr)
        self.assertEqual((exact.mean_cost_ratio, other.mean_cost_ratio), (1, 1.1))

    def test_configurations_separate_methods_omegas_and_limits(self):
        made = [row(), row(omega="0"), row(time_limit_s=7.0), row(tasks=20, method="b")]
        found = metrics.by_configuration(made, metrics.best_costs(made))
        self.assertEqual({configuration: set(lines) for configuration, lines in found.items()},
                         {Configuration("m", 5, 10): {Line("a", "", 100), Line("a", "0", 100), Line("a", "", 7.0)},
                          Configuration("m", 5, 20): {Line("b", "", 100)}})

    def test_median_run_of_several_seeds(self):
        def time_of(*runs):
            return metrics.median_runs(runs)["i"][Line("a", "", 100)].runtime_s
        self.assertEqual(time_of(row(runtime_s=5), row(runtime_s=1), row(runtime_s=3)), 3)
        self.assertEqual(time_of(row(runtime_s=5), failed()), 5)
        self.assertEqual(time_of(row(runtime_s=5), failed(), failed()), 100)
        # A solved run above the limit still counts as solved.
        self.assertEqual(time_of(row(runtime_s=101), failed()), 101)

    def test_solved_over_time(self):
        self.assertEqual(metrics.solved_over_time([row(runtime_s=5), failed(), row(runtime_s=2)]), [2, 5])

    def test_only_solver_lists_instances_no_other_method_solves(self):
        runs = metrics.median_runs([
            row(), failed(method="b"), row(instance="j"), row(instance="j", method="b"),
            row(instance="k"), failed(instance="l"), failed(instance="l", method="b"),
            row(instance="n"), row(instance="n", omega="0"), failed(instance="n", method="b")])
        self.assertEqual({(line.method, line.omega): [found.instance for found in rows]
                          for line, rows in metrics.only_solver(runs).items()},
                         {("a", ""): ["i", "n"], ("a", "0"): ["n"]})

    def test_instances_beyond_the_baselines_are_counted(self):
        runs = metrics.median_runs([
            row(), failed(method="base"), row(instance="j"), row(instance="j", method="base"),
            row(instance="k")])  # no baseline tried k
        self.assertEqual(metrics.beyond_baselines(runs, lambda line: line.method == "base"),
                         {Line("a", "", 100): 1})


class Speedups(unittest.TestCase):
    """Tests the speed-up of method a over baselines x and y on five instances."""

    def setUp(self):
        def times(instance, **seconds):
            return [failed(instance=instance, method=method) if time is None else
                    row(instance=instance, method=method, runtime_s=time)
                    for method, time in seconds.items()]
        runs = metrics.median_runs([
            *times("p", x=10, y=20, a=2),       # best 10
            *times("q", x=None, y=30, a=10),    # best 30: x failed
            *times("r", x=50, y=40, a=None),    # best 40
            *times("easy", x=0.5, y=90, a=9),   # best 0.5: too easy, omitted
            *times("hard", x=None, y=None, a=1)])
        self.found = {(each.map, each.baseline.method, each.line.method): each
                      for each in speedup.speedups(runs, lambda line: line.method in "xy")}

    def test_speedup_over_the_best_baseline(self):
        found = self.found["", "best baseline", "a"]
        # 10/2, 30/10, 40/100
        self.assertEqual((found.instances, found.median_ratio, found.line_failed, found.baseline_failed),
                         (3, 3.0, 1, 0))
        self.assertEqual((found.baseline_median_s, found.line_median_s), (30, 10))
        self.assertEqual(found.sure, "exactly")  # exact, because 40/100 is the smallest ratio in any case

    def test_speedup_over_one_baseline(self):
        found = self.found["", "x", "a"]
        # 10/2, 100+/10, 50/100+
        self.assertEqual((found.median_ratio, found.baseline_failed, found.line_failed), (5, 1, 1))
        self.assertEqual(found.sure, "exactly")
        self.assertEqual(self.found["", "y", "x"].median_ratio, 0.8)  # 20/10, 30/100+, 40/50

    def test_failures_bound_the_median_ratio(self):
        pairs = [(failed(), row(runtime_s=10)), (row(runtime_s=10), row(runtime_s=10))]
        self.assertEqual(speedup._sure(pairs, 5.5), "at least")
        self.assertEqual(speedup._sure([(mine, other) for other, mine in pairs], 0.55), "at most")
        self.assertEqual(speedup._sure([(failed(), failed())], 1), "about")

    def test_speedups_of_one_map_equal_the_total(self):
        self.assertEqual(self.found["m", "x", "a"][3:], self.found["", "x", "a"][3:])

    def test_zero_runtime_counts_as_one_millisecond(self):
        runs = metrics.median_runs([row(method="x", runtime_s=2), row(runtime_s=0)])
        found = speedup.speedups(runs, lambda line: line.method == "x")
        self.assertEqual([each.median_ratio for each in found if each.line.method == "a"], [2000] * 4)


class Proofs(unittest.TestCase):
    def contradictions(self, *found):
        return [each.what for each in proofs.contradictions(found)]

    def test_consistent_proofs_have_no_contradiction(self):
        optimal = {"status": "optimal", "cost": 10, "lower_bound": 10}
        rows_ = [row(**optimal), row(method="b", **optimal), row(method="c", cost=12, lower_bound=9),
                 row(instance="j", status="optimal", cost=11), failed(method="d", lower_bound=10)]
        self.assertEqual(self.contradictions(*rows_), [])
        self.assertEqual(proofs.optimal_agreements(rows_), 1)

    def test_differing_optimal_costs_contradict(self):
        self.assertEqual(self.contradictions(row(status="optimal", cost=10), row(method="b", status="optimal", cost=11),
                                             row(method="c", omega="0", status="optimal", cost=11)),
                         ["optimal costs differ: 10 (a), 11 (b, c ω=0)"])

    def test_plan_below_a_bound_contradicts(self):
        self.assertEqual(self.contradictions(row(cost=10), failed(method="b", lower_bound=11)),
                         ["a plan costs 10 (a), below a proven lower bound: 11 (b)"])
        self.assertEqual(self.contradictions(row(cost=10), row(method="b", cost=12, root_cost=11)),
                         ["a plan costs 10 (a), below the root cost: 11 (b)"])
        self.assertEqual(self.contradictions(row(cost=10), row(method="b", status="optimal", cost=11)),
                         ["a plan costs 10 (a), less than the optimal cost: 11 (b)"])

    def test_plan_of_an_infeasible_instance_contradicts(self):
        self.assertEqual(self.contradictions(row(), failed(method="b", status="infeasible")),
                         ["a plan costs 10 (a); but: infeasible (b)"])

    def test_bounds_without_following_do_not_apply_with_following(self):
        self.assertEqual(self.contradictions(row(cost=10), row(method="b", status="optimal", cost=12, lower_bound=12,
                                                               options="--omega 0 --no-following")), [])
        found = self.contradictions(row(method="b", cost=10, options="--no-following"), failed(lower_bound=11))
        self.assertEqual(len(found), 1)

    def test_other_problems_and_errors_do_not_contradict(self):
        self.assertEqual(self.contradictions(row(status="optimal", cost=10),
                                             row(problem="cts", status="optimal", cost=11),
                                             failed(method="b", status="error", cost=3, lower_bound=99)), [])


class FalseClaims(unittest.TestCase):
    def false_claims(self, *found, **known):
        return [(each.method, each.kind, each.claimed, each.checked) for each in proofs.false_claims(found, **known)]

    def test_true_claims_are_accepted(self):
        found = self.false_claims(row(lower_bound=9), row(method="x", cost=11, claimed_cost=11, claimed_lower_bound=10),
                                  failed(method="y", status="claimed", claimed_cost=9),
                                  row(method="z", cost=11, claimed_cost=12,
                                      trace=(rows.Point(1, 12, 8), rows.Point(2, 11, 10)), solver="z"))
        self.assertEqual(found, [])

    def test_invalid_plan_is_a_false_claim(self):
        found = proofs.false_claims([failed(method="x", status="invalid", error="agents 3 and 7 collide", seed=4)])
        self.assertEqual([(each.method, each.seed, each.kind, each.what) for each in found],
                         [("x", 4, "plan", "agents 3 and 7 collide")])

    def test_claimed_cost_below_the_checked_cost_is_false(self):
        self.assertEqual(self.false_claims(row(method="x", cost=10, claimed_cost=9)), [("x", "cost", 9, 10)])
        self.assertEqual(self.false_claims(row(method="x", cost=10, solver="x", trace=(rows.Point(1, 9, None),))),
                         [("x", "cost", 9, 10)])
        # Without a plan file a claimed cost is false only if it lies below a proven bound.
        claimed = failed(method="x", status="claimed", claimed_cost=9)
        self.assertEqual(self.false_claims(failed(lower_bound=10), claimed), [("x", "cost", 9, 10)])
        self.assertEqual(self.false_claims(failed(lower_bound=10, options="--no-following"), claimed), [])

    def test_claimed_bound_above_a_plan_is_false(self):
        bound = failed(method="x", claimed_lower_bound=11)
        self.assertEqual(self.false_claims(row(), bound), [("x", "lower bound", 11, 10)])
        self.assertEqual(self.false_claims(row(method="x", claimed_lower_bound=11)), [("x", "lower bound", 11, 10)])
        self.assertEqual(self.false_claims(bound, known_costs={("mg", "i"): 10}), [("x", "lower bound", 11, 10)])
        # An invalid plan refutes no bound.
        self.assertEqual(self.false_claims(failed(method="y", status="invalid", cost=10), bound),
                         [("y", "plan", None, None)])


class OverTime(unittest.TestCase):
    """Tests the quality of plans and bounds over time."""

    def points(self, *found):
        return tuple(rows.Point(*each) for each in found)

    def test_plans_of_a_run(self):
        def plans(**values):
            return anytime.plans_over_time(row(wall_s=9.0, **values))
        self.assertEqual(plans(), [(9, 10)])  # without a trace: only at the end of the run
        self.assertEqual(plans(trace=self.points((1, 14, None), (2, 10, None))), [(1, 14), (2, 10)])
        # The final plan is not in the trace, or the trace claims a lower cost than the final plan has.
        self.assertEqual(plans(trace=self.points((1, 14, None))), [(1, 14), (9, 10)])
        self.assertEqual(plans(trace=self.points((1, 14, None), (2, 8, None))), [(1, 14), (9, 10)])
        self.assertEqual(anytime.plans_over_time(failed(status="invalid", cost=3)), [])

    def test_bounds_of_a_run(self):
        traced = row(wall_s=9.0, trace=self.points((1, 14, 7), (2, 12, 7), (3, 10, 8)), lower_bound=9)
        self.assertEqual(anytime.bounds_over_time(traced), [(1, 7), (3, 8), (9, 9)])

    def panel(self, found, known=()):
        best = metrics.best_costs(found, known)
        panel, = anytime.panels(found, best, metrics.best_bounds(found))
        return panel

    def test_mean_is_over_common_instances_with_plan_share(self):
        def run(method, instance, *trace):
            return row(method=method, instance=instance, cost=trace[-1][1], wall_s=50.0, anytime=True,
                       trace=self.points(*trace))
        panel = self.panel([
            run("a", "i", (1, 20, 8), (3, 10, 9)), run("a", "j", (2, 30, 8), (5, 20, 10)), run("a", "k", (4, 99, 9)),
            run("b", "i", (2, 12, None)), run("b", "j", (2, 25, None)), failed(method="b", instance="k", anytime=True)])
        self.assertEqual((panel.instances, panel.common), (3, 2))
        curve = panel.curves[Line("a", "", 100)]
        steps = [(step.seconds, round(3 * step.with_plan), step.common_with_plan, step.cost_ratio)
                 for step in curve.steps]
        self.assertEqual(steps, [(1, 1, 0.5, 2), (2, 2, 1, 1.75), (3, 2, 1, 1.25), (4, 3, 1, 1.25), (5, 3, 1, 1)])
        # Mean of 8/10 and 8/20, and mean of 9/10 and 10/20.
        self.assertAlmostEqual(curve.at(2).bound_ratio, 0.6)
        self.assertAlmostEqual(curve.at(99).bound_ratio, 0.7)
        self.assertIsNone(curve.at(1).bound_ratio)
        self.assertIsNone(curve.at(0.5))
        other = panel.curves[Line("b", "", 100)]
        self.assertAlmostEqual(other.at(9).cost_ratio, (1.2 + 1.25) / 2)
        self.assertAlmostEqual(other.at(9).with_plan, 2 / 3)

    def test_curves_weigh_instances_not_seeds(self):
        found = [row(seed=1, cost=10, trace=self.points((1, 20, None), (2, 10, None))),
                 row(seed=2, cost=12, trace=self.points((1, 12, None))),
                 row(seed=1, instance="j", cost=30, trace=self.points((1, 60, None), (2, 30, None)))]
        curve = self.panel(found).curves[Line("a", "", 100)]
        self.assertAlmostEqual(curve.at(1).cost_ratio, ((2 + 1.2) / 2 + 2) / 2)
        self.assertAlmostEqual(curve.at(2).cost_ratio, ((1 + 1.2) / 2 + 1) / 2)

    def test_plan_of_unknown_cost_counts_as_plan(self):
        curve = self.panel([row(anytime=True, first_plan_s=0.5, wall_s=100.0)]).curves[Line("a", "", 100)]
        self.assertEqual([(step.seconds, step.with_plan, step.cost_ratio) for step in curve.steps],
                         [(0.5, 1, None), (100, 1, 1)])

    def test_methods_without_anytime_plans_are_omitted(self):
        self.assertEqual(anytime.panels([row()], {("mg", "i"): 10}, {}), [])

    def test_known_costs_lower_the_best_cost(self):
        curve = self.panel([row(anytime=True)], {("mg", "i"): 8}).curves[Line("a", "", 100)]
        self.assertEqual(curve.steps[-1].cost_ratio, 1.25)

    def test_times_of_the_table(self):
        self.assertEqual(anytime.table_times(1.0), [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0])


class Logs(Folder):
    HEADER = {"event": "header", "instance": "maps/i.cts.json", "agents": 5, "options": "--omega 0"}

    def log(self, name, *events, end="\n"):
        return self.text(name, "\n".join(json.dumps(event) for event in (self.HEADER, *events)) + end)

    def test_log_of_a_complete_run(self):
        path = self.log("a.jsonl", {"event": "bound", "time_s": 0.1, "lower_bound": 8, "incumbent": None},
                        {"event": "counts", "time_s": 0.1, "counts": {}},
                        {"event": "progress", "time_s": 0.2, "lower_bound": 8, "incumbent": None},
                        {"event": "incumbent", "time_s": 0.5, "lower_bound": 8, "incumbent": 12},
                        {"event": "summary", "status": "bounded", "cost": 12, "lower_bound": 9,
                         "stats": {"wall_s": 2.5}})
        run = logs.read_log(path)
        self.assertEqual((run.name, run.instance, run.agents, run.status, run.end_s),
                         ("a", "maps/i.cts.json", 5, "bounded", 2.5))
        self.assertEqual([tuple(moment) for moment in run.moments], [(0.1, None, 8), (0.5, 12, 8), (2.5, 12, 9)])

    def test_sources_of_the_bound(self):
        path = self.log("a.jsonl", {"event": "bound", "time_s": 0.1, "lower_bound": 8, "raised_by": {"sequences": 8}},
                        {"event": "progress", "time_s": 0.2, "lower_bound": 8},
                        {"event": "bound", "time_s": 0.5, "lower_bound": 11, "raised_by": {"cores": 2, "wdg": 1}},
                        {"event": "incumbent", "time_s": 0.7, "lower_bound": 12, "incumbent": 12,
                         "raised_by": {"cores": 1, "oracle": 0}})
        run = logs.read_log(path)
        self.assertEqual([tuple(rise) for rise in run.rises],
                         [(0.1, 8, {"individual": 8}), (0.5, 11, {"cores": 2, "wdg": 1}), (0.7, 12, {"cores": 1})])
        self.assertEqual(run.shares(), {"individual": 8, "wdg": 1, "cores": 3})
        other = logs.read_log(self.log("b.jsonl", {"event": "bound", "time_s": 1, "lower_bound": 8,
                                                   "raised_by": {"oracle": 8}}))
        self.assertEqual(list(logs.bound_sources([run, other])), ["individual", "wdg", "cores", "oracle"])

    def test_log_with_incomplete_last_line(self):
        run = logs.read_log(self.log("a.jsonl", {"event": "bound", "time_s": 1, "lower_bound": 8},
                                     end='\n{"event": "b'))
        self.assertEqual((run.status, len(run.moments)), ("", 1))

    def test_logs_are_recognised_by_their_first_line(self):
        log, other = self.log("a.jsonl"), self.text("c.jsonl", '{"no": "event"}\n')
        self.assertEqual(logs.parted([self.folder]), ([], [log]))
        table = self.file("results.jsonl", NEEDED)
        self.assertEqual(logs.parted([self.folder]), ([self.folder], [log]))
        self.assertEqual(logs.parted([table, log, other]), ([table, other], [log]))

    def test_malformed_events_are_refused(self):
        for event, message in (({"event": "bound", "time_s": 1, "lower_bound": 8, "raised_by": 8},
                                "raised_by: found '8'; expected an object"),
                               ({"event": "bound", "time_s": 1, "lower_bound": 8, "raised_by": {"cores": -1}},
                                "raised_by, cores: found '-1'; expected an integer"),
                               ({"event": "bound", "time_s": "x", "lower_bound": 8},
                                "time_s: found '\"x\"'; expected a number"),
                               ({"event": "bound", "time_s": 1, "lower_bound": 1.5},
                                "lower_bound: found '1.5'; expected an integer")):
            with self.assertRaises(BadInput) as caught:
                logs.read_log(self.log("a.jsonl", event))
            self.assertIn(f"a.jsonl: line 2, {message}", str(caught.exception))


class Tracker(Folder):
    """Tests the rows for MAPF Tracker, and the best known values read from it."""

    NAME = "random-32-32-20-random-3-2"

    def row(self, **values):
        return row(**({"instance": self.NAME, "map": "random-32-32-20", "agents": 2, "tasks": 0, "problem": "mapf",
                       "cost": 5} | values))

    def plan(self, name, text):
        return str(self.text(name, text))

    def grove_plan(self, *paths):
        return json.dumps({"agents": [{"path": path} for path in paths]})

    def test_scenario_is_derived_from_the_instance_name(self):
        def place(**values):
            found = tracker.place_of(self.row(**values))
            return found and tuple(found)
        self.assertEqual(place(), ("random-32-32-20", "random", 3, 2))
        self.assertEqual(place(instance="movingai/" + self.NAME), ("random-32-32-20", "random", 3, 2))
        self.assertEqual(place(instance="random-32-32-20-even-25-2"), ("random-32-32-20", "even", 25, 2))
        for values in ({"problem": "cts"}, {"agents": 3}, {"map": "empty-8-8"}, {"instance": "random-32-32-20-odd-3-2"},
                       {"instance": "mine-random-3-2", "map": "mine"}):
            self.assertIsNone(place(**values), values)

    def test_submission_lists_rows_and_omissions(self):
        # Two agents. At the end of its path, one of them waits for the other.
        path = [[0, 2], [1, 2], [1, 2], [1, 1], [1, 1], [1, 1]]
        cheap = self.plan("a.plan.json", self.grove_plan(path, [[5, 5], [5, 6], [5, 7]]))
        found = [self.row(plan_file=cheap, lower_bound=4), self.row(seed=1, cost=7, plan_file="expensive"),
                 self.row(instance="random-32-32-20-random-4-2", cost=None, status="unknown", solved=False),
                 self.row(instance="mine-random-3-2", map="mine"),
                 self.row(instance="random-32-32-20-random-5-2",
                          plan_file=self.plan("b", self.grove_plan(path, [[1, 2], [3, 2]]))),
                 self.row(instance="random-32-32-20-random-6-2")]
        done = tracker.submission(found, metrics.best_costs(found))
        self.assertEqual(done.text,
                         "map_name,scen_type,type_id,agents,lower_cost,solution_cost,flip_up_down,solution_plan\n"
                                    'random-32-32-20,random,3,2,4,5,FALSE,"rwu\n2d"\n')
        self.assertEqual(sum(done.omitted.values()), 5)
        self.assertEqual(sorted(why.replace(f"{self.folder}/", "") for why in done.omitted), [
            "b: agent 1 jumps at time 1",
            "not of a scenario of the Moving AI benchmark (expected the name MAP-even-N-AGENTS or MAP-random-N-AGENTS)",
            "not the cheapest plan of the instance",
            "without a checked plan (status unknown)", "without a plan file (grove bench --keep-plans)"])

    def test_refuted_bounds_are_not_submitted(self):
        plan = self.plan("a", self.grove_plan([[0, 0], [1, 0], [2, 0]], [[0, 5], [1, 5], [2, 5], [3, 5]]))
        for values, bound in (({"lower_bound": 4}, "4"), ({"claimed_lower_bound": 5}, "5"), ({}, ""),
                              ({"claimed_lower_bound": 6}, ""), ({"lower_bound": 5, "options": "--no-following"}, "")):
            found = [self.row(plan_file=plan, **values)]
            line = tracker.submission(found, metrics.best_costs(found)).text.split("\n")[1]
            self.assertTrue(line.startswith(f"random-32-32-20,random,3,2,{bound},5,"), (values, line))

    def test_malformed_plans_are_refused(self):
        def error_of_plan(text, agents=2):
            with self.assertRaises(plans.BadPlan) as caught:
                plans.read_plan(Path(self.plan("p", text)), agents)
            return str(caught.exception)
        self.assertEqual(error_of_plan(self.grove_plan([[0, 0], [2, 0]], [[5, 5]])), "agent 0 jumps at time 1")
        self.assertEqual(error_of_plan(self.grove_plan([[0, 0]])), "paths of 1 agents; expected 2")
        self.assertEqual(error_of_plan("nothing"), "found no plan; expected a plan file of Grove")
        self.assertEqual(error_of_plan(self.grove_plan([["a"], ["b"]], [[5, 5]])), "agent 0 jumps at time 1")
        self.assertEqual(error_of_plan(self.grove_plan(7, [[5, 5]])), "found no plan; expected a plan file of Grove")
        paths = plans.read_plan(Path(self.plan("p", self.grove_plan([[0, 0], [1, 0], [1, 0]], [[5, 5]]))), 2)
        self.assertEqual(plans.cost_of(paths), 1)

    def known(self, name, text):
        return tracker.read_known([self.text(name, text)])

    def test_best_known_values_are_read(self):
        place = tracker.Place("random-32-32-20", "random", 3, 2)
        head = "map_name,scen_type,type_id,agents,lower_cost,solution_cost,flip_up_down,solution_plan\n"
        for name, text in (
                ("a.csv", f'{head}random-32-32-20,random,3,2,4,6,true,"u\n{"d" * 200000}"\n'),
                ("random-32-32-20.csv",
                 '\ufeff"scen_type","type_id","agents","lower_cost","lower_date","solution_cost"\r\n'
                                        '"random","3","2","4","2022-11-29","6"\r\n'),
                ("random-32-32-20-random-3.csv", "agents,lower_cost,solution_cost\n2,4,6\n"),
                ("b.json", json.dumps([{"map_name": "random-32-32-20", "scen_type": "random", "type_id": 3, "agents": 2,
                                        "lower_cost": 4, "solution_cost": 6}]))):
            self.assertEqual(self.known(name, text), {place: tracker.Known(4, 6)}, name)
        self.assertEqual(self.known("a.csv", head + "m,even,1,2,7,,,\nm,even,1,2,,9,,\nm,even,1,2,null,undefined,,\n"),
                         {tracker.Place("m", "even", 1, 2): tracker.Known(7, 9)})

    def test_malformed_downloads_are_refused(self):
        for name, text, message in (
                ("a.csv", "x,y\n",
                 "a.csv: line 1: missing column agents; expected the columns of a download of MAPF Tracker"),
                ("a.csv", "agents,lower_cost,solution_cost\n2,4,6\n", "a.csv: line 2: missing scen_type; expected"),
                ("a-even-1.csv", "agents,lower_cost,solution_cost\n2,x,6\n",
                 "a-even-1.csv: line 2, lower_cost: found 'x'; expected an integer of at least 0"),
                ("a.json", "[", "a.json: not JSON; expected a list of objects"),
                ("a.txt", "", "a.txt: expected a .csv or .json of MAPF Tracker")):
            with self.assertRaises(BadInput) as caught:
                self.known(name, text)
            self.assertIn(f"{self.folder}/{message}", str(caught.exception))

    def test_rows_are_compared_with_the_best_known_values(self):
        known = {tracker.place_of(self.row()): tracker.Known(4, 6)}

        def flags(*found):
            return [(each.cost, each.bound, each.better_plan, each.higher_bound, each.closes)
                    for each in tracker.comparisons(found, known)]
        self.assertEqual(flags(self.row(cost=6, lower_bound=4)), [(6, 4, False, False, False)])
        self.assertEqual(flags(self.row(cost=5, lower_bound=5)), [(5, 5, True, True, True)])
        self.assertEqual(flags(failed(**self.row(cost=None)._asdict() | {"lower_bound": 6, "status": "unknown"})),
                         [(None, 6, False, True, True)])
        self.assertEqual(flags(self.row(cost=7), self.row(seed=1, cost=5)), [(5, None, True, False, False)])
        self.assertEqual(flags(self.row(problem="cts")), [])

    def test_contradictions_with_best_known_values(self):
        def contradictions(known, *found):
            return [each.what for each in proofs.contradictions(found, {("mapf", self.NAME): tracker.Known(*known)})]
        self.assertEqual(contradictions((4, 6), self.row(cost=4, lower_bound=4),
                                        failed(**self.row()._asdict() | {"cost": None})), [])
        self.assertEqual(contradictions((6, 6), self.row(cost=5)),
                         ["MAPF Tracker has a lower bound of 6; a plan costs 5 (a)"])
        self.assertEqual(contradictions((4, 5), self.row(cost=7, lower_bound=6)),
                         ["MAPF Tracker has a plan of cost 5, below a proven lower bound: 6 (a)"])


class CommonInstances(unittest.TestCase):
    """Tests instances that every method solves, among the methods that solve any instance."""

    def measured(self, found):
        return {line.method: each for line, each in
                metrics.measures_by_line(found, metrics.best_costs(found)).items()}

    def test_common_instances_exclude_methods_that_solve_none(self):
        found = [row(instance="easy", method="a", sqr=1.0, cost=10), row(instance="hard", method="a", sqr=0.5, cost=20),
                 row(instance="easy", method="b", sqr=0.8, cost=12), failed(instance="hard", method="b"),
                 failed(instance="easy", method="c"), failed(instance="hard", method="c")]
        a, b, c = (self.measured(found)[method] for method in "abc")
        self.assertEqual([each.common for each in (a, b, c)], [1, 1, 1])
        self.assertEqual((a.mean_sqr, a.common_sqr, a.common_cost_ratio), (0.75, 1.0, 1.0))
        self.assertEqual((b.mean_sqr, b.common_sqr, b.common_cost_ratio), (0.8, 0.8, 1.2))
        self.assertEqual((c.common_sqr, c.common_cost_ratio), (None, None))

    def test_common_instances_need_two_methods(self):
        measured = self.measured([row(method="a", sqr=1.0), failed(method="b")])["a"]
        self.assertEqual((measured.common, measured.common_sqr), (0, None))

    def test_common_instances_are_solved_with_every_seed(self):
        found = [row(method="a", seed=1, sqr=0.8, cost=12, runtime_s=2),
                 row(method="a", seed=2, sqr=0.6, cost=14, runtime_s=4),
                 row(method="b", seed=1, sqr=1.0, cost=10)]
        a = self.measured(found)["a"]
        self.assertEqual((a.common, a.common_mean_cost, a.common_median_cost, a.common_mean_s), (1, 13, 13, 3))
        self.assertAlmostEqual(a.common_sqr, 0.7)
        a = self.measured([*found, failed(method="a", seed=3)])["a"]
        self.assertEqual((a.common, a.common_mean_cost), (0, None))


class LinesAndFamilies(unittest.TestCase):
    def test_default_method_is_labelled_grove(self):
        lines = Lines([row(method="auto"), row(method="hcbs")], [])
        self.assertEqual([lines.label(line) for line in lines.all], ["Grove", "hcbs"])
        lines = Lines([row(method="auto"), row(method="Grove")], [])
        self.assertEqual({lines.label(line) for line in lines.all}, {"Grove", "auto"})

    def test_labels_distinguish_omegas_and_limits(self):
        found = [row(method="a", omega="0"), row(method="a", omega="inf"), row(method="b", omega="0.01"),
                 row(method="c"), row(method="c", time_limit_s=7.5)]
        lines = Lines(found, ["b"])
        self.assertEqual([lines.label(line) for line in lines.all],
                         ["a, ω = 0", "a, ω = ∞", "c, limit 7.5 s", "c, limit 100 s", "b, ω = 0.01"])
        self.assertEqual([lines.name(line) for line in lines.all],
                         ["a", "a", "c, limit 7.5 s", "c, limit 100 s", "b"])

    def test_labels_omit_a_common_omega(self):
        def labels(*found):
            lines = Lines(found, [])
            return [lines.label(line) for line in lines.all]
        self.assertEqual(labels(row(omega="0"), row(method="b", omega="0")), ["a", "b"])
        # Different problems never share a figure.
        self.assertEqual(labels(row(omega="0"), row(method="b", omega="1", problem="cts")), ["a", "b"])

    def test_families_are_derived_from_options(self):
        found = [row(method=method, omega=omega, options=options) for method, omega, options in (
            ("one", "0", "--method x --omega 0 --seed 1"), ("two", "inf", "--method x --omega=inf --seed 1"),
            ("three", "0.1", "--method x --seed 2 --omega 0.1"), ("four", "0", "--method y --omega 0"))]
        self.assertEqual([[line.method for line in family.lines] for family in families(found)],
                         [["one", "two"]])
        named = families(found, ("one", "three", "four"))
        self.assertEqual([[line.method for line in family.lines] for family in named],
                         [["four", "one", "three"]])

    def test_families_are_derived_from_names(self):
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
    def test_points_of_lines_are_dodged(self):
        self.assertEqual(scales.dodged([10, 30], "abc"), {"a": -0.5, "b": 0, "c": 0.5})
        self.assertEqual(scales.dodged([10, 15, 30], "ab"), {"a": -0.125, "b": 0.125})
        self.assertEqual(scales.dodged([10], "ab"), {"a": 0, "b": 0})
        self.assertEqual(scales.dodged([10, 30], "a"), {"a": 0})

    def test_values_are_rounded_down(self):
        for value, rounded in ((1, 1), (0.9, 0.3), (0.3, 0.3), (0.29, 0.1), (0.0081, 0.003), (0.002, 0.001)):
            self.assertAlmostEqual(scales.rounded_down(value), rounded, places=12)

    def test_time_axis_begins_below_the_fastest_run(self):
        self.assertEqual(scales.first_time([row(runtime_s=0.0042), row(runtime_s=2)]), 0.003)
        self.assertEqual(scales.first_time([row(runtime_s=0), row(runtime_s=0.05)]), 0.03)
        self.assertEqual(scales.first_time([row(runtime_s=50)]), 1)
        self.assertEqual(scales.first_time([failed()]), 1)

    def test_lines_drawn_first_have_larger_depth(self):
        for count in (1, 2, 8, 30):
            depths = [style.depth(rank, count) for rank in range(count)]
            self.assertEqual((depths, depths[-1]), (sorted(set(depths), reverse=True), 0))
            self.assertLessEqual(depths[0], 1)


class Tables(unittest.TestCase):
    def test_numbers_are_formatted(self):
        self.assertEqual([seconds(value) for value in (0, 0.0123456, 1.23456, 12.3456, 180, 9876.5)],
                         ["<0.001", "0.0123", "1.23", "12.3", "180", "9876"])
        self.assertEqual([csv_value(value) for value in (None, 3, 0.5, math.pi, "a")],
                         ["", "3", "0.5", "3.14159", "a"])

    def test_text_is_escaped_in_html(self):
        self.assertNotIn("<script>", html_table(["<script>"], [[word("<script>", "<script>")]]))


if __name__ == "__main__":
    unittest.main()
