#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""grove-mpi as its users run it, by mpirun."""
import contextlib
import csv
import json
import os
import shlex
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import kill_and_resume
from mpi_program import (DATA, ENVIRONMENT, GROVE, GROVE_MPI, held_by, mpirun, plan_of, processes_of,
                         run, searches, start)
from mpi_test import MpiTest
from waiting import progress_of, state_of, text_of, wait_until

EASY = DATA / "rooms-32x32_n10_m30.cts.json"
ONE_WAY = DATA / "yard.cts.json"
ENDLESS = 60, 100, 3  # agents, tasks, seed: a gap of 9 % stays for long


def end_process(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGKILL)


class Program(MpiTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def generate(self, agents, tasks, seed):
        """An instance of the map with rooms."""
        path = self.folder / "generated.cts.json"
        self.run_well([GROVE, "generate", "instance", "--map", DATA / "rooms-32x32.map", "--agents",
                       agents, "--tasks", tasks, "--seed", seed, "-o", path])
        return path

    def run_well(self, command):
        code, said = run(command, self.folder)
        self.assertEqual(code, 0, said)
        return said

    def refuses(self, command, *texts):
        """Exit code 2, and one complaint that holds the texts."""
        code, said = run(command, self.folder)
        self.assertEqual(code, 2, said)
        complaints = [line for line in said.splitlines() if line.startswith("grove-mpi: error:")]
        self.assertEqual(len(complaints), 1, said)
        for text in texts:
            self.assertIn(text, complaints[0])

    def plan(self):
        return plan_of(self.folder / "plan.json")

    def searching_ranks(self, running, count=3):
        """The processes of so many ranks, once all search; they do not outlive the test."""
        self.addCleanup(running.kill)

        def all_search():
            ranks = processes_of(running)
            return ranks if len(ranks) == count and all(map(searches, ranks.values())) else None

        ranks = wait_until("all ranks search", all_search, running)
        for process in ranks.values():
            self.addCleanup(end_process, process)
        return ranks

    def stop(self, process):
        """Makes a process stand still."""
        os.kill(process, signal.SIGSTOP)
        wait_until("it stands still", lambda: state_of(process) == "T")

    def end_well(self, running, ranks):
        """Interrupts all ranks; what was said. (Not mpirun, which would call it a failure.)"""
        for process in ranks.values():
            os.kill(process, signal.SIGTERM)
        said, _ = running.communicate()
        self.assertEqual(running.returncode, 0, said)
        return said


class Help(Program):
    def test_help_needs_no_mpi(self):
        """Neither mpirun, nor what MPI_Init takes: with a transport that is not there it fails."""
        variables = {"PATH": "/nonexistent", "OMPI_MCA_btl": "nonexistent", "OMPI_MCA_pml": "nonexistent"}
        for words in (["--help"], ["--version"], ["help", "solve"], ["solve", "-h"], ["help", "--completion", "bash"]):
            asked = start([GROVE_MPI, *words], self.folder, **variables)
            said, _ = asked.communicate(timeout=60)
            self.assertEqual(asked.returncode, 0, said)
            self.assertIn("grove", said)
        solve = start([GROVE_MPI, "solve", EASY], self.folder, **variables)
        solve.communicate(timeout=60)
        self.assertNotEqual(solve.returncode, 0)

    def test_one_rank_prints_the_help(self):
        said = self.run_well(mpirun(3, "--version"))
        self.assertEqual(said.count("grove"), 1, said)


class Answers(Program):
    def test_any_number_of_ranks_and_threads_finds_the_optimum(self):
        instance = self.generate(16, 20, 5)  # some thousand nodes
        self.run_well([GROVE, "solve", instance, "--omega", 0, "--output", "plan.json"])
        cost = self.plan()["cost"]
        for ranks, threads in [(1, 1), (2, 1), (3, 1), (4, 1), (2, 2)]:
            self.run_well(mpirun(ranks, "solve", instance, "--omega", 0, "--threads", threads,
                                 "--output", "plan.json"))
            plan = self.plan()
            self.assertEqual((plan["status"], plan["cost"]), ("optimal", cost), ranks)
            self.assertEqual(plan["stats"]["ranks"], ranks)
            self.assertEqual(plan["stats"]["node_batches"] > 0, ranks > 1)
            self.run_well([GROVE, "check", instance, "plan.json"])

    def test_the_paper_s_policy(self):
        self.run_well(mpirun(2, "solve", DATA / "rooms-32x32_n5_m10.cts.json", "--policy", "fixed",
                             "--output", "plan.json"))
        self.assertIn(self.plan()["status"], ("optimal", "bounded"))

    def test_without_following(self):
        instance = DATA / "yard.cts.json"
        costs = []
        for more in ([], ["--no-following"]):
            self.run_well(mpirun(2, "solve", instance, "--threads", 1, "--omega", 0, "--output", "plan.json",
                                 *more))
            self.assertEqual(self.plan()["status"], "optimal")
            self.assertEqual(self.plan().get("following", True), not more)
            self.run_well([GROVE, "check", instance, "plan.json"])
            costs.append(self.plan()["cost"])
            (self.folder / "plan.json").unlink()
        self.assertEqual(costs, [58, 59])

    def test_what_has_no_plan_is_said_to_have_none(self):
        (self.folder / "two.map").write_text("type octile\nheight 1\nwidth 3\nmap\n.@.\n")
        (self.folder / "no.cts.json").write_text(
            '{"map": "two.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}],'
            ' "tasks": []}')
        self.run_well(mpirun(2, "solve", "no.cts.json", "--output", "plan.json"))
        self.assertEqual(self.plan()["status"], "infeasible")

    def test_the_log_tells_who_works(self):
        said = self.run_well(mpirun(3, "solve", EASY, "--threads", 2, "--output", "plan.json"))
        self.assertIn("Threads       2 each on 3 ranks, 1 host", said)
        self.assertEqual(said.count("Plan file"), 1)
        if (os.cpu_count() or 0) < 6:
            self.assertRegex(said, r"Warning: host \S+ has \d+ cores for 6 threads")

    def test_the_log_for_programs_tells_of_each_rank(self):
        said = self.run_well(mpirun(3, "solve", DATA / "rooms-32x32_n10_m30.cts.json", "--omega", 0,
                                    "--without", "primal", "--log-format", "jsonl", "--output", "plan.json"))
        log = [json.loads(line) for line in said.splitlines() if line.startswith("{")]
        last = [event for event in log if event["event"] == "counts"][-1]
        stats = log[-1]["stats"]
        for column, count in (("low_level_calls", "low_level_calls"), ("branching_cost_queries", "branching_cost_queries")):
            self.assertEqual(sum(last["ranks"][column]), stats[count])
        for column in last["ranks"].values():
            self.assertEqual(len(column), 3)
        self.assertTrue(all(memory > 0 for memory in last["ranks"]["memory_mb"]))
        self.refuses(mpirun(2, "solve", EASY, "--log-format", "jsonl", "--log-tree", 5), "--log-tree")

    def test_nothing_can_be_said(self):
        self.run_well(["sh", "-c", 'exec "$@" >/dev/full 2>/dev/full', "sh", GROVE_MPI, "solve", EASY,
                       "--omega", "0", "-o", "plan.json"])
        self.assertEqual(self.plan()["status"], "optimal")


class Refusals(Program):
    def test_input_is_complained_about_once(self):
        self.refuses(mpirun(2, "solve", "missing.cts.json"), "missing.cts.json")
        self.refuses(mpirun(2, "solve", EASY, "--omega", "-1"), "--omega")
        self.refuses(mpirun(2, "solve", EASY, "--deterministic"), "--deterministic")
        self.refuses(mpirun(2, "solve", EASY, "--output", "no/such/folder/plan.json"), "no/such")
        self.refuses(mpirun(2, "solve", EASY, "--resume", "auto"), "--resume", "--checkpoint")

    def test_a_method_that_is_not_for_the_instance(self):
        self.refuses(mpirun(2, "solve", ONE_WAY, "--method", "hcbs"), ONE_WAY.name, "method hcbs", "one way")
        self.refuses(mpirun(2, "solve", EASY, "--method", "cts-cbs-a"), "cts-cbs-a")

    def test_instances_that_name_files_elsewhere_are_refused_if_asked(self):
        elsewhere = self.folder / "theirs/i.cts.json"
        elsewhere.parent.mkdir()
        elsewhere.write_text(json.dumps(json.loads(EASY.read_text()) | {"map": str(DATA / "rooms-32x32.map")}))
        self.refuses(mpirun(2, "solve", elsewhere, "--confine"), "/map", "is an absolute path")
        self.run_well(mpirun(2, "batch", elsewhere.parent, "--confine", "--output", "results", "--threads", 1))
        with open(self.folder / "results/results.csv", encoding="utf-8", newline="") as table:
            row, = csv.DictReader(table)
        self.assertIn("is an absolute path", row["error"])

    def test_ranks_that_were_asked_for_different_things(self):
        one = ["mpirun", "--oversubscribe", "-np", 1, GROVE_MPI, "solve", EASY, "--seed", 1]
        other = [":", "-np", 1, GROVE_MPI, "solve", EASY, "--seed", 2]
        self.refuses(one + other, "rank 1", "options", "--seed 2", "--seed 1")

    def test_a_rank_that_alone_refuses_its_command_line(self):
        for first, second in (("0", "x"), ("x", "0")):
            command = mpirun(1, "solve", EASY, "--omega", first)
            self.refuses([*command, ":", "-np", "1", GROVE_MPI, "solve", EASY, "--omega", second],
                         "--omega")

    def test_ranks_with_different_instances(self):
        other = self.generate(3, 3, 1)
        self.refuses(["mpirun", "--oversubscribe", "-np", 1, GROVE_MPI, "solve", EASY,
                      ":", "-np", 1, GROVE_MPI, "solve", other], "rank 1", "instance")


class Files(Program):
    def test_a_run_without_a_plan_keeps_a_valid_one(self):
        self.run_well(mpirun(2, "solve", EASY, "--output", "plan.json", "--quiet"))
        before = self.plan()
        said = self.run_well(mpirun(2, "solve", EASY, "--output", "plan.json", "--quiet", "--time-limit",
                                    0, "--require-plan"))
        self.assertEqual(said.count("grove: no plan was found (unknown, stopped by: time limit"), 1)
        self.assertIn(f"; plan.json keeps its valid plan of cost {before['cost']}", said)
        self.assertEqual(self.plan(), before)

    def test_from_standard_input_to_standard_output(self):
        (self.folder / "rooms-32x32.map").symlink_to(DATA / "rooms-32x32.map")
        done = subprocess.run(mpirun(2, "solve", "-", "--output", "-", "--log-format", "jsonl"),
                              cwd=self.folder, env=ENVIRONMENT, input=EASY.read_text(encoding="utf-8"),
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.folder / "plan.json").write_text(done.stdout, encoding="utf-8")
        self.run_well([GROVE, "check", EASY, "plan.json"])
        events = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
        self.assertEqual([events[0]["event"], events[0]["instance"], events[-1]["event"]],
                         ["header", "standard input", "summary"])
        self.assertEqual(events[-1]["stats"]["ranks"], 2)

    def test_one_run_at_a_time_uses_a_checkpoint_folder(self):
        instance = self.generate(*ENDLESS)
        running = start(mpirun(2, "solve", instance, "--omega", 0, "--threads", 1, "--checkpoint", "kept",
                               "--quiet"), self.folder)
        ranks = self.searching_ranks(running, 2)  # by then the folder is locked
        self.refuses(mpirun(2, "solve", instance, "--checkpoint", "kept", "--resume", "never",
                            "--output", "other.json"),
                     "kept/checkpoint.lock: is locked by another run (process ", " on host ")
        self.end_well(running, ranks)


class Checkpoints(Program):
    def kept(self, *more):
        return ["solve", EASY, "--omega", 0, "--checkpoint", "kept", "--output", "plan.json", *more]

    def test_one_program_goes_on_where_the_other_stopped(self):
        instance = self.generate(18, 30, 8)  # many seconds
        arguments = ["solve", instance, "--omega", 0, "--threads", 1, "--checkpoint", "kept",
                     "--resume", "auto", "--output", "plan.json"]
        bounds = []
        for command in ([GROVE, *arguments], mpirun(2, *arguments), [GROVE, *arguments],
                        mpirun(3, *arguments)):
            said = self.run_well([*command, "--time-limit", 1])
            self.assertEqual("Resuming" in said, bool(bounds), said)
            bounds.append(self.plan()["lower_bound"])
        self.assertEqual(bounds, sorted(bounds))

    def test_a_finished_search_is_finished_at_once(self):
        self.run_well(mpirun(2, *self.kept()))
        before = self.plan()
        said = self.run_well(mpirun(3, *self.kept("--resume", "auto")))
        self.assertIn("Resuming", said)
        after = self.plan()
        self.assertEqual((after["status"], after["cost"]), ("optimal", before["cost"]))

    def test_nothing_is_thrown_away_unasked(self):
        self.run_well(mpirun(2, *self.kept()))
        self.refuses(mpirun(2, *self.kept()), "kept/checkpoint.grove", "--resume")
        self.run_well(mpirun(2, *self.kept("--resume", "never")))

    def test_damaged_and_foreign_ones_are_refused(self):
        self.run_well(mpirun(2, *self.kept()))
        (self.folder / "kept/incumbent.plan.json").unlink()
        other = self.generate(3, 3, 1)
        self.refuses(mpirun(2, "solve", other, "--checkpoint", "kept", "--resume", "auto"),
                     "checkpoint.grove", "instance")
        file = self.folder / "kept/checkpoint.grove"
        content = bytearray(file.read_bytes())
        content[len(content) // 2] ^= 8
        file.write_bytes(content)
        self.refuses(mpirun(2, *self.kept("--resume", "auto")), "checkpoint.grove")

    def test_a_folder_that_cannot_be_used(self):
        (self.folder / "kept").write_text("not a folder")
        self.refuses(mpirun(2, *self.kept()), "kept", "folder")

    def test_on_request(self):
        running = start(mpirun(2, "solve", self.generate(*ENDLESS), "--omega", 0, "--threads", 1,
                               "--checkpoint", "kept"), self.folder)
        ranks = self.searching_ranks(running, 2)  # mpirun tells nobody what comes before they are there
        self.assertFalse((self.folder / "kept/checkpoint.grove").exists())
        running.send_signal(signal.SIGUSR1)
        wait_until("a checkpoint", (self.folder / "kept/checkpoint.grove").exists, running)
        self.assertIn("stopped by: interrupt", self.end_well(running, ranks))


class Faults(Program):
    def test_killed_ranks(self):
        killed = kill_and_resume.check(self.generate(18, 30, 8), kills=2, seed=1)
        self.assertGreater(killed, 0)

    def test_a_rank_that_stands_still(self):
        instance = self.generate(16, 20, 5)
        running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--without",
                               "primal,joint-search", "--output", "plan.json"), self.folder)
        ranks = self.searching_ranks(running)
        self.stop(ranks[2])
        before = progress_of(ranks[0])
        wait_until("rank 0 goes on without it", lambda: progress_of(ranks[0]) > before + 300, running)
        os.kill(ranks[2], signal.SIGCONT)
        said, _ = running.communicate()
        self.assertEqual(running.returncode, 0, said)
        self.assertEqual(self.plan()["status"], "optimal")
        self.run_well([GROVE, "check", instance, "plan.json"])

    def ends_without(self, stopped, instance, more):
        """A search whose rank stands still for good ends when it is interrupted."""
        running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--log", "log",
                               "--output", "plan.json", *more), self.folder)
        ranks = self.searching_ranks(running)
        wait_until("a bound", lambda: "\nB " in text_of(self.folder / "log"), running)
        self.stop(ranks[stopped])
        os.kill(ranks[0], signal.SIGTERM)
        said, _ = running.communicate()
        plan = self.plan()
        self.assertIn(plan["stats"]["unresponsive_ranks"], (1, 2))  # on a busy machine its neighbour may be late
        self.assertGreater(plan["lower_bound"], 0)
        self.assertRegex(said, "[12] of 3 ranks did not respond at shutdown")
        self.assertEqual("without a certificate" in said, bool(more), said)
        self.run_well([GROVE, "check", instance, "plan.json"])
        (self.folder / "plan.json").unlink()

    def test_a_rank_that_never_goes_on(self):
        """The job ends with what is proven. (How soon: tests/mpi/protocol_test.cpp.)"""
        instance = self.generate(*ENDLESS)
        for stopped, more in ((1, []), (2, ["--checkpoint", "saved", "--resume", "never", "--proof", "proof.zst"])):
            self.ends_without(stopped, instance, more)

    def test_a_rank_0_that_never_goes_on(self):
        """The others end the job."""
        instance = self.generate(*ENDLESS)
        limit = 2
        while True:
            running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--time-limit", limit,
                                   "--tune=unresponsive-timeout=2", "--output", "plan.json"), self.folder)
            try:
                self.stop(self.searching_ranks(running)[0])
                break
            except AssertionError:  # on a busy machine the limit may strike before all search
                running.communicate()
                self.assertLess(limit, 100)
                limit *= 4
        said, _ = running.communicate()
        self.assertNotEqual(running.returncode, 0)
        self.assertIn("rank 0 has not responded for 2 s after the limit", said)


