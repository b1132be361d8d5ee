# SPDX-License-Identifier: MIT
"""Waits for events in tests of programs, and never for a fixed time."""
import time
from pathlib import Path

HANG_S = 300  # time limit of a wait, to end a test that hangs; no event takes as long, even on a busy machine
LOOK_S = 0.02


def wait_until(what, condition, process=None):
    """Waits until condition() is true and returns its result. Fails if `process` ends first, or after HANG_S
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
    """Returns the text written to a file so far; empty if the file does not exist yet."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""


def state_of(pid):
    """Returns the state letter of a process (R, S, T for stopped, Z and others), or None if the process is gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
    except OSError:
        return None


def progress_of(pid):
    """Returns a number that grows while a process runs: the voluntary context switches of its first thread plus its
    processor time in clock ticks."""
    status, stat = text_of(f"/proc/{pid}/status"), text_of(f"/proc/{pid}/stat")
    if not stat:
        raise AssertionError(f"process {pid} is gone")
    slept = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("voluntary_ctxt_switches:"))
    return slept + sum(map(int, stat.rsplit(")", 1)[1].split()[11:13]))
