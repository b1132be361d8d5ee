#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `grove bench --solver` with correct, wrong and failing solvers (fake_solver.py), and sweeps over scenarios."""
import json
import os
import re
import shlex
import signal
import unittest
from pathlib import Path

from grove_bench_test import GROVE, HANG_S, Program
from waiting import text_of, wait_until

FAKE = Path(__file__).resolve().parent / "fake_solver.py"
ADAPTER = {"name": "fake",
           "command": "{program} {map} {scenario} {agents} {output}",
           "claims": {"solved": "a plan, I have", "cost": r"^cost (-?\d+)", "lower_bound": r"bound (\d+)"}}
ANYTIME = {"name": "fake-anytime", "anytime": True,
           "command": ADAPTER["command"],
           "trace": [{"regex": r"^at ([0-9.]+) cost (\d+)", "groups": ["seconds", "cost"]}]}
WIDTH = 8
# Reads and prints what Lazy CBS does. Its rows and columns are those of the map with the border.
LAZY_CBS = """#!/usr/bin/env python3
import sys
from pathlib import Path
from fake_solver import rows_of, straight
options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
assert list(options) == ["--map", "--agents", "--upto", "--makespan"], options
lines = Path(options["--map"]).read_text().splitlines()
assert lines == ["10,10", ",".join("1" * 10), *[",".join("1" + "0" * 8 + "1")] * 8, ",".join("1" * 10)], lines
paths = [straight(*row) for row in rows_of(options["--agents"], int(options["--upto"]))]
for agent, path in enumerate(paths):
    print(f"Agent {agent}:" + "".join(f" ({y},{x})" for x, y in path))
cost = sum(len(path) - 1 for path in paths)
print(f"lazy-cbs ; m.map ; a.scen ; {len(paths)} ; done ; 12.50 ; {cost} ; 3 ; 4 ; 5 ; 6 ; 7", file=sys.stderr)
"""


class ExternalSolverTests(Program):
    def setUp(self):
        super().setUp()
        os.environ["PYTHONPATH"] = str(FAKE.parent)
        for adapter in (ADAPTER, ANYTIME):
            (self.folder / f"{adapter['name']}.json").write_text(json.dumps(adapter))
        self.add_map("maps/open.map")
        os.environ["FAKE_PIDS"] = str(self.folder / "pids")

    def add_map(self, name, letter="."):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"type octile\nheight {WIDTH}\nwidth {WIDTH}\nmap\n" + f"{letter * WIDTH}\n" * WIDTH)

    def add_scenario(self, name, agents, map_name="open.map"):
        """Writes a scenario with one agent in each of the first `agents` rows, which moves from left to right."""
        path = self.folder / "maps" / f"{name}.scen"
        path.write_text("version 1\n" + "".join(
            f"0\t{map_name}\t{WIDTH}\t{WIDTH}\t0\t{y}\t{WIDTH - 1}\t{y}\t7\n" for y in range(agents)))

    @staticmethod
    def solver(kind, adapter="fake.json", name=None):
        return f"{name or kind}={adapter}:{FAKE} {kind}"

    def sweep(self, *more, solvers=(), runs=("grove: --omega 0",), agents=2, limit=5):
        words = [word for run in runs for word in ("--run", run)]
        words += [word for solver in solvers for word in ("--solver", solver)]
        return ["bench", "maps", *words, "--agents", agents, "--output-dir", "out", "--time-limit", limit,
                "--quiet", *more]

    def row_of(self, kind, *more, limit=5, adapter="fake.json"):
        """Runs Grove and the solver with two agents, checks Grove's row and returns the solver's. Keeps the output
        in self.output."""
        self.add_scenario("open-random-1", 3)
        self.output = self.run_well(*self.sweep(*more, solvers=[self.solver(kind, adapter)], limit=limit))
        rows = self.rows()
        self.assertEqual(len(rows), 2)
        grove = rows["open-random-1-2", "grove"]
        self.assertEqual((grove["status"], grove["cost"], grove["solver"]), ("optimal", 14, None))
        return rows["open-random-1-2", kind]

    def summary(self):
        """Returns the summary table in the output as {method: {column: cell}}."""
        lines = self.output.splitlines()
        header = ["method", *lines[0].replace("median s", "median").split()[1:]]
        cells = [line.split() for line in lines[1:] if len(line.split()) == len(header) and ":" not in line]
        return {row[0]: dict(zip(header, row)) for row in cells}


