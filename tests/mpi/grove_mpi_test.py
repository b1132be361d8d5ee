#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests grove-mpi as users run it, under mpirun."""
import contextlib
import csv
import json
import os
import re
import shlex
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import kill_and_resume
from mpi_program import (DATA, ENVIRONMENT, GROVE, GROVE_MPI, memory_of, mpirun, plan_of, processes_of,
                         run, searches, start)
from mpi_test import MpiTest
from waiting import progress_of, state_of, text_of, wait_until

EASY = DATA / "rooms-32x32_n10_m30.cts.json"
ONE_WAY = DATA / "yard.cts.json"
ENDLESS = 60, 100, 3  # agents, tasks, seed of an instance with a gap of 9 % for a long time


def end_process(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGKILL)


class Program(MpiTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def generate(self, agents, tasks, seed):
        """Generates an instance on the map rooms-32x32 and returns its path."""
        path = self.folder / "generated.cts.json"
        self.run_well([GROVE, "generate", "instance", "--map", DATA / "rooms-32x32.map", "--agents",
                       agents, "--tasks", tasks, "--seed", seed, "-o", path])
        return path

    def run_well(self, command):
        code, output = run(command, self.folder)
        self.assertEqual(code, 0, output)
        return output

    def refuses(self, command, *texts):
        """Asserts that the command exits with code 2 and prints exactly one error message, which contains `texts`."""
        code, output = run(command, self.folder)
        self.assertEqual(code, 2, output)
        complaints = [line for line in output.splitlines() if line.startswith("grove-mpi: error:")]
        self.assertEqual(len(complaints), 1, output)
        for text in texts:
            self.assertIn(text, complaints[0])

    def plan(self):
        return plan_of(self.folder / "plan.json")

    def searching_ranks(self, running, count=3):
        """Waits until all `count` ranks search and returns {rank: process id}. The processes are killed after the
        test."""
        self.addCleanup(running.kill)

        def all_search():
            ranks = processes_of(running)
            return ranks if len(ranks) == count and all(map(searches, ranks.values())) else None

        ranks = wait_until("all ranks search", all_search, running)
        for process in ranks.values():
            self.addCleanup(end_process, process)
        return ranks

    def stop(self, process):
        """Stops a process with SIGSTOP and waits until it is stopped."""
        os.kill(process, signal.SIGSTOP)
        wait_until("the process is stopped", lambda: state_of(process) == "T")

    def interrupt_all(self, running, ranks):
        """Interrupts all ranks, asserts exit code 0 and returns the output. (A signal to mpirun would make mpirun
        report a failure.)"""
        for process in ranks.values():
            os.kill(process, signal.SIGTERM)
        output, _ = running.communicate()
        self.assertEqual(running.returncode, 0, output)
        return output


class Help(Program):
    def test_help_needs_no_mpi(self):
        """Runs the program without mpirun and with a nonexistent transport, so that MPI_Init would fail."""
        variables = {"PATH": "/nonexistent", "OMPI_MCA_btl": "nonexistent", "OMPI_MCA_pml": "nonexistent"}
        for words in (["--help"], ["--version"], ["help", "solve"], ["solve", "-h"], ["help", "--completion", "bash"]):
            asked = start([GROVE_MPI, *words], self.folder, **variables)
            output, _ = asked.communicate(timeout=60)
            self.assertEqual(asked.returncode, 0, output)
            self.assertIn("grove", output)
        solve = start([GROVE_MPI, "solve", EASY], self.folder, **variables)
        solve.communicate(timeout=60)
        self.assertNotEqual(solve.returncode, 0)

    def test_only_one_rank_prints_the_version(self):
        output = self.run_well(mpirun(3, "--version"))
        self.assertEqual(output.count("grove"), 1, output)


class Answers(Program):
    def test_optimum_is_found_by_any_number_of_ranks_and_threads(self):
        instance = self.generate(16, 20, 5)  # takes some thousands of nodes
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

    def test_fixed_policy_finds_a_plan(self):
        self.run_well(mpirun(2, "solve", DATA / "rooms-32x32_n5_m10.cts.json", "--policy", "fixed",
                             "--output", "plan.json"))
        self.assertIn(self.plan()["status"], ("optimal", "bounded"))

    def test_no_following_raises_the_optimum(self):
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

    def test_instance_without_a_plan_is_infeasible(self):
        (self.folder / "two.map").write_text("type octile\nheight 1\nwidth 3\nmap\n.@.\n")
        (self.folder / "no.cts.json").write_text(
            '{"map": "two.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}],'
            ' "tasks": []}')
        self.run_well(mpirun(2, "solve", "no.cts.json", "--output", "plan.json"))
        self.assertEqual(self.plan()["status"], "infeasible")

    def test_log_reports_ranks_threads_and_hosts(self):
        output = self.run_well(mpirun(3, "solve", EASY, "--threads", 2, "--output", "plan.json"))
        self.assertIn("Threads       2 each on 3 ranks, 1 host", output)
        self.assertEqual(output.count("Plan file"), 1)
        if (os.cpu_count() or 0) < 6:
            self.assertRegex(output, r"Warning: host \S+ has \d+ cores for 6 threads")

    def test_json_log_has_counts_per_rank(self):
        output = self.run_well(mpirun(3, "solve", DATA / "rooms-32x32_n10_m30.cts.json", "--omega", 0,
                                    "--without", "primal", "--log-format", "jsonl", "--output", "plan.json"))
        log = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
        last = [event for event in log if event["event"] == "counts"][-1]
        stats = log[-1]["stats"]
        for column, count in (("low_level_calls", "low_level_calls"),
                              ("branching_cost_queries", "branching_cost_queries")):
            self.assertEqual(sum(last["ranks"][column]), stats[count])
        for column in last["ranks"].values():
            self.assertEqual(len(column), 3)
        self.assertTrue(all(memory > 0 for memory in last["ranks"]["memory_mb"]))
        self.refuses(mpirun(2, "solve", EASY, "--log-format", "jsonl", "--log-tree", 5), "--log-tree")

    def test_plan_is_written_when_output_streams_fail(self):
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

    def test_unsupported_method_is_refused(self):
        self.refuses(mpirun(2, "solve", ONE_WAY, "--method", "hcbs"), ONE_WAY.name, "method hcbs", "two-way roads")
        self.refuses(mpirun(2, "solve", EASY, "--method", "cts-cbs-a"), "cts-cbs-a")

    def test_confine_refuses_maps_outside_the_folder(self):
        elsewhere = self.folder / "theirs/i.cts.json"
        elsewhere.parent.mkdir()
        elsewhere.write_text(json.dumps(json.loads(EASY.read_text()) | {"map": str(DATA / "rooms-32x32.map")}))
        self.refuses(mpirun(2, "solve", elsewhere, "--confine"), "/map", "is an absolute path")
        self.run_well(mpirun(2, "batch", elsewhere.parent, "--confine", "--output", "results", "--threads", 1))
        with open(self.folder / "results/results.csv", encoding="utf-8", newline="") as table:
            row, = csv.DictReader(table)
        self.assertIn("is an absolute path", row["error"])

    def test_ranks_with_different_options_are_refused(self):
        one = ["mpirun", "--oversubscribe", "-np", 1, GROVE_MPI, "solve", EASY, "--seed", 1]
        other = [":", "-np", 1, GROVE_MPI, "solve", EASY, "--seed", 2]
        self.refuses(one + other, "rank 1", "options", "--seed 2", "--seed 1")

    def test_invalid_option_of_one_rank_ends_the_job(self):
        for first, second in (("0", "x"), ("x", "0")):
            command = mpirun(1, "solve", EASY, "--omega", first)
            self.refuses([*command, ":", "-np", "1", GROVE_MPI, "solve", EASY, "--omega", second],
                         "--omega")

    def test_ranks_with_different_instances_are_refused(self):
        other = self.generate(3, 3, 1)
        self.refuses(["mpirun", "--oversubscribe", "-np", 1, GROVE_MPI, "solve", EASY,
                      ":", "-np", 1, GROVE_MPI, "solve", other], "rank 1", "instance")


class Files(Program):
    def test_run_without_a_plan_keeps_the_valid_plan_file(self):
        self.run_well(mpirun(2, "solve", EASY, "--output", "plan.json", "--quiet"))
        before = self.plan()
        output = self.run_well(mpirun(2, "solve", EASY, "--output", "plan.json", "--quiet", "--time-limit",
                                    0, "--require-plan"))
        self.assertEqual(output.count("grove: no plan was found (unknown, stopped by: time limit"), 1)
        self.assertIn(f"; plan.json keeps its valid plan of cost {before['cost']}", output)
        self.assertEqual(self.plan(), before)

    def test_instance_is_read_from_stdin_and_plan_written_to_stdout(self):
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

    def test_checkpoint_folder_is_locked_during_a_run(self):
        instance = self.generate(*ENDLESS)
        running = start(mpirun(2, "solve", instance, "--omega", 0, "--threads", 1, "--checkpoint", "kept",
                               "--quiet"), self.folder)
        ranks = self.searching_ranks(running, 2)  # a searching run holds the lock of the folder
        self.refuses(mpirun(2, "solve", instance, "--checkpoint", "kept", "--resume", "never",
                            "--output", "other.json"),
                     "kept/checkpoint.lock: is locked by another run (process ", " on host ")
        self.interrupt_all(running, ranks)


class Checkpoints(Program):
    def with_checkpoint(self, *more):
        return ["solve", EASY, "--omega", 0, "--checkpoint", "kept", "--output", "plan.json", *more]

    def test_grove_and_grove_mpi_resume_from_each_other(self):
        instance = self.generate(18, 30, 8)  # takes many seconds
        arguments = ["solve", instance, "--omega", 0, "--threads", 1, "--checkpoint", "kept",
                     "--resume", "auto", "--output", "plan.json"]
        bounds = []
        for command in ([GROVE, *arguments], mpirun(2, *arguments), [GROVE, *arguments],
                        mpirun(3, *arguments)):
            output = self.run_well([*command, "--time-limit", 1])
            self.assertEqual("Resuming" in output, bool(bounds), output)
            bounds.append(self.plan()["lower_bound"])
        self.assertEqual(bounds, sorted(bounds))

    def test_finished_search_resumes_with_the_same_answer(self):
        self.run_well(mpirun(2, *self.with_checkpoint()))
        before = self.plan()
        output = self.run_well(mpirun(3, *self.with_checkpoint("--resume", "auto")))
        self.assertIn("Resuming", output)
        after = self.plan()
        self.assertEqual((after["status"], after["cost"]), ("optimal", before["cost"]))

    def test_existing_checkpoint_needs_the_option_resume(self):
        self.run_well(mpirun(2, *self.with_checkpoint()))
        self.refuses(mpirun(2, *self.with_checkpoint()), "kept/checkpoint.grove", "--resume")
        self.run_well(mpirun(2, *self.with_checkpoint("--resume", "never")))

    def test_damaged_and_foreign_checkpoints_are_refused(self):
        self.run_well(mpirun(2, *self.with_checkpoint()))
        (self.folder / "kept/incumbent.plan.json").unlink()
        other = self.generate(3, 3, 1)
        self.refuses(mpirun(2, "solve", other, "--checkpoint", "kept", "--resume", "auto"),
                     "checkpoint.grove", "instance")
        file = self.folder / "kept/checkpoint.grove"
        content = bytearray(file.read_bytes())
        content[len(content) // 2] ^= 8
        file.write_bytes(content)
        self.refuses(mpirun(2, *self.with_checkpoint("--resume", "auto")), "checkpoint.grove")

    def test_file_instead_of_checkpoint_folder_is_refused(self):
        (self.folder / "kept").write_text("not a folder")
        self.refuses(mpirun(2, *self.with_checkpoint()), "kept", "folder")

    def test_sigusr1_writes_a_checkpoint(self):
        running = start(mpirun(2, "solve", self.generate(*ENDLESS), "--omega", 0, "--threads", 1,
                               "--checkpoint", "kept"), self.folder)
        ranks = self.searching_ranks(running, 2)  # mpirun forwards signals only once its ranks run
        self.assertFalse((self.folder / "kept/checkpoint.grove").exists())
        running.send_signal(signal.SIGUSR1)
        wait_until("a checkpoint", (self.folder / "kept/checkpoint.grove").exists, running)
        self.assertIn("stopped by: interrupt", self.interrupt_all(running, ranks))


class Faults(Program):
    def test_search_resumes_after_ranks_are_killed(self):
        killed = kill_and_resume.check(self.generate(18, 30, 8), kills=2, seed=1)
        self.assertGreater(killed, 0)

    def test_search_continues_while_a_rank_is_stopped(self):
        instance = self.generate(16, 20, 5)
        running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--without",
                               "primal,joint-search", "--output", "plan.json"), self.folder)
        ranks = self.searching_ranks(running)
        self.stop(ranks[2])
        before = progress_of(ranks[0])
        wait_until("rank 0 continues without the stopped rank", lambda: progress_of(ranks[0]) > before + 300, running)
        os.kill(ranks[2], signal.SIGCONT)
        output, _ = running.communicate()
        self.assertEqual(running.returncode, 0, output)
        self.assertEqual(self.plan()["status"], "optimal")
        self.run_well([GROVE, "check", instance, "plan.json"])

    def logged_events(self):
        """Returns the letters of the events in the log so far."""
        return set(re.findall(r"^([*HCLJB]) +\d", text_of(self.folder / "log"), re.MULTILINE))

    def check_end_without_rank(self, stopped, instance, more):
        """Asserts that an interrupted search ends although one rank remains stopped."""
        running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--log", "log",
                               "--output", "plan.json", *more), self.folder)
        ranks = self.searching_ranks(running)
        wait_until("a plan and a bound", lambda: {"B"} < self.logged_events(), running)
        self.stop(ranks[stopped])
        os.kill(ranks[0], signal.SIGTERM)
        output, _ = running.communicate()
        plan = self.plan()
        self.assertIn(plan["stats"]["unresponsive_ranks"], (1, 2))  # a further rank can respond late
        self.assertGreater(plan["lower_bound"], 0)
        self.assertRegex(output, "[12] of 3 ranks did not respond at shutdown")
        self.assertEqual("without a certificate" in output, bool(more), output)
        self.run_well([GROVE, "check", instance, "plan.json"])
        (self.folder / "plan.json").unlink()

    def test_interrupted_search_ends_with_an_unresponsive_rank(self):
        """Checks that the job reports what has been proven. (tests/mpi/protocol_test.cpp checks how soon it ends.)"""
        instance = self.generate(*ENDLESS)
        for stopped, more in ((1, []), (2, ["--checkpoint", "saved", "--resume", "never", "--proof", "proof.zst"])):
            self.check_end_without_rank(stopped, instance, more)

    def test_job_ends_when_rank_0_is_unresponsive(self):
        """Checks that the other ranks end the job without an answer."""
        instance = self.generate(*ENDLESS)
        limit = 2
        while True:
            running = start(mpirun(3, "solve", instance, "--omega", 0, "--threads", 1, "--time-limit", limit,
                                   "--tune=unresponsive-timeout=2", "--output", "plan.json"), self.folder)
            try:
                self.stop(self.searching_ranks(running)[0])
                break
            except AssertionError:  # on a busy machine the job can end before all ranks search
                running.communicate()
                self.assertLess(limit, 100)
                limit *= 4
        output, _ = running.communicate()
        self.assertNotEqual(running.returncode, 0)
        self.assertIn("rank 0 has not responded for 2 s after the limit", output)


