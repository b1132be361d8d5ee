#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the command `grove bench`."""
import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from waiting import HANG_S, state_of, wait_until  # noqa: E402

DATA = Path(__file__).resolve().parents[3] / "benchmarks/data"
GROVE = os.environ.get("GROVE", "")


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    # --- instances ---

    def generate(self, name, agents, tasks, seed, *more):
        path = self.folder / "instances" / f"{name}.cts.json"
        path.parent.mkdir(exist_ok=True)
        self.run_well("generate", "instance", "--map", DATA / "rooms-32x32.map", "--agents", agents,
                      "--tasks", tasks, "--seed", seed, "-o", path, *more)
        return path

    def easy(self, count):
        return [self.generate(f"easy_s{k}_n3_m4", 3, 4, k) for k in range(1, count + 1)]

    def hard(self, count):
        """Generates instances whose proof of optimality takes many seconds."""
        return [self.generate(f"hard_s{k}_n18_m30", 18, 30, k + 7) for k in range(1, count + 1)]

    # --- running ---

    def start(self, *arguments):
        return subprocess.Popen([GROVE, *map(str, arguments)], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def bench(self, *more, runs=("exact: --omega 0", "paper: --policy fixed"), limit=10, jobs=2):
        methods = [word for run in runs for word in ("--run", run)]
        return ["bench", "instances", *methods, "--output-dir", "out", "--time-limit", limit,
                "--jobs", jobs, *more]

    def run_well(self, *arguments):
        running = self.start(*arguments)
        out, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 0, err)
        return out

    def refuses(self, arguments, *texts):
        """Checks that the command exits with code 2 and prints one error line that contains the texts."""
        running = self.start(*arguments)
        out, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 2, out + err)
        self.assertRegex(err, r"\Agrove: error: [^\n]*\n\Z")
        for text in texts:
            self.assertIn(text, err)

    @staticmethod
    def lives(pid):
        return state_of(pid) not in (None, "Z", "X")

    @staticmethod
    def children(pid):
        found = set()
        for task in Path(f"/proc/{pid}/task").glob("*/children"):
            found |= {int(word) for word in task.read_text().split()}
        return found

    def runs(self, pid):
        """Returns the runs of a bench, without the trial runs before it locks its folder."""
        return self.children(pid) if (self.folder / "out/.lock").exists() else set()

    # --- results ---

    def lines(self):
        file = self.folder / "out/results.jsonl"
        return file.read_text().splitlines(keepends=True) if file.exists() else []

    def rows(self):
        """Returns {(instance, method): row}. Fails if a row occurs twice."""
        rows = [json.loads(line) for line in self.lines()]
        by_run = {(row["instance"], row["method"]): row for row in rows}
        self.assertEqual(len(by_run), len(rows))
        return by_run

    def table(self):
        with open(self.folder / "out/results.csv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


def as_cell(value):
    """Returns a value of results.jsonl as results.csv writes it, up to the digits of numbers."""
    if value is None:
        return ""
    return value if isinstance(value, str) else json.dumps(value)


def number_or_text(cell):
    """Returns the number or text in a cell. A text that a spreadsheet would take for a formula is preceded by an
    apostrophe.

    Different digits can mean the same number: 0.78419199999999999 is 0.784192."""
    try:
        return float(cell)
    except ValueError:
        return cell[1:] if re.match("'[=+@-]", cell) else cell


class Results(Program):
    def test_rows_agree_with_the_plan_files(self):
        self.easy(2)
        self.generate("easy_s1_n3_m4_mg", 3, 4, 1, "--mg")
        output = self.run_well(*self.bench("--keep-plans", "--seed", 3))
        self.assertRegex(output, r"exact +3/3 +\d+\.\d\d +0\n")
        self.assertRegex(output, r"paper +3/3 +\d+\.\d\d +0\n")
        self.assertTrue(output.endswith("\ntable: out/results.csv\n"), output)
        rows = self.rows()
        self.assertEqual(len(rows), 6)
        for (instance, method), row in rows.items():
            self.assertEqual(row["plan_file"], f"plans/{method}+seed3/{instance}.plan.json")
            file = self.folder / "out" / row["plan_file"]
            plan = json.loads(file.read_text())
            self.run_well("check", self.folder / f"instances/{instance}.cts.json", file)
            stats = plan["stats"]
            for column in ("cost", "lower_bound", "status"):
                self.assertEqual(row[column], plan[column])
            for column, key in (("roots", "roots_generated"), ("nodes", "nodes_expanded"),
                                ("rtsp_calls", "rtsp_calls"), ("version", "version"),
                                ("low_level_calls", "low_level_calls"), ("seed", "seed"),
                                ("threads", "threads")):
                self.assertEqual(row[column], stats[key], column)
            counts = dict(word.split("=") for word in row["counts"].split())
            self.assertEqual(counts, {name: str(stats[name]) for name in counts})
            self.assertIn("nodes_generated", counts)
            self.assertEqual((row["seed"], row["threads"], row["time_limit_s"]), (3, 1, 10))
            self.assertEqual(row["omega"], "0" if method == "exact" else "0.01")
            self.assertEqual(str(plan["omega"]), row["omega"])
            self.assertIs(row["solved"], True)
            self.assertEqual((row["agents"], row["tasks"], row["map"]), (3, 4, "rooms-32x32"))
            self.assertEqual(row["problem"], "mg" if instance.endswith("_mg") else "cts")
            self.assertEqual(row["scenario"], int(instance.split("_")[1][1:]))
            self.assertLessEqual(row["root_cost"], row["cost"])
            self.assertAlmostEqual(row["sqr"], row["root_cost"] / row["cost"], 5)
            self.assertEqual(row["runtime_s"], row["wall_s"])
            self.assertGreaterEqual(row["wall_s"] + 0.01, stats["wall_s"])
        # The rows are sorted by scenario, then by method.
        self.assertEqual([(row["scenario"], row["method"]) for row in self.table()],
                         [(k, method) for k in "112" for method in ("exact", "paper")])
        for cells in self.table():
            self.assertNotRegex(cells["options"], "^[=+@-]")
            row = rows[cells["instance"], cells["method"]]
            self.assertEqual({name: number_or_text(cell) for name, cell in cells.items()},
                             {name: number_or_text(as_cell(value)) for name, value in row.items()})

    def test_first_root_of_fixed_policy_costs_the_root_cost(self):
        self.easy(3)
        self.run_well(*self.bench(runs=["first: --policy fixed --omega inf"]))
        for row in self.rows().values():
            self.assertEqual(row["lower_bound"], row["root_cost"])
            self.assertEqual(row["omega"], "inf")

    def test_run_that_reaches_its_time_limit_is_not_solved(self):
        self.hard(1)
        output = self.run_well(*self.bench(runs=["slow: --omega 0", "own: --omega 0 --time-limit 0.2"],
                                         limit=0.3))
        self.assertRegex(output, r"slow +0/1 +0\.30 +0\n")
        for (_, method), row in self.rows().items():
            limit = 0.3 if method == "slow" else 0.2
            self.assertIs(row["solved"], False)
            self.assertIn(row["status"], ("unknown", "feasible"))
            self.assertEqual(row["error"], "time limit")
            self.assertEqual((row["time_limit_s"], row["runtime_s"]), (limit, limit))
            self.assertGreaterEqual(row["wall_s"], limit)
            self.assertIsNone(row["sqr"])

    def test_scenarios_and_run_options_are_recorded(self):
        (self.folder / "list.txt").write_text(
            f"# two\n{DATA}/empty-32x32.scen --map {DATA}/empty-32x32.map --agents 5\n"
            f"{DATA}/first.cts.json\n")
        self.run_well("bench", "list.txt", "--run", "two: --threads 2 --seed 4 --memory-limit 0.5",
                      "--output-dir", "out")
        rows = self.rows()
        self.assertEqual({row["problem"] for row in rows.values()}, {"mapf", "cts"})
        for row in rows.values():
            self.assertEqual((row["threads"], row["seed"], row["memory_limit_gb"]), (2, 4, 0.5))
            self.assertEqual(row["options"], "--threads 2 --seed 4 --memory-limit 0.5")
            self.assertIs(row["solved"], True)

    def test_progress_ends_with_the_number_of_solved_runs(self):
        self.easy(1)
        running = self.start(*self.bench())
        _, err = running.communicate(timeout=HANG_S)
        self.assertRegex(err, r"2/2 done; \d:\d\d elapsed; solved: exact 1/1, paper 1/1\n\Z")
        running = self.start(*self.bench("--quiet"))
        self.assertEqual(running.communicate(timeout=HANG_S)[1], "")


class Refusals(Program):
    def test_wrong_run_options_are_refused(self):
        self.easy(1)
        for run, text in (("x: --polcy fixed", "--polcy"), ("x: --omega -1", "--omega: found '-1'"),
                          ("x: --omega 0 first.cts.json", "first.cts.json"), ("nonsense", "--method"),
                          ("x: --output plan", "--output is not allowed here"),
                          ("x: --log l", "--log is not allowed here"),
                          ("x: --checkpoint c", "--checkpoint is not allowed here"),
                          ("x: --policy fixed --without bypass", "--without"),
                          ("x: --with sequence-splits", "was removed"),
                          ("x: --help", "--help"), ("a b: --omega 0", "NAME"), ("", "NAME")):
            self.refuses(self.bench(runs=["good: --omega 0", run]), "--run", text)
        self.refuses(self.bench(runs=["x: --omega 0", "x: --omega 1"]), "second run of that name")
        self.refuses(self.bench("--jobs", 0), "--jobs")
        self.refuses(["bench", "instances", "--output-dir", "out"], "--run or --solver is required")
        self.assertFalse((self.folder / "out").exists())

    def test_wrong_instance_lists_are_refused(self):
        self.refuses(self.bench(), "instances")
        path = self.easy(1)[0]
        for text, message in (("", "has no instance"), ("missing.cts.json\n", "missing.cts.json"),
                                (f"{path}\n{path}\n", "line 2"),
                                (f"{DATA}/rooms-32x32.map\n", "is a map")):
            (self.folder / "list.txt").write_text(text)
            self.refuses(["bench", "list.txt", "--run", "x:", "--output-dir", "out"], "list.txt",
                         message)
        self.assertFalse((self.folder / "out").exists())

    def test_unreadable_instance_has_an_error_row(self):
        self.easy(1)
        (self.folder / "instances/broken.cts.json").write_text("{")
        running = self.start(*self.bench(runs=["x: --omega 0"]))
        _, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 0, err)
        self.assertRegex(err, r"(?m)^grove: warning: instances/broken\.cts\.json: .*; its rows have an error$")
        row = self.rows()["broken", "x"]
        self.assertEqual(row["status"], "error")
        self.assertIn("broken.cts.json", row["error"])
        self.assertTrue(self.rows()["easy_s1_n3_m4", "x"]["solved"])

    def test_unsupported_instances_are_not_errors(self):
        """Mixes instances with and without turning agents; the method does not support turning."""
        for name, motion in (("a_turns", '"motion": "turning", "heading": "N", "turn_steps": 1, '), ("b_plain", ""),
                             ("c_turns", '"motion": "turning", "heading": "N", "turn_steps": 1, ')):
            path = self.folder / f"instances/{name}.cts.json"
            path.parent.mkdir(exist_ok=True)
            path.write_text(f'{{"map": "{DATA}/rooms-32x32.map", "agents": [{{"id": "a", {motion}"start": [1, 1], '
                            '"goal": [3, 1]}], "tasks": []}')
        output = self.run_well(*self.bench(runs=["x: --method hcbs"]))
        self.assertRegex(output, r"(?m)^method .* errors +unsupported$")
        self.assertRegex(output, r"(?m)^x +1/1 .* 0 +2$")
        self.assertEqual([self.rows()[name, "x"]["status"] for name in ("a_turns", "c_turns")], ["unsupported"] * 2)

    def test_second_bench_in_the_same_folder_is_refused(self):
        self.hard(2)
        first = self.start(*self.bench(limit=300))
        wait_until("a run", lambda: self.runs(first.pid), first)
        self.refuses(self.bench(limit=300), "in use")
        first.send_signal(signal.SIGTERM)
        first.communicate(timeout=HANG_S)

    def test_changed_runs_under_the_same_names_are_refused(self):
        path = self.easy(1)[0]
        self.run_well(*self.bench())
        before = self.lines()
        self.refuses(self.bench(runs=["exact: --omega 0.1"]), "results.jsonl", "--omega 0.1")
        self.refuses(self.bench(limit=11), "time limit '10' there, '11' here")
        self.refuses(self.bench("--memory-limit", 1), "memory limit")
        text = path.read_text()
        path.write_text(text + "\n")  # the same instance with a changed file
        self.run_well(*self.bench())
        path.write_text(text.replace('"a0"', '"robot"'))
        self.refuses(self.bench(), "the instance or its map has changed")
        self.assertEqual(self.lines(), before)