class Solvers(ExternalSolverTests):
    def test_correct_solver_is_feasible_with_checked_cost(self):
        row = self.row_of("honest", "--keep-plans")
        self.assertEqual((row["status"], row["solved"], row["cost"], row["error"]), ("feasible", True, 14, None))
        self.assertIsNone(row["lower_bound"])  # claimed bounds are not checked
        self.assertEqual((row["claimed_cost"], row["claimed_lower_bound"], row["solver"]), (14, 14, "fake"))
        self.assertEqual(row["options"], "fake honest")
        seconds, *found = row["trace"].split(":")
        self.assertEqual((float(seconds), found), (row["wall_s"], ["14", "-"]))
        self.assertEqual((row["runtime_s"], row["first_plan_s"]), (row["wall_s"], row["wall_s"]))
        self.assertGreater(row["peak_memory_mb"], 1)
        self.assertEqual(row["plan_file"], "plans/honest/open-random-1-2.plan.json")
        self.run_well("check", self.folder / "maps/open-random-1.scen", "--map", self.folder / "maps/open.map",
                      "--agents", 2, self.folder / "out" / row["plan_file"])
        self.assertEqual(self.summary()["honest"]["solved/run"], "1/1")
        self.assertNotIn("refuted", self.output)
        self.assertNotIn("wrong", self.output)
        self.assertFalse((self.folder / "out/.running").exists())

    def test_colliding_paths_are_invalid(self):
        row = self.row_of("collides", "--keep-plans")
        self.assertEqual((row["status"], row["solved"], row["cost"], row["trace"]), ("invalid", False, None, None))
        self.assertRegex(row["error"], r"\Athe plan is wrong: output: .*both on")
        self.assertEqual(row["claimed_cost"], 14)
        self.assertEqual(self.summary()["collides"]["invalid"], "1")
        self.assertEqual(self.summary()["grove"]["invalid"], "0")
        self.assertIn("invalid: invalid plans", self.output)
        self.assertIn("Agent 0:", (self.folder / "out" / row["plan_file"]).read_text())

    def test_claimed_cost_without_a_plan_is_claimed(self):
        row = self.row_of("claims")
        self.assertEqual((row["status"], row["solved"], row["cost"], row["claimed_cost"]),
                         ("claimed", False, None, 13))
        self.assertEqual(row["runtime_s"], 5)
        counts = self.summary()["claims"]
        self.assertEqual((counts["solved/run"], counts["claimed"], counts["refuted"]), ("0/1", "1", "1"))
        self.assertIn("refuted: claims on open-random-1-2 claims a cost of 13, but grove has proven that no plan "
                      "costs less than 14\n", self.output)

    def test_solved_claim_without_a_cost_is_claimed(self):
        row = self.row_of("asserts")
        self.assertEqual((row["status"], row["claimed_cost"]), ("claimed", None))
        self.assertEqual(self.summary()["asserts"]["claimed"], "1")

    def test_claim_below_the_cost_of_the_paths_is_refuted(self):
        row = self.row_of("understates")
        self.assertEqual((row["status"], row["solved"], row["cost"], row["claimed_cost"]),
                         ("feasible", True, 18, 14))
        self.assertEqual(self.summary()["understates"]["refuted"], "1")
        self.assertIn("claims a cost of 14, but its own paths cost 18\n", self.output)

    def test_claimed_bound_above_a_plan_is_refuted(self):
        row = self.row_of("overbounds")
        self.assertEqual((row["cost"], row["claimed_lower_bound"], row["lower_bound"]), (14, 19, None))
        self.assertRegex(self.output, r"overbounds on \S+ claims a lower bound of 19, but \w+ has a plan that costs 14")

    def test_unreadable_output_is_invalid(self):
        row = self.row_of("garbage")
        self.assertEqual(row["status"], "invalid")
        self.assertIn("expected a plan file", row["error"])

    def test_partial_output_at_the_time_limit_is_unknown(self):
        row = self.row_of("partial", limit=0.5)
        self.assertEqual((row["status"], row["error"]), ("unknown", "time limit"))

    def test_solver_without_a_plan_is_unknown(self):
        row = self.row_of("planless")
        self.assertEqual((row["status"], row["solved"], row["error"]),
                         ("unknown", False, "ended without a plan: nothing found"))
        self.assertEqual(self.summary()["planless"]["errors"], "0")

    def test_hanging_solver_is_killed_at_the_time_limit(self):
        """Checks that a solver without a time limit option is killed at the limit, including its child processes."""
        row = self.row_of("hangs", limit=4)  # enough time for the solver to start a child process
        self.assertEqual((row["status"], row["solved"], row["error"], row["runtime_s"]),
                         ("unknown", False, "time limit", 4))
        child = (self.folder / "pids").read_text()
        wait_until("the child process has ended", lambda: not self.lives(child))

    def test_ctrl_c_ends_a_solver_without_a_row(self):
        self.add_scenario("open-random-1", 2)
        running = self.start(*self.sweep(solvers=[self.solver("hangs")], runs=(), limit=60))
        pids = self.folder / "pids"
        child = wait_until("a process", lambda: text_of(pids), running)
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=HANG_S)
        self.assertEqual((running.returncode, err),
                         (130, "grove: stopped with 1 run left; repeat the command to resume\n"))
        self.assertEqual(self.lines(), [])
        wait_until("the child process has ended", lambda: not self.lives(child))

    def test_crashing_solver_is_an_error(self):
        row = self.row_of("crashes")
        self.assertEqual((row["status"], row["error"]), ("error", "ended by signal 6 (Aborted)"))
        self.assertEqual(self.summary()["crashes"]["errors"], "1")
        self.output = self.run_well(*self.sweep(solvers=[self.solver("fails")]))
        row = self.rows()["open-random-1-2", "fails"]
        self.assertEqual((row["status"], row["error"]), ("error", "ended with exit code 255: out of luck"))

    def test_memory_limit_ends_a_solver(self):
        row = self.row_of("allocates", "--memory-limit", 1)
        self.assertEqual((row["status"], row["memory_limit_gb"]), ("error", 1))
        self.assertIn("MemoryError", row["error"])
        self.assertLess(row["peak_memory_mb"], 1000)

    def test_anytime_solver_has_a_trace(self):
        row = self.row_of("anytime", limit=4, adapter="fake-anytime.json")
        self.assertEqual((row["status"], row["solved"], row["cost"], row["error"], row["anytime"]),
                         ("feasible", True, 14, None, True))
        points = [point.split(":") for point in row["trace"].split()]
        self.assertEqual([(cost, bound) for _, cost, bound in points], [("19", "-"), ("16", "-"), ("14", "-")])
        self.assertAlmostEqual(row["first_plan_s"], float(points[0][0]), 5)
        self.assertEqual(row["runtime_s"], row["first_plan_s"])
        self.assertGreater(row["wall_s"], 4)

    def test_anytime_plan_after_the_time_limit_is_not_solved(self):
        adapter = {**ANYTIME, "name": "fake-late", "command": ADAPTER["command"] + " {time_limit}"}
        (self.folder / "fake-late.json").write_text(json.dumps(adapter))
        row = self.row_of("late", limit=1, adapter="fake-late.json")
        self.assertEqual((row["solved"], row["cost"]), (False, 14), row)
        self.assertRegex(row["error"], r"after the time limit; only its own claim says when it had a plan")

    def test_trace_of_grove_ends_with_its_plan(self):
        self.row_of("honest")
        row = self.rows()["open-random-1-2", "grove"]
        self.assertTrue(row["trace"].split()[-1].split(":")[1] == "14", row["trace"])
        self.assertGreaterEqual(row["first_plan_s"], 0)


