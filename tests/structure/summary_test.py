#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the output of tests/summary.py for given CTest results.   summary_test.py SOURCES"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SUMMARY = Path(sys.argv.pop(1)) / "tests/summary.py"


def case(name, status, output, skipped=""):
    message = f'<skipped message="{skipped}"/>' if skipped else ""
    return f'<testcase name="{name}" status="{status}">{message}<system-out>{output}</system-out></testcase>'


def summarise(*cases):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "junit.xml"
        file.write_text(f"<testsuite>{''.join(cases)}</testsuite>", encoding="utf-8")
        return subprocess.run([sys.executable, SUMMARY, f"release={file}"], capture_output=True, text=True)


GTEST = """Running main() from gtest_main.cc
[==========] Running 5 tests from 1 test suite.
[----------] 5 tests from Maps
[ RUN      ] Maps.Reads
[       OK ] Maps.Reads (0 ms)
[ RUN      ] Maps.Writes
a_test.cpp:3: Failure
Expected: 1
[  FAILED  ] Maps.Writes, where GetParam() = 1 (2 ms)
[ RUN      ] Kinds/Maps.Real/0
a_test.cpp:9: Skipped
no maps

[  SKIPPED ] Kinds/Maps.Real/0 (0 ms)
[ RUN      ] Kinds/Maps.Real/1
[       OK ] Kinds/Maps.Real/1 (0 ms)
[==========] 4 tests from 1 test suite ran. (0 ms total)
[  PASSED  ] 2 tests.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Kinds/Maps.Real/0
[  FAILED  ] 1 test, listed below:
[  FAILED  ] Maps.Writes, where GetParam() = 1
"""
PASSED = case("io.reads", "run", "fine")


class Summary(unittest.TestCase):
    def test_exit_code_is_0_if_no_test_failed(self):
        run = summarise(PASSED, PASSED)
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (0, "2 passed, 0 failed, 0 skipped"))

    def test_last_lines_of_a_failed_test_are_shown(self):
        lines = "\n".join(f"line {number}" for number in range(100))
        run = summarise(PASSED, case("io.writes", "fail", lines))
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("FAILED release: io.writes", run.stdout)
        self.assertIn("line 99\n", run.stdout)
        self.assertNotIn("line 9\n", run.stdout)

    def test_reasons_of_skipped_tests_are_shown(self):
        run = summarise(PASSED, case("view.types", "notrun", "no tsc", "SKIP_RETURN_CODE=77"),
                        case("io.maps", "notrun", "[ RUN ] x\na_test.cpp:3: Skipped\nno maps\n\n[  SKIPPED ] x",
                             "SKIP_REGULAR_EXPRESSION_MATCHED"))
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (0, "1 passed, 0 failed, 2 skipped"))
        self.assertIn("view.types: no tsc\n", run.stdout)
        self.assertIn("io.maps: no maps\n", run.stdout)

    def test_cases_of_a_googletest_program_are_counted(self):
        run = summarise(PASSED, case("io_test", "fail", GTEST))
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (1, "3 passed, 1 failed, 1 skipped"))
        self.assertIn("FAILED release: io_test.Maps.Writes\n    a_test.cpp:3: Failure\n    Expected: 1\n", run.stdout)
        self.assertIn("skipped release: io_test.Kinds/Maps.Real/0: no maps\n", run.stdout)

    def test_googletest_program_that_ends_early_has_failed(self):
        for kept, passed, name in (("[ RUN      ] Maps.Writes\n", 1, "io_test.Maps.Writes"),
                                   ("[----------] 5 tests from Maps\n", 0, "io_test")):
            run = summarise(case("io_test", "fail", GTEST[:GTEST.index(kept) + len(kept)] + "Segmentation fault"))
            self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (1, f"{passed} passed, 1 failed, 0 skipped"))
            self.assertIn(f"FAILED release: {name}\n", run.stdout)
            self.assertIn("    Segmentation fault\n", run.stdout)

    def test_googletest_program_that_fails_after_its_cases_has_failed(self):
        run = summarise(case("io_test", "fail",
                             GTEST[:GTEST.index("[ RUN      ] Maps.Writes")] + "ERROR: LeakSanitizer"))
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("FAILED release: io_test\n", run.stdout)

    def test_program_that_could_not_be_started_has_failed(self):
        run = summarise(PASSED, case("io.gone", "notrun", "", "Unable to find executable"))
        self.assertEqual((run.returncode, run.stdout.split("\n")[-2]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_run_without_tests_is_a_failure(self):
        self.assertEqual(summarise().returncode, 1)


if __name__ == "__main__":
    unittest.main()