class Resuming(Program):
    def test_same_command_resumes(self):
        self.easy(2)
        self.run_well(*self.bench(runs=["exact: --omega 0"]))
        before = self.lines()
        self.easy(3)
        output = self.run_well(*self.bench())
        self.assertRegex(output, r"exact +3/3 ")
        self.assertEqual(self.lines()[:2], before)
        self.assertEqual(len(self.rows()), 6)
        after = self.lines()
        self.run_well(*self.bench())
        self.assertEqual(self.lines(), after)

    def test_rows_of_another_version_are_kept_with_a_warning(self):
        self.easy(1)
        self.run_well(*self.bench())
        file = self.folder / "out/results.jsonl"
        text = file.read_text().replace('"version":"grove 0', '"version":"grove -1', 1)
        file.write_text(text)
        running = self.start(*self.bench("--quiet"))
        self.assertRegex(running.communicate(timeout=HANG_S)[1],
                         r"\Agrove: warning: out has rows of grove -1[^\n]*; they are kept\n\Z")
        self.assertEqual(file.read_text(), text)

    def test_bench_killed_repeatedly_resumes(self):
        self.hard(3)
        command = self.bench(runs=["a: --omega 0", "b: --omega 0 --seed 1"], limit=0.3)
        kept = []
        for rows in (1, 0, 2):
            count = len(kept)
            running = self.start(*command)
            wait_until("rows", lambda: len(self.lines()) >= count + rows, running)
            children = wait_until("runs", lambda: self.runs(running.pid), running)
            running.kill()
            running.communicate()
            wait_until("no run", lambda: not any(self.lives(child) for child in children))
            whole = [line for line in self.lines() if line.endswith("\n")]
            self.assertEqual(whole[:count], kept)
            kept = whole
        self.run_well(*command)
        self.assertEqual(self.lines()[:len(kept)], kept)
        self.assertEqual(len(self.rows()), 6)
        self.assertEqual(len(self.table()), 6)
        self.assertFalse((self.folder / "out/.running").exists())

    def test_ctrl_c_keeps_complete_rows(self):
        self.hard(2)
        command = self.bench(runs=["a: --omega 0 --time-limit 0.2", "b: --omega 0"], limit=300)
        running = self.start(*command)
        wait_until("a row", lambda: len(self.lines()) >= 1, running)
        children = wait_until("a run", lambda: self.runs(running.pid), running)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 130, err)
        self.assertIn("stopped with", err)
        self.assertRegex(out, r"a +0/[12] ")
        self.assertFalse(any(self.lives(child) for child in children))
        before = self.rows()
        self.assertFalse([row for row in before.values() if row["method"] == "b"])
        self.assertEqual(len(self.table()), len(before))
        self.run_well(*self.bench(runs=["a: --omega 0 --time-limit 0.2", "b: --omega 0.5"]))
        self.assertEqual(len(self.rows()), 4)
        self.assertEqual({run: self.rows()[run] for run in before}, before)


