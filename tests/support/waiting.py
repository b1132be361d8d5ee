# SPDX-License-Identifier: MIT
"""Waits in tests of programs: for an event, never for a fixed time."""
import time
from pathlib import Path

HANG_S = 300  # ends a test that hangs; no event takes as long, even on a busy machine
LOOK_S = 0.02


def wait_until(what, condition, process=None):
    """Returns the result of condition() as soon as it is true. Fails if `process` ends before, or after HANG_S
    seconds."""
    end = time.monotonic() + HANG_S
    while not (found := condition()):
        if process is not None and process.poll() is not None and not (found := condition()):
            raise AssertionError(f"the program ended with {process.returncode} before: {what}")
        if found:
            break
        if time.monotonic() > end:
            raise AssertionError(f"after {HANG_S} s still not: {what}")
        time.sleep(LOOK_S)
    return found


def text_of(path):
    """Returns the content of a file as far as it is written; empty if it does not exist yet."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""


def state_of(pid):
    """Returns the state letter of a process: R, S, T (stopped), Z and others. Returns None if it has ended."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
    except OSError:
        return None


def progress_of(pid):
    """Returns a number that grows while a process runs: the voluntary context switches of its first thread plus its
    processor time in hundredths of a second."""
    status, stat = text_of(f"/proc/{pid}/status"), text_of(f"/proc/{pid}/stat")
    if not stat:
        raise AssertionError(f"process {pid} is gone")
    slept = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("voluntary_ctxt_switches:"))
    return slept + sum(map(int, stat.rsplit(")", 1)[1].split()[11:13]))