class Commands(ExternalSolverTests):
    def test_command_with_placeholders(self):
        """Runs Grove itself as an external solver: it receives instances, and its bounds count as claims."""
        self.add_scenario("open-random-1", 3)
        command = f"self={GROVE} solve {{instance}} --output {{output}} --time-limit {{time_limit}} --quiet"
        self.run_well(*self.sweep(solvers=[command], agents="1:3:2"))
        for agents in (1, 3):
            row = self.rows()[f"open-random-1-{agents}", "self"]
            self.assertEqual((row["cost"], row["claimed_cost"], row["claimed_lower_bound"], row["lower_bound"]),
                             (7 * agents, 7 * agents, 7 * agents, None))
        self.easy(1)
        self.run_well("bench", "instances", "--solver", command, "--output-dir", "more", "--quiet")
        row = json.loads((self.folder / "more/results.jsonl").read_text())
        self.assertEqual((row["problem"], row["solved"], row["status"]), ("cts", True, "feasible"))

    def test_instances_are_converted_to_other_formats(self):
        """Runs a solver that reads other instance formats: `grove convert` followed by `grove solve`."""
        (self.folder / "reader.sh").write_text(
            f'#!/bin/sh\n"{GROVE}" convert "$1" "$3/i.cts.json" --from "$4" &&\n'
            f'"{GROVE}" solve "$3/i.cts.json" --output "$2" --omega 0 --quiet --threads 1\n')
        (self.folder / "reader.sh").chmod(0o755)
        solvers = []
        for form, reads in (("libmrp", "libmrp"), ("potential-goals", "libmrp"), ("mgcbs", "mgcbs")):
            (self.folder / f"{form}.json").write_text(json.dumps(
                {"name": form, "instance": form, "command": "{program} {instance} {output} {folder} " + reads}))
            solvers += ["--solver", f"{form}={form}.json:./reader.sh"]
        self.generate("a_s1_n3_m5_mg", 3, 5, 4, "--mg")
        self.generate("a_s1_n3_m0", 3, 0, 4)
        self.run_well("bench", "instances", "--run", "grove: --omega 0", *solvers, "--output-dir", "out", "--quiet",
                      "--keep-plans")
        for (instance, method), row in self.rows().items():
            fits = method == "grove" or (method == "mgcbs") == instance.endswith("mg")
            self.assertEqual(row["status"] == "unsupported", not fits, row)
            if fits:
                self.assertEqual(row["cost"], self.rows()[instance, "grove"]["cost"], row["error"])
                self.run_well("check", self.folder / f"instances/{instance}.cts.json",
                              self.folder / "out" / row["plan_file"])

    def test_lazy_cbs_gets_a_bordered_map_and_prints_its_paths(self):
        (self.folder / "lazy.py").write_text(LAZY_CBS)
        (self.folder / "lazy.py").chmod(0o755)
        self.add_scenario("open-random-1", 3)
        self.run_well(*self.sweep(solvers=["lazy-cbs=./lazy.py --makespan 0"]))
        row = self.rows()["open-random-1-2", "lazy-cbs"]
        self.assertEqual((row["status"], row["solved"], row["cost"], row["claimed_cost"], row["claimed_lower_bound"]),
                         ("feasible", True, 14, 14, 14), row["error"])
        self.assertEqual(row["claimed_s"], 0.0125)

    def test_claimed_cost_is_read_from_the_output(self):
        self.add_scenario("open-random-1", 2)
        command = f"claimer={FAKE} {{map}} {{scenario}} {{agents}} {{folder}}/nothing claims"
        self.run_well(*self.sweep("--claimed-cost", r"claimer=cost (\d+)", solvers=[command]))
        self.assertEqual(self.rows()["open-random-1-2", "claimer"]["claimed_cost"], 13)

    def test_solver_is_found_in_path(self):
        self.add_scenario("open-random-1", 2)
        os.environ["PATH"] = f"{FAKE.parent}:{os.environ['PATH']}"
        self.run_well(*self.sweep(solvers=[f"honest=fake.json:{FAKE.name} honest"]))
        self.assertTrue(self.rows()["open-random-1-2", "honest"]["solved"])

    def test_all_solvers_receive_the_same_map(self):
        """Checks that maps with ambiguous terrain letters are rewritten, so that all solvers read them as Grove
        does."""
        self.add_map("maps/swamp.map", "S")
        self.add_scenario("swamp-random-1", 2, "swamp.map")
        self.run_well(*self.sweep(solvers=[self.solver("honest")]))
        self.assertTrue(self.rows()["swamp-random-1-2", "honest"]["solved"])

    def test_given_option_replaces_that_of_the_adapter(self):
        adapter = dict(ADAPTER, name="more", command="{program} -x 1 {map} {scenario} {agents} {output}")
        (self.folder / "more.json").write_text(json.dumps(adapter))
        (self.folder / "echo.sh").write_text('#!/bin/sh\necho "$*"\nexit 3\n')
        (self.folder / "echo.sh").chmod(0o755)
        self.add_scenario("open-random-1", 2)
        self.run_well(*self.sweep(solvers=["echo=more.json:./echo.sh -x 2 'a b'"]))
        error = self.rows()["open-random-1-2", "echo"]["error"]
        self.assertRegex(error, r"exit code 3: \S+map \S+scen 2 \S+ -x 2 a b$")

    def test_instance_that_the_format_cannot_hold_is_unsupported(self):
        self.easy(1)
        self.output = self.run_well("bench", "instances", "--run", "grove:", "--solver", self.solver("honest"),
                                  "--output-dir", "out", "--quiet")
        row = self.rows()["easy_s1_n3_m4", "honest"]
        self.assertEqual(row["status"], "unsupported")
        self.assertIn("task 't0' cannot be represented in a .scen file", row["error"])
        self.assertEqual(self.summary()["honest"]["unsupported"], "1")
        self.assertEqual(self.summary()["honest"]["solved/run"], "0/0")

    def test_wrong_solver_options_are_refused(self):
        self.add_scenario("open-random-1", 2)
        (self.folder / "broken.json").write_text('{"name": "broken"}')
        (self.folder / "text").write_text("no program")
        fake = shlex.quote(str(FAKE))
        for solver, *texts in (("nonsense", "expected NAME=..."), ("x y=/bin/true", "expected NAME=..."),
                               ("x=", "expected a command"), (f"x={fake} 'a", "a quote is not closed"),
                               ("x=/bin/true", "no adapter is called 'x'", "eecbs, ita-cbs2, lacam3"),
                               ("eecbs=/nowhere/eecbs", "there is no program /nowhere/eecbs"),
                               ("eecbs=nowhere", "there is no program nowhere in the folders of PATH"),
                               ("eecbs=./text", "is not executable"),
                               (f"x={fake} {{maps}}", "found {maps}; expected one of {program}"),
                               (f"x={fake} {{map}} {{output}}", "expected {map} and {scenario}"),
                               (f"x={fake} {{map}} {{scenario}}", "has no {output} for a plan"),
                               (f"x={fake} {{instance}} {{map}} {{output}}", "and not both"),
                               (f"x=broken.json:{fake}", "broken.json: /", "command"),
                               (f"x=missing.json:{fake}", "missing.json")):
            self.refuses(self.sweep(solvers=[solver]), *texts)
        good = f"x={fake} {{map}} {{scenario}}"
        for claim, text in (("y=(1)", "the name of a --solver"), ("x=(1", "which is not a regular expression"),
                            ("x=1", "found 0 groups")):
            self.refuses(self.sweep("--claimed-cost", claim, solvers=[good]), "--claimed-cost", text)
        self.refuses(self.sweep(solvers=[self.solver("honest", name="grove")]), "a second 'grove'")
        self.refuses(self.sweep(runs=()), "--run or --solver")
        self.assertFalse((self.folder / "out").exists())


