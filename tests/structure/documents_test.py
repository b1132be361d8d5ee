#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the commands that a document shows.

    documents_test.py DOCUMENT BIN_DIR DATA_DIR

Every command in a ```console block (after "$ ") or a ```sh block that begins with `grove` or
`build/release/bin/grove`, or with mpirun and then one of these, must end with exit code 0. They run
one after the other in a temporary folder that holds a copy of DATA_DIR as benchmarks/data and BIN_DIR as build/release/bin.
Exit codes: 0 all ran, 1 one did not, 77 nothing to run (no document or no program yet).
"""
import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
SECONDS_PER_COMMAND = 120
BLOCK = re.compile(r"^```(console|sh)\s*\n(.*?)^```", re.M | re.S)
OURS = re.compile(r"(?:mpirun (?:\S+ )*)?(?:build/release/bin/)?grove(?:-\w+)?(?:\s|$)")
# mpirun minds root, and fewer cores than ranks.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def commands(document):
    found = []
    for language, body in BLOCK.findall(document):
        lines = body.replace("\\\n", " ").splitlines()
        if language == "console":
            lines = [line[2:] for line in lines if line.startswith("$ ")]
        found += [line.strip() for line in lines if OURS.match(line.strip())]
    return found


def run(command, folder):
    path = f"{folder}/build/release/bin:{os.environ['PATH']}"
    try:
        done = subprocess.run(["bash", "-c", command], cwd=folder, timeout=SECONDS_PER_COMMAND,
                              env={**os.environ, **MPI, "PATH": path}, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    except subprocess.TimeoutExpired:
        print(f"FAILED (no end after {SECONDS_PER_COMMAND} s): {command}")
        return False
    print(f"{'ok' if done.returncode == 0 else f'FAILED (exit {done.returncode})'}: {command}")
    if done.returncode != 0:
        print(done.stdout)
    return done.returncode == 0


def self_test():
    document = ("```console\n$ grove solve a \\\n    --quiet\nsome output\n$ ls\n```\n"
                "```sh\nbuild/release/bin/grove check a b\nmpirun -np 2 grove-mpi x\ncmake --build .\n```\n"
                "```\ngrove not this\n```\n")
    assert commands(document) == ["grove solve a      --quiet",
                                  "build/release/bin/grove check a b",
                                  "mpirun -np 2 grove-mpi x"], commands(document)
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        assert run("true", folder) and not run("exit 3", folder)


def main():
    document, programs, data = (Path(argument).resolve() for argument in sys.argv[1:])
    self_test()
    for needed in (document, programs / "grove"):
        if not needed.exists():
            print(f"skipped: there is no {needed}")
            return SKIPPED
    shown = commands(document.read_text(encoding="utf-8"))
    if not shown:
        print(f"FAILED: {document} shows no command of ours")
        return 1
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "build/release").mkdir(parents=True)
        (Path(folder) / "build/release/bin").symlink_to(programs)
        if data.is_dir():
            shutil.copytree(data, Path(folder) / "benchmarks/data")
        return 0 if all([run(command, folder) for command in shown]) else 1


if __name__ == "__main__":
    sys.exit(main())
