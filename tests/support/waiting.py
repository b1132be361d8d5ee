# SPDX-License-Identifier: MIT
"""How tests of programs wait: for an event, never for a time."""
import time
from pathlib import Path

HANG_S = 300  # ends a test that hangs; on the busiest machine no event takes so long
LOOK_S = 0.02


def wait_until(what, condition, process=None):
    """Returns what condition() returned as soon as that is true. Fails if `process` ends before, or nothing
    happens."""
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
    """The content of a file as far as it is written; empty before it is there."""
    try:
        return Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""


def state_of(pid):
    """The state of a process, a letter: R, S, T (stopped), Z; None when it is gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
    except OSError:
        return None


def progress_of(pid):
    """Grows as long as a process goes on: how often its first thread has slept, and its hundredths of a second on
    a processor."""
    status, stat = text_of(f"/proc/{pid}/status"), text_of(f"/proc/{pid}/stat")
    if not stat:
        raise AssertionError(f"process {pid} is gone")
    slept = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("voluntary_ctxt_switches:"))
    return slept + sum(map(int, stat.rsplit(")", 1)[1].split()[11:13]))