class Memory(Program):
    """What the ranks of a host hold together: distances and tables, by windows of MPI."""

    WITHOUT = ["--mca", "osc", "^sm"]  # such windows are its alone

    def large(self):
        """An instance with 118 MB of distances, and little else."""
        self.run_well([GROVE, "generate", "map", "random", "--width", 256, "--height", 256,
                       "--obstacles", "0.1", "--seed", 1, "-o", "large.map"])
        self.run_well([GROVE, "generate", "instance", "--map", "large.map", "--agents", 300,
                       "--tasks", 600, "--seed", 1, "-o", "large.cts.json"])
        return self.folder / "large.cts.json"

    def with_mca(self, options, command):
        return [command[0], *options, *command[1:]]

    def held(self, ranks, instance, options):
        """The memory of all ranks together when all search, in bytes, and what was said."""
        running = start(self.with_mca(options, mpirun(ranks, "solve", instance, "--omega", 0, "--threads", 1)),
                        self.folder)
        processes = self.searching_ranks(running, ranks)
        held = sum(held_by(pid) for pid in processes.values())
        return held, self.end_well(running, processes)

    def test_four_ranks_hold_the_distances_once(self):
        instance = self.large()
        fields = 100e6
        alone, said = self.held(1, instance, [])
        self.assertNotIn("MB shared", said)
        shared, said = self.held(4, instance, [])
        self.assertRegex(said, r"Threads .* on 4 ranks, 1 host, 1\d\d MB shared")
        self.assertNotIn("share no memory", said)
        apart, said = self.held(4, instance, self.WITHOUT)
        self.assertNotIn("MB shared", said)
        self.assertRegex(said, r"Warning: ranks on host \S+ share no memory, .*: MPI cannot allocate shared memory")
        self.assertGreater(alone, fields)
        self.assertGreater(apart, 4 * fields)
        self.assertLess(shared, apart - 2.7 * fields)

    def test_answers_are_the_same(self):
        self.run_well([GROVE, "generate", "map", "random", "--width", 256, "--height", 256,
                       "--obstacles", "0.1", "--seed", 1, "-o", "large.map"])
        for seed, more in ((1, []), (2, ["--mg"])):
            self.run_well([GROVE, "generate", "instance", "--map", "large.map", "--agents", 16, "--tasks",
                           150, "--seed", seed, *more, "-o", "middling.cts.json"])
            found = []
            for ranks, options in ((1, []), (3, []), (3, self.WITHOUT)):
                said = self.run_well(self.with_mca(options, mpirun(
                    ranks, "solve", "middling.cts.json", "--omega", 0, "--threads", 1, "--output",
                    "plan.json")))
                self.assertEqual("MB shared" in said, (ranks, options) == (3, []), said)
                self.run_well([GROVE, "check", "middling.cts.json", "plan.json"])
                found.append((self.plan()["status"], self.plan()["cost"], self.plan()["lower_bound"]))
                (self.folder / "plan.json").unlink()
            self.assertEqual(found[0][0], "optimal")
            self.assertEqual(found, found[:1] * 3)

    def test_too_little_room(self):
        """A container's /dev/shm."""
        instance = self.large()
        if os.geteuid() != 0:
            self.skipTest("only root can mount a small /dev/shm")
        command = " ".join(map(shlex.quote, map(str, mpirun(2, "solve", instance, "--threads", 1,
                                                            "--time-limit", 0))))
        code, said = run(["unshare", "--mount", "sh", "-c",
                          f"mount -t tmpfs -o size=64m tmpfs /dev/shm && {command}"], self.folder)
        if "mount:" in said or "unshare:" in said:
            self.skipTest("nothing can be mounted here")
        self.assertEqual(code, 0, said)
        self.assertIn("share no memory", said)
        self.assertIn("too little memory in /dev/shm", said)

    def test_a_rank_that_stands_still_while_fields_are_made(self):
        running = start(mpirun(3, "solve", self.large(), "--omega", 0, "--threads", 1), self.folder)
        self.addCleanup(running.kill)

        def making_fields():
            ranks = processes_of(running)
            return ranks if len(ranks) == 3 and held_by(ranks[0]) > 40e6 else None

        ranks = wait_until("fields are made", making_fields, running)
        self.stop(ranks[2])
        before = progress_of(ranks[1])
        wait_until("the others go on without it", lambda: progress_of(ranks[1]) > before + 300, running)
        os.kill(ranks[2], signal.SIGCONT)
        wait_until("all ranks search", lambda: all(map(searches, ranks.values())), running)
        self.assertIn("Lower bound", self.end_well(running, ranks))