class Sweeps(ExternalSolverTests):
    def test_sweep_covers_scenarios_agents_and_seeds(self):
        for name in ("open-random-1", "open-random-2", "open-even-1"):
            self.add_scenario(name, 4)
        command = self.sweep("--scenarios", "open-random-*", "--seeds", "1-2,5", "--keep-plans", agents="1,2:4:2",
                             solvers=[self.solver("honest")])
        output = self.run_well(*command)
        self.assertRegex(output, r"grove +18/18 ")
        self.assertRegex(output, r"honest +18/18 ")
        rows = [json.loads(line) for line in self.lines()]
        self.assertEqual({(row["instance"], row["method"], row["seed"]) for row in rows},
                         {(f"open-random-{k}-{agents}", method, seed) for k in (1, 2) for agents in (1, 2, 4)
                          for method in ("grove", "honest") for seed in (1, 2, 5)})
        self.assertEqual(len({row["plan_file"] for row in rows}), len(rows))
        for row in rows:
            self.assertTrue((self.folder / "out" / row["plan_file"]).exists())
            self.assertEqual(row["scenario"], int(row["instance"].split("-")[2]))
            self.assertEqual(row["agents"], int(row["instance"].split("-")[3]))
        self.assertEqual(len(self.table()), 36)
        # Resuming keeps the rows and adds rows for the new seed.
        self.run_well(*command)
        self.assertEqual([json.loads(line) for line in self.lines()], rows)
        command[command.index("1-2,5")] = "1-3"
        self.run_well(*command)
        again = [json.loads(line) for line in self.lines()]
        self.assertEqual(again[:36], rows)
        self.assertEqual({row["seed"] for row in again[36:]}, {3})
        self.assertEqual(len(again), 48)

    def test_rows_with_errors_are_run_again(self):
        self.add_scenario("open-random-1", 2)
        command = self.sweep("--seeds", "1-2", solvers=[self.solver("fails")])
        self.run_well(*command)
        table = self.folder / "out/results.jsonl"
        table.write_text(re.sub(r'"ended_at":"\d{4}', '"ended_at":"2001', table.read_text()))  # makes the rows old
        before = [row for row in map(json.loads, self.lines()) if row["method"] == "grove"]
        self.assertTrue(before[0]["ended_at"].startswith("2001"))
        self.run_well(*command)
        after = [json.loads(line) for line in self.lines()]
        self.assertEqual([row for row in after if row["method"] == "grove"], before)
        self.assertEqual(len(after), 4)
        self.assertGreater(min(row["ended_at"] for row in after if row["method"] == "fails"),
                           max(row["ended_at"] for row in before))

    def test_short_scenarios_are_warned_of(self):
        self.add_scenario("open-random-1", 3)
        self.add_scenario("open-random-2", 2)
        running = self.start(*self.sweep(agents="2,3"))
        _, err = running.communicate(timeout=HANG_S)
        self.assertEqual(err, "grove: warning: 1 scenario has fewer rows than the maximum of --agents; "
                              "instances with more agents than rows are left out\n")
        self.assertEqual(len(self.rows()), 3)

    def test_wrong_sweep_options_are_refused(self):
        self.add_scenario("open-random-1", 3)
        for agents, text in (("3:1", "the smaller number first"), ("0:3", "from 1 to"), ("2,2", "increasing"),
                             ("1:2:3:4", "FIRST:LAST:STEP"), ("1:9:0", "from 1 to"), ("x", "'x'"), ("9", "9 rows")):
            self.refuses(self.sweep(agents=agents), text)
        self.refuses(self.sweep("--scenarios", "closed*"), "has no scenario 'closed*.scen'")
        self.refuses(["bench", "maps", "--run", "grove:", "--output-dir", "out"], "--agents", "10:100:10")
        self.easy(1)
        self.refuses(["bench", "instances", "--run", "grove:", "--output-dir", "out", "--scenarios", "x*"],
                     "--scenarios", "--agents")
        self.refuses(["bench", "instances", "--run", "grove:", "--output-dir", "out", "--agents", 3], "no scenario")
        self.refuses(self.sweep("--seeds", "1", runs=["x: --seed 3"]), "--seeds", "found --seed in a run")
        self.refuses(self.sweep("--seeds", "3-1"), "--seeds")
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