class Memory(Program):
    """Tests the memory that the ranks of a host share through MPI windows, for distances and sequence tables."""

    WITHOUT = ["--mca", "osc", "^sm"]  # disables the only component of Open MPI that provides shared windows

    def large(self):
        """Generates an instance for which most of the memory, 118 MB, holds distances."""
        self.run_well([GROVE, "generate", "map", "random", "--width", 256, "--height", 256,
                       "--obstacles", "0.1", "--seed", 1, "-o", "large.map"])
        self.run_well([GROVE, "generate", "instance", "--map", "large.map", "--agents", 300,
                       "--tasks", 600, "--seed", 1, "-o", "large.cts.json"])
        return self.folder / "large.cts.json"

    def with_mca(self, options, command):
        return [command[0], *options, *command[1:]]

    def memory_of_ranks(self, ranks, instance, options):
        """Returns the total memory of the ranks in bytes, measured when all of them search, and the output of the
        job."""
        running = start(self.with_mca(options, mpirun(ranks, "solve", instance, "--omega", 0, "--threads", 1)),
                        self.folder)
        processes = self.searching_ranks(running, ranks)
        total = sum(memory_of(pid) for pid in processes.values())
        return total, self.interrupt_all(running, processes)

    def test_four_ranks_hold_the_distances_once(self):
        instance = self.large()
        fields = 100e6
        alone, output = self.memory_of_ranks(1, instance, [])
        self.assertNotIn("MB shared", output)
        shared, output = self.memory_of_ranks(4, instance, [])
        self.assertRegex(output, r"Threads .* on 4 ranks, 1 host, 1\d\d MB shared")
        self.assertNotIn("share no memory", output)
        apart, output = self.memory_of_ranks(4, instance, self.WITHOUT)
        self.assertNotIn("MB shared", output)
        self.assertRegex(output, r"Warning: ranks on host \S+ share no memory, .*: MPI cannot allocate shared memory")
        self.assertGreater(alone, fields)
        self.assertGreater(apart, 4 * fields)
        self.assertLess(shared, apart - 2.7 * fields)

    def test_answers_do_not_depend_on_shared_memory(self):
        self.run_well([GROVE, "generate", "map", "random", "--width", 256, "--height", 256,
                       "--obstacles", "0.1", "--seed", 1, "-o", "large.map"])
        for seed, more in ((1, []), (2, ["--mg"])):
            self.run_well([GROVE, "generate", "instance", "--map", "large.map", "--agents", 16, "--tasks",
                           150, "--seed", seed, *more, "-o", "middling.cts.json"])
            found = []
            for ranks, options in ((1, []), (3, []), (3, self.WITHOUT)):
                output = self.run_well(self.with_mca(options, mpirun(
                    ranks, "solve", "middling.cts.json", "--omega", 0, "--threads", 1, "--output",
                    "plan.json")))
                self.assertEqual("MB shared" in output, (ranks, options) == (3, []), output)
                self.run_well([GROVE, "check", "middling.cts.json", "plan.json"])
                found.append((self.plan()["status"], self.plan()["cost"], self.plan()["lower_bound"]))
                (self.folder / "plan.json").unlink()
            self.assertEqual(found[0][0], "optimal")
            self.assertEqual(found, found[:1] * 3)

    def test_too_small_shared_memory_is_reported(self):
        """Checks the warning for a small /dev/shm, as in a container."""
        instance = self.large()
        if os.geteuid() != 0:
            self.skipTest("only root can mount a small /dev/shm")
        command = " ".join(map(shlex.quote, map(str, mpirun(2, "solve", instance, "--threads", 1,
                                                            "--time-limit", 0))))
        code, output = run(["unshare", "--mount", "sh", "-c",
                          f"mount -t tmpfs -o size=64m tmpfs /dev/shm && {command}"], self.folder)
        if "mount:" in output or "unshare:" in output:
            self.skipTest("nothing can be mounted here")
        self.assertEqual(code, 0, output)
        self.assertIn("share no memory", output)
        self.assertIn("too little memory in /dev/shm", output)

    def test_other_ranks_compute_fields_while_a_rank_is_stopped(self):
        running = start(mpirun(3, "solve", self.large(), "--omega", 0, "--threads", 1), self.folder)
        self.addCleanup(running.kill)

        def computing_fields():
            ranks = processes_of(running)
            return ranks if len(ranks) == 3 and memory_of(ranks[0]) > 40e6 else None

        ranks = wait_until("distance fields are computed", computing_fields, running)
        self.stop(ranks[2])
        before = progress_of(ranks[1])
        wait_until("the other ranks continue without the stopped rank", lambda: progress_of(ranks[1]) > before + 300,
                   running)
        os.kill(ranks[2], signal.SIGCONT)
        wait_until("all ranks search", lambda: all(map(searches, ranks.values())), running)
        self.assertIn("Lower bound", self.interrupt_all(running, ranks))


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

    def test_each_instance_is_solved_once(self):
        folder = self.instances(5)
        (folder / "broken.cts.json").write_text("{")
        output = self.run_well(mpirun(3, *self.batch("--ranks-per-instance", 2)))
        self.assertIn("6/6", output)
        self.assertIn("table: results/results.csv\n", output)
        rows = self.rows()
        self.assertEqual(len(rows), 6)
        self.assertIn("broken.cts.json", rows.pop("broken")["error"])
        for name, row in rows.items():
            self.assertEqual((row["status"], row["solved"]), ("optimal", "true"))
            self.assertEqual((row["map"], row["problem"], row["agents"]), ("rooms-32x32", "cts", "4"))
            # The options are quoted, because a spreadsheet would otherwise read them as a formula.
            self.assertEqual((row["method"], row["options"]), ("auto", "'--omega 0 --ranks-per-instance 2"))
            self.run_well([GROVE, "check", folder / f"{name}.cts.json",
                           self.folder / "results" / row["plan_file"]])
        self.run_well([GROVE, "report", "results", "-o", "report"])
        self.assertIn("Instances that could not be read: broken.", (self.folder / "report/report.html").read_text())

    def test_repeated_command_resumes_the_batch(self):
        folder = self.instances(3)
        self.run_well(mpirun(2, *self.batch()))
        before = self.rows()
        (folder / "i0.cts.json").rename(folder / "later.cts.json")
        self.run_well(mpirun(2, *self.batch()))
        after = self.rows()
        self.assertEqual(set(after), {"i0", "i1", "i2", "later"})
        self.assertEqual({name: after[name] for name in before}, before)
        self.refuses(mpirun(2, *self.batch("--seed", 5)), "seed")

    def test_unsupported_method_gives_an_unsupported_row(self):
        (self.folder / "instances").write_text(f"{ONE_WAY}\n", encoding="utf-8")
        self.run_well(mpirun(2, *self.batch("--method", "hcbs", "--ranks-per-instance", 2)))
        row, = self.rows().values()
        self.assertEqual(row["status"], "unsupported")
        self.assertIn("two-way roads", row["error"])

    def test_input_is_complained_about_once(self):
        self.refuses(mpirun(2, *self.batch()), "instances")
        self.instances(1)
        self.refuses(mpirun(2, *self.batch("--ranks-per-instance", 3)), "--ranks-per-instance", "found 3", "at most 2")


if __name__ == "__main__":
    unittest.main()
