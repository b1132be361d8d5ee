# SPDX-License-Identifier: MIT
"""Provides helpers for tests of grove-mpi. The environment variables GROVE_MPI and GROVE name the programs."""
import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

DATA = Path(__file__).resolve().parents[2] / "benchmarks/data"
GROVE = os.environ.get("GROVE", "")
GROVE_MPI = os.environ.get("GROVE_MPI", "")

# Containers run as root, and Open MPI then requires these variables.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def mpirun(ranks, *command):
    """Returns the command line that runs grove-mpi on `ranks` ranks."""
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks), GROVE_MPI,
            *map(str, command)]


def run(command, folder):
    """Runs a command and returns its exit code and combined output."""
    done = subprocess.run([str(word) for word in command], cwd=folder, env=ENVIRONMENT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def start(command, folder, **variables):
    return subprocess.Popen([str(word) for word in command], cwd=folder, env={**ENVIRONMENT, **variables},
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def plan_of(path):
    return json.loads(Path(path).read_text(encoding="utf-8"))


def memory_of(pid):
    """Returns the proportional set size of a process in bytes, or 0 if the process has ended."""
    try:
        rollup = Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="utf-8")
    except OSError:
        return 0
    return sum(int(line.split()[1]) * 1024 for line in rollup.splitlines() if line.startswith("Pss:"))


def processes_of(process):
    """Returns {rank: process id} of the ranks on this machine that `process`, an mpirun or one of its ancestors, has
    started."""
    pids = subprocess.run(["pgrep", "--parent", str(process.pid if isinstance(process, subprocess.Popen) else process)],
                          capture_output=True, text=True).stdout.split()
    ranks = {}
    for pid in pids:
        try:
            variables = Path(f"/proc/{pid}/environ").read_text(encoding="utf-8").split("\0")
        except OSError:
            continue
        numbers = [variable.split("=")[1] for variable in variables if variable.startswith("OMPI_COMM_WORLD_RANK=")]
        ranks.update({int(numbers[0]): int(pid)} if numbers else processes_of(pid))
    return ranks


THREADS_OF_MPI = 3  # threads of a rank before its search threads start: the communication thread and two of Open MPI


def searches(pid):
    """Returns whether the rank of process `pid` has search threads."""
    try:
        return len(os.listdir(f"/proc/{pid}/task")) > THREADS_OF_MPI
    except FileNotFoundError:
        return False
