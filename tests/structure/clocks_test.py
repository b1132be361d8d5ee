#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that only the tests listed here read a clock or sleep, and that only the sources listed here read a clock.

    clocks_test.py [ROOT]   checks the tree at ROOT, by default this one
"""
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from structure_test import ROOT, without_comments_and_strings  # noqa: E402

# Other tests take the time from tests/support/clocks.h and wait with tests/support/waiting.py or run_program().
TESTS = {
    "support/clocks.h": "the limit that ends tests that hang",
    "support/subprocess.cpp": "waits for the end of a program, and kills one that hangs",
    "support/waiting.py": "waits for events, and ends tests that hang",
    "tools/devtools.py": "waits for the browser, and measures how soon a page is loaded",
    "tools/view/interaction_test.py": "prints how long pages take; --all checks the limits of the documents",
    "tools/view/gl_page.ts": "measures frames; the test prints them",
    "tools/bench/fake_solver.py": "a solver that exceeds its limit; and one that reports its own time",
    "fuzz/run_case.cpp": "a run must end soon after its deadline, by processor time",
    "fuzz/fuzz_test.cpp": "a solver that ignores its deadline, to test that run_case.cpp detects it",
    "fuzz/campaign.cpp": "a campaign has a time limit",
    "fuzz/fuzz.cpp": "a campaign, not a test: time limit",
    "fuzz/fuzz_metamorphic.cpp": "a campaign, not a test: time limit",
    "fuzz/fuzz_joint.cpp": "a campaign, not a test: measures",
    "fuzz/fuzz_feasibility.cpp": "a campaign, not a test: measures",
    "fuzz/fuzz_certificates.cpp": "a campaign, not a test: time limit of each search",
    "engine/fuzz_replan.cpp": "a campaign, not a test: measures",
    "execution/fuzz_execution.cpp": "a campaign, not a test: time limit of each search",
    "mpi/kill_and_resume.py": "a campaign kills ranks at random times; the test waits for checkpoints",
    "cluster/scripts_test.py": "shell scripts that poll for a file",
    "cluster/harness_test.py": "shell scripts that poll for a file",
    "cluster/slurm_preemption_test.py": "a Slurm node refuses a job in the second in which it ends, "
                                        "and does not report it",
}
# Other sources take the time from Limits::now(), which a test can set.
LAYERS = {
    "src/model/limits.h": "the clock",
    "src/api/run.h": "the public API: its users' seconds",
    "src/api/solve.cpp": "the public API: its users' seconds",
    "src/batch/batch_clock.cpp": "the clock that batches use",
    "src/io/atomic_file.cpp": "unique names; the age of files",
    "src/io/file_lock.cpp": "reports since when a folder is locked",
}

READS_CPP = re.compile(r"[cC]lock::now\s*\(|\bstd::clock\s*\(|\bclock_gettime\s*\(\s*CLOCK_(?:REALTIME|MONOTONIC)"
                       r"|\bgettimeofday\b"
                       r"|\btime\s*\(\s*(?:nullptr|NULL|0)\s*\)")
SLEEPS_CPP = re.compile(r"\bsleep_(?:for|until)\b|\bwait_(?:for|until)\s*\(\s*\w+,|(?<!\w)u?sleep\s*\(|\bnanosleep\b")
PYTHON = re.compile(r"\btime\.(?:sleep|time|monotonic|perf_counter|process_time)(?:_ns)?\(|\bthreading\.Timer\("
                    r"|\bfrom time import|\bdatetime\.now\(")
SCRIPT = re.compile(r"\b(?:performance|Date)\.now\(|\bsetTimeout\(")
SHELL = re.compile(r"\bsleep (?:\d?\.\d+|[1-9]\d?)(?![\d.])")  # not the long sleeps of simulated hangs


def uses_time(name, text):
    """Returns whether a test reads a clock or sleeps."""
    if name.endswith((".cpp", ".h")):
        code = without_comments_and_strings(text)
        return bool(READS_CPP.search(code) or SLEEPS_CPP.search(code) or SHELL.search(text))
    if name.endswith(".ts"):
        return bool(SCRIPT.search(text))
    return bool(PYTHON.search(text) or SHELL.search(text))


class Clocks(unittest.TestCase):
    def test_only_listed_tests_use_time(self):
        found = {str(path.relative_to(ROOT / "tests")) for path in (ROOT / "tests").rglob("*")
                 if path.suffix in {".cpp", ".h", ".py", ".ts"} and path != Path(__file__).resolve()
                 and uses_time(path.name, path.read_text(encoding="utf-8"))}
        self.assertEqual(sorted(found - set(TESTS)), [],
                         "wait for an event, and take the time from tests/support/clocks.h")
        self.assertEqual(sorted(set(TESTS) - found), [], "no exception is needed any more")

    def test_only_listed_sources_read_a_clock(self):
        found = {str(path.relative_to(ROOT)) for folder in ("include", "src", "mpi")
                 for path in (ROOT / folder).rglob("*")
                 if path.suffix in {".cpp", ".h", ".hpp"}
                 and READS_CPP.search(without_comments_and_strings(path.read_text(encoding="utf-8")))}
        self.assertEqual(sorted(found - set(LAYERS)), [], "take the time from Limits::now()")
        self.assertEqual(sorted(set(LAYERS) - found), [], "no exception is needed any more")

    def test_clock_reads_and_sleeps_are_found(self):
        for name, text in (("a.cpp", "auto t = Limits::Clock::now();"), ("a.cpp", "x = steady_clock::now ();"),
                           ("a.h", "std::this_thread::sleep_for(1ms);"), ("a.cpp", "std::clock() < 3"),
                           ("a.cpp", 'run("sleep 0.2");'), ("a.cpp", "usleep(3);"), ("a.cpp", "time(nullptr)"),
                           ("a.py", "    time.sleep(1)"), ("a.py", "time.monotonic() - t"),
                           ("a.py", "from time import sleep"),
                           ("a.py", "'sleep 2; exit'"), ("a.ts", "performance.now()")):
            self.assertTrue(uses_time(name, text), text)
        for name, text in (("a.cpp", "// Clock::now()"), ("a.cpp", 'run("exec sleep 600");'), ("a.cpp", "limits.now()"),
                           ("a.py", "await asyncio.sleep(2)"), ("a.py", '"sleep 1000"'), ("a.cpp", "wait_until(x)"),
                           ("a.ts", "player.time")):
            self.assertFalse(uses_time(name, text), text)


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
