#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Who reads a clock or sleeps: no test but those listed here, and no layer but those that hand time down.

    clocks_test.py [ROOT]   checks the tree at ROOT, by default this one
"""
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from structure_test import ROOT, without_comments_and_strings  # noqa: E402

# A test takes its time from tests/support/clocks.h, and waits by tests/support/waiting.py or run_program().
TESTS = {
    "support/clocks.h": "the limit that ends tests that hang",
    "support/subprocess.cpp": "waits for the end of a program, and kills one that hangs",
    "support/waiting.py": "waits for events, and ends tests that hang",
    "tools/devtools.py": "waits for the browser, and measures how soon a page is loaded",
    "tools/view/interaction_test.py": "prints how long pages take; --all holds them to promises of the documents",
    "tools/view/gl_page.ts": "measures frames; the test prints them",
    "tools/bench/fake_solver.py": "a solver that comes too late; and one that tells its own time",
    "fuzz/run_case.cpp": "a run must end soon after its deadline, by the time of its own processor",
    "fuzz/fuzz_test.cpp": "a solver that is deaf to its deadline, to see that the above is noticed",
    "fuzz/campaign.cpp": "a campaign has so many seconds",
    "fuzz/fuzz.cpp": "a campaign, not a test: so many seconds",
    "fuzz/fuzz_metamorphic.cpp": "a campaign, not a test: so many seconds",
    "fuzz/fuzz_joint.cpp": "a campaign, not a test: measures",
    "fuzz/fuzz_feasibility.cpp": "a campaign, not a test: measures",
    "fuzz/fuzz_certificates.cpp": "a campaign, not a test: so many seconds for each search",
    "engine/fuzz_replan.cpp": "a campaign, not a test: measures",
    "execution/fuzz_execution.cpp": "a campaign, not a test: so many seconds for each search",
    "mpi/kill_and_resume.py": "a campaign kills ranks at random times; the test waits for checkpoints",
    "cluster/scripts_test.py": "shell scripts that look for a file again and again",
    "cluster/harness_test.py": "shell scripts that look for a file again and again",
    "cluster/slurm_preemption_test.py": "Slurm's nodes refuse a job in the second of its end, and do not say so",
}
# Layers take the time from Limits::now(), which a test can set.
LAYERS = {
    "src/model/limits.h": "the clock",
    "src/api/run.h": "the public API: its users' seconds",
    "src/api/solve.cpp": "the public API: its users' seconds",
    "src/batch/batch_clock.cpp": "the clock that batches are given",
    "src/io/atomic_file.cpp": "names that come but once; the age of files",
    "src/io/file_lock.cpp": "tells since when a folder is locked",
}

READS_CPP = re.compile(r"[cC]lock::now\s*\(|\bstd::clock\s*\(|\bclock_gettime\s*\(\s*CLOCK_(?:REALTIME|MONOTONIC)|\bgettimeofday\b"
                       r"|\btime\s*\(\s*(?:nullptr|NULL|0)\s*\)")
SLEEPS_CPP = re.compile(r"\bsleep_(?:for|until)\b|\bwait_(?:for|until)\s*\(\s*\w+,|(?<!\w)u?sleep\s*\(|\bnanosleep\b")
PYTHON = re.compile(r"\btime\.(?:sleep|time|monotonic|perf_counter|process_time)(?:_ns)?\(|\bthreading\.Timer\("
                    r"|\bfrom time import|\bdatetime\.now\(")
SCRIPT = re.compile(r"\b(?:performance|Date)\.now\(|\bsetTimeout\(")
SHELL = re.compile(r"\bsleep (?:\d?\.\d+|[1-9]\d?)(?![\d.])")  # those that end by themselves, not those that "hang"


def looks_at_time(name, text):
    """Whether a test does."""
    if name.endswith((".cpp", ".h")):
        code = without_comments_and_strings(text)
        return bool(READS_CPP.search(code) or SLEEPS_CPP.search(code) or SHELL.search(text))
    if name.endswith(".ts"):
        return bool(SCRIPT.search(text))
    return bool(PYTHON.search(text) or SHELL.search(text))


class Clocks(unittest.TestCase):
    def test_tests_have_no_clock(self):
        found = {str(path.relative_to(ROOT / "tests")) for path in (ROOT / "tests").rglob("*")
                 if path.suffix in {".cpp", ".h", ".py", ".ts"} and path != Path(__file__).resolve()
                 and looks_at_time(path.name, path.read_text(encoding="utf-8"))}
        self.assertEqual(sorted(found - set(TESTS)), [], "wait for an event, and take the time from tests/support/clocks.h")
        self.assertEqual(sorted(set(TESTS) - found), [], "no exception is needed any more")

    def test_layers_take_the_time_from_limits(self):
        found = {str(path.relative_to(ROOT)) for folder in ("include", "src", "mpi") for path in (ROOT / folder).rglob("*")
                 if path.suffix in {".cpp", ".h", ".hpp"}
                 and READS_CPP.search(without_comments_and_strings(path.read_text(encoding="utf-8")))}
        self.assertEqual(sorted(found - set(LAYERS)), [], "take the time from Limits::now()")
        self.assertEqual(sorted(set(LAYERS) - found), [], "no exception is needed any more")

    def test_what_is_found(self):
        for name, text in (("a.cpp", "auto t = Limits::Clock::now();"), ("a.cpp", "x = steady_clock::now ();"),
                           ("a.h", "std::this_thread::sleep_for(1ms);"), ("a.cpp", "std::clock() < 3"),
                           ("a.cpp", 'run("sleep 0.2");'), ("a.cpp", "usleep(3);"), ("a.cpp", "time(nullptr)"),
                           ("a.py", "    time.sleep(1)"), ("a.py", "time.monotonic() - t"), ("a.py", "from time import sleep"),
                           ("a.py", "'sleep 2; exit'"), ("a.ts", "performance.now()")):
            self.assertTrue(looks_at_time(name, text), text)
        for name, text in (("a.cpp", "// Clock::now()"), ("a.cpp", 'run("exec sleep 600");'), ("a.cpp", "limits.now()"),
                           ("a.py", "await asyncio.sleep(2)"), ("a.py", '"sleep 1000"'), ("a.cpp", "wait_until(x)"),
                           ("a.ts", "player.time")):
            self.assertFalse(looks_at_time(name, text), text)


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