class Crashes(Program):
    def test_killed_run_is_an_error_row_and_is_run_again(self):
        self.hard(1)
        self.easy(1)
        command = self.bench(runs=["x: --omega 0.001"], limit=3, jobs=1)
        running = self.start(*command)
        wait_until("the row of the easy instance", lambda: len(self.lines()) == 1, running)
        victim = wait_until("the run of the hard instance", lambda: self.runs(running.pid), running).pop()
        os.kill(victim, signal.SIGKILL)
        out, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 0, err)
        self.assertRegex(out, r"x +1/2 +\S+ +1\n")
        row = self.rows()["hard_s1_n18_m30", "x"]
        self.assertEqual((row["status"], row["solved"]), ("error", False))
        self.assertEqual(row["error"], "ended by signal 9 (Killed)")
        self.assertEqual(row["runtime_s"], 3)
        self.assertGreater(row["wall_s"], 0)
        self.assertIsNone(row["cost"])
        self.assertTrue(row["version"].startswith("grove"))
        easy = self.rows()["easy_s1_n3_m4", "x"]
        self.run_well(*command)
        self.assertNotEqual(self.rows()["hard_s1_n18_m30", "x"]["status"], "error")
        self.assertEqual(self.rows()["easy_s1_n3_m4", "x"], easy)

    def test_instance_deleted_during_the_bench_is_an_error_row(self):
        path = self.hard(2)[1]
        running = self.start(*self.bench(runs=["x: --omega 0"], limit=0.5, jobs=1))
        wait_until("a run", lambda: self.runs(running.pid), running)
        path.unlink()
        _, err = running.communicate(timeout=HANG_S)
        self.assertEqual(running.returncode, 0, err)
        row = self.rows()["hard_s2_n18_m30", "x"]
        self.assertEqual(row["status"], "error")
        self.assertIn("hard_s2_n18_m30.cts.json", row["error"])


if __name__ == "__main__":
    unittest.main()
