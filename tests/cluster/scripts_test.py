#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the job scripts with the options of docs/command-line.md (except NOT_OURS), including options that the scripts
set themselves. Runs without Slurm (its commands are replaced) and on one rank."""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import CLUSTER, DATA, ROOT, checked_plan, hard_instance, program
from mpi_test import MpiTest  # support.py has extended the module path

INSTANCE = DATA / "first.cts.json"
SLURM = {
    # Skips the options of srun and runs the command after them.
    "srun": 'while case $1 in --*) ;; *) false ;; esac; do shift; done; exec "$@"',
    "scontrol": 'echo "$@" >>scontrol.log',
}
# grove-mpi supports neither --deterministic nor --log-tree, and no method that --anytime requires. The start plan can
# violate --no-following.
NOT_OURS = {"--deterministic", "--anytime", "--log-tree", "--no-following"}
VALUES = {
    "--omega": "0.5", "--time-limit": "20", "--memory-limit": "1", "--threads": "1",
    "--method": "auto", "--policy": "fixed", "--rtsp": "dp", "--seed": "3", "--checkpoint": "other",
    "--checkpoint-interval": "60", "--resume": "never", "--start": "start.json",
    "--incumbents": "best", "--proof": "bound.proof", "--output": "other.json", "--require-plan": None,
    "--log": "run.log",
    "--log-format": "jsonl", "--verbose": None, "--quiet": None, "--confine": None,
}
TECHNIQUES = {"--without": "bypass"}  # a technique of the free policy only
OF_SCENARIOS = {"--map": DATA / "empty-32x32.map", "--agents": "3"}


def documented():
    table = (ROOT / "docs/command-line.md").read_text(encoding="utf-8").split("## Options of grove solve", 1)[1]
    rows = [line.split("|")[1] for line in table.split("\n#", 1)[0].splitlines()
            if line.startswith("| `--")]
    return {option for row in rows for option in re.findall(r"--[a-z][a-z-]*", row)}


def words(options):
    return [str(word) for option in options.items() for word in option if word is not None]


def until(condition):
    """Returns shell code that waits until `condition` holds or the background process has ended."""
    return f"until {condition} || ! kill -0 $!; do sleep 0.05; done 2>/dev/null"


class Scripts(MpiTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name, body in SLURM.items():
            self.executable(f"bin/{name}", body)
        (self.folder / "instances.txt").write_text(f"{INSTANCE}\n", encoding="utf-8")
        self.solve("start.json")

    def executable(self, name, body):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        path.chmod(0o755)
        return path

    def solve(self, plan):
        subprocess.run([program("GROVE"), "solve", INSTANCE, "--quiet", "-o", plan], cwd=self.folder,
                       check=True)

    def run_script(self, name, *arguments, grove_mpi=None, code=0, granted=None):
        environment = {
            **os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "SLURM_JOB_ID": "7",
            "SLURM_CPUS_PER_TASK": "1", "SLURM_NTASKS_PER_NODE": "1",
            "SLURM_ARRAY_TASK_ID": "1", "GROVE_MPI": str(grove_mpi or program("GROVE_MPI")), **(granted or {})}
        done = subprocess.run(["bash", CLUSTER / name, *map(str, arguments)], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment,
                              check=False)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def test_every_documented_option_has_a_value_here(self):
        self.assertEqual({*VALUES, *TECHNIQUES, *OF_SCENARIOS, *NOT_OURS}, documented())

    def test_scripts_pass_every_option_on(self):
        for script, what in (("solve.sbatch", INSTANCE), ("array.sbatch", "instances.txt"),
                             ("preempt.sbatch", INSTANCE)):
            self.run_script(script, what, *words(VALUES))
            checked_plan(INSTANCE, self.folder / "other.json")
            self.assertEqual(json.loads((self.folder / "run.log").read_text().splitlines()[-1])["plan_file"],
                             "other.json")
            self.assertTrue((self.folder / "other/checkpoint.grove").exists())
            (self.folder / "other.json").unlink()
            self.run_script(script, what, *words(TECHNIQUES))

    def test_defaults_of_the_scripts_are_used(self):
        self.run_script("array.sbatch", "instances.txt")
        checked_plan(INSTANCE, self.folder / "plans/1-first.plan.json")
        self.run_script("array.sbatch", "instances.txt", "--checkpoint", "kept/%a")
        self.assertTrue((self.folder / "kept/1/checkpoint.grove").exists())
        self.run_script("preempt.sbatch", INSTANCE)
        checked_plan(INSTANCE, self.folder / "first.plan.json")
        self.assertTrue((self.folder / "first.checkpoint/checkpoint.grove").exists())

    def test_memory_limit_is_the_grant_of_slurm(self):
        cores = {"SLURM_MEM_PER_CPU": "500", "SLURM_CPUS_ON_NODE": "2"}
        for granted, output in (({"SLURM_MEM_PER_NODE": "2000"}, "2.1 GB of them granted"), ({}, ""),
                                (cores, "1.0 GB of them granted")):
            for script, what in (("solve.sbatch", INSTANCE), ("array.sbatch", "instances.txt"),
                                 ("preempt.sbatch", INSTANCE)):
                self.run_script(script, what, "--log", "run.log", granted=granted)
                self.assertIn(output, (self.folder / "run.log").read_text(encoding="utf-8"))

    def test_array_counts_a_last_line_without_a_newline(self):
        command = re.search(r'--array=1-"\$\((.*?)\)"', (CLUSTER / "array.sbatch").read_text(encoding="utf-8")).group(1)
        (self.folder / "instances.txt").write_text(f"{DATA}/missing.cts.json\n{INSTANCE}", encoding="utf-8")
        lines = subprocess.run(["sh", "-c", command], cwd=self.folder, check=True, text=True,
                               stdout=subprocess.PIPE).stdout
        self.assertEqual(lines, "2\n")
        self.run_script("array.sbatch", "instances.txt", granted={"SLURM_ARRAY_TASK_ID": "2"})
        checked_plan(INSTANCE, self.folder / "plans/2-first.plan.json")

    def test_scripts_run_scenarios(self):
        for script in ("solve.sbatch", "preempt.sbatch"):
            self.run_script(script, DATA / "empty-32x32.scen", *words(OF_SCENARIOS), "--output", "p")

    def requeued(self):
        """Returns the number of times the job was requeued."""
        log = self.folder / "scontrol.log"
        return log.read_text(encoding="utf-8").count("requeue 7\n") if log.exists() else 0

    def test_interrupted_run_is_requeued_with_any_log_option(self):
        hard = hard_instance(self.folder)
        checkpoint = self.folder / "hard.checkpoint/checkpoint.grove"
        interrupted = self.executable("interrupted", f'''"{program("GROVE_MPI")}" "$@" --checkpoint-interval 0.2 &
{until(f"[ -e {checkpoint} ]")}
kill $!
wait $!''')
        for number, log in enumerate((["--quiet"], ["--log", "a"], ["--log=b", "--log-format", "jsonl"])):
            checkpoint.unlink(missing_ok=True)
            self.run_script("preempt.sbatch", hard, "--resume", "never", *log, grove_mpi=interrupted)
            self.assertEqual(self.requeued(), number + 1)

    def test_plan_of_an_earlier_interrupted_run_requeues_no_job(self):
        plan = json.loads((self.folder / "start.json").read_text(encoding="utf-8"))
        plan["stats"]["stopped_by"] = "interrupt"
        (self.folder / "first.plan.json").write_text(json.dumps(plan), encoding="utf-8")
        output = self.run_script("preempt.sbatch", INSTANCE, "--time-limit", "0")
        self.assertIn("first.plan.json keeps its valid plan", output)
        self.assertEqual(self.requeued(), 0)

    def test_run_with_a_lost_rank_restarts_from_its_checkpoint(self):
        lost = self.executable("lost", f'''echo >>runs
[ "$(wc -l <runs)" -gt 2 ] && exec "{program("GROVE_MPI")}" "$@" --time-limit 0
"{program("GROVE_MPI")}" "$@" --checkpoint-interval 0.2 &
{until('[ "$(find hard.checkpoint/checkpoint.grove -newer runs)" ]')}
kill -KILL $!
wait $!''')
        hard = hard_instance(self.folder)
        runs = self.folder / "runs"
        output = self.run_script("preempt.sbatch", hard, grove_mpi=lost)
        self.assertIn("A rank was lost (exit code 137): restart 2 of 3\n", output)
        self.assertEqual(runs.read_text().count("\n"), 3)
        self.assertEqual(output.count("Resuming from a checkpoint"), 2)
        runs.unlink()
        self.run_script("preempt.sbatch", "--restarts", "1", hard, "--resume", "never", grove_mpi=lost, code=137)
        self.assertEqual(runs.read_text().count("\n"), 2)
        bad = self.run_script("preempt.sbatch", hard, "--no-such-option", code=2)
        self.assertNotIn("restart", bad)
        bad = self.run_script("preempt.sbatch", "--restarts", hard, code=2)
        self.assertEqual(bad, f"preempt.sbatch: --restarts: found '{hard}'; expected a whole number\n")

    def test_answer_without_an_unresponsive_rank_is_accepted(self):
        for warning in ("did not respond at shutdown", "said nothing when all was to end"):
            silent = self.executable("silent", f'''echo >>runs
"{program("GROVE_MPI")}" "$@"
for log in *.log; do echo "Warning: 1 of 2 ranks {warning}: ..." >>"$log"; done
exit 137''')
            output = self.run_script("preempt.sbatch", hard_instance(self.folder), "--time-limit", "0",
                                     grove_mpi=silent)
            self.assertNotIn("restart", output)
            self.assertEqual((self.folder / "runs").read_text().count("\n"), 1)
            for file in (self.folder / "runs", *self.folder.glob("*.log")):
                file.unlink()


if __name__ == "__main__":
    unittest.main()