class Batches(Program):
    def instances(self, count):
        folder = self.folder / "instances"
        folder.mkdir()
        for seed in range(count):
            self.run_well([GROVE, "generate", "instance", "--map", DATA / "rooms-32x32.map",
                           "--agents", 4, "--tasks", 5, "--seed", seed,
                           "-o", folder / f"i{seed}.cts.json"])
        return folder

    def rows(self):
        with open(self.folder / "results/results.csv", encoding="utf-8", newline="") as table:
            return {row["instance"]: row for row in csv.DictReader(table)}

    def batch(self, *more):
        return ["batch", "instances", "--output", "results", "--omega", 0, "--threads", 1, *more]

    def test_every_instance_once_whoever_solves_it(self):
        folder = self.instances(5)
        (folder / "broken.cts.json").write_text("{")
        said = self.run_well(mpirun(3, *self.batch("--ranks-per-instance", 2)))
        self.assertIn("6/6", said)
        self.assertIn("table: results/results.csv\n", said)
        rows = self.rows()
        self.assertEqual(len(rows), 6)
        self.assertIn("broken.cts.json", rows.pop("broken")["error"])
        for name, row in rows.items():
            self.assertEqual((row["status"], row["solved"]), ("optimal", "true"))
            self.assertEqual((row["map"], row["problem"], row["agents"]), ("rooms-32x32", "cts", "4"))
            self.assertEqual((row["method"], row["options"]), ("auto", "'--omega 0 --ranks-per-instance 2"))  # no formula to spreadsheets
            self.run_well([GROVE, "check", folder / f"{name}.cts.json",
                           self.folder / "results" / row["plan_file"]])
        self.run_well([GROVE, "report", "results", "-o", "report"])
        self.assertIn("Instances that could not be read: broken.", (self.folder / "report/report.html").read_text())

    def test_the_same_command_goes_on(self):
        folder = self.instances(3)
        self.run_well(mpirun(2, *self.batch()))
        before = self.rows()
        (folder / "i0.cts.json").rename(folder / "later.cts.json")
        self.run_well(mpirun(2, *self.batch()))
        after = self.rows()
        self.assertEqual(set(after), {"i0", "i1", "i2", "later"})
        self.assertEqual({name: after[name] for name in before}, before)
        self.refuses(mpirun(2, *self.batch("--seed", 5)), "seed")

    def test_a_method_that_is_not_for_an_instance(self):
        (self.folder / "instances").write_text(f"{ONE_WAY}\n", encoding="utf-8")
        self.run_well(mpirun(2, *self.batch("--method", "hcbs", "--ranks-per-instance", 2)))
        row, = self.rows().values()
        self.assertEqual(row["status"], "unsupported")
        self.assertIn("one way", row["error"])

    def test_input_is_complained_about_once(self):
        self.refuses(mpirun(2, *self.batch()), "instances")
        self.instances(1)
        self.refuses(mpirun(2, *self.batch("--ranks-per-instance", 3)), "--ranks-per-instance", "found 3", "at most 2")


if __name__ == "__main__":
    unittest.main()
