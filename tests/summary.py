#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Summarises test runs of CTest for tools/test. The cases of a GoogleTest program count as tests.

    summary.py PART=JUNIT.xml...   prints what failed, with its last lines, what was skipped and why, and
                                   "N passed, N failed, N skipped"; exit code 1 if a test failed or none ran
    summary.py --names             reads `ctest --show-only=json-v1` and prints the tests' names in groups
"""
import json
import re
import sys
import xml.etree.ElementTree
from collections import Counter
from dataclasses import dataclass

LINES_SHOWN = 25
NAMES_SHOWN = 12
IS_GTEST = re.compile(r"^\[==========\] Running ", re.MULTILINE)
OUTCOMES = {"OK": "passed", "FAILED": "failed", "SKIPPED": "skipped"}


@dataclass
class Result:
    name: str
    outcome: str  # "passed", "failed", "skipped"
    output: str


def outcome_of(case):
    if case.find("skipped") is not None and "SKIP_" in case.find("skipped").get("message", ""):
        return "skipped"
    return "passed" if case.get("status") == "run" else "failed"


def cases_of(program):
    """Returns the results of the test cases in the output of a GoogleTest program."""
    cases = []
    name, lines = None, []
    for line in program.output.splitlines():
        mark = re.match(r"\[ *(RUN|OK|FAILED|SKIPPED) *\] ([^\s,(]+)", line)
        if mark and mark[1] == "RUN":
            name, lines = f"{program.name}.{mark[2]}", []
        elif mark and name:
            cases.append(Result(name, OUTCOMES[mark[1]], "\n".join(lines)))
            name = None
        elif name:
            lines.append(line)
    if name:
        cases.append(Result(name, "failed",
                            "\n".join([*lines, f"{program.name} ended here; its other cases did not run"])))
    elif program.outcome == "failed" and all(case.outcome != "failed" for case in cases):
        cases.append(program)
    return cases


def read_results(file):
    """Returns the results in one JUnit file of CTest."""
    try:
        cases = xml.etree.ElementTree.parse(file).getroot().iter("testcase")
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        sys.exit(f"summary.py: {file}: {error}")
    results = [Result(case.get("name"), outcome_of(case), case.findtext("system-out") or "") for case in cases]
    return [case for result in results for case in (cases_of(result) if IS_GTEST.search(result.output) else [result])]


def last_lines(output):
    lines = [line for line in output.splitlines() if line.strip()]
    return lines[-LINES_SHOWN:] or ["(no output)"]


def reason_to_skip(output):
    """Returns the text that GTEST_SKIP() printed, or the last line of a script that exited with code 77."""
    by_gtest = re.search(r": Skipped\n(.+)", output)
    return (by_gtest.group(1) if by_gtest else last_lines(output)[-1]).strip()


def print_failed(part, results):
    for result in results:
        print(f"\nFAILED {part}: {result.name}")
        for line in last_lines(result.output):
            print(f"    {line}")


def print_skipped(part, results):
    """Prints one line for each reason for which tests were skipped."""
    names = {}
    for result in results:
        names.setdefault(reason_to_skip(result.output), []).append(result.name)
    for reason, skipped in names.items():
        print(f"skipped {part}: {', '.join(skipped)}: {reason}")


def summarise(parts):
    counts = Counter()
    ran = {part: read_results(file) for part, file in parts}
    for part, results in ran.items():
        print_skipped(part, [result for result in results if result.outcome == "skipped"])
    for part, results in ran.items():
        print_failed(part, [result for result in results if result.outcome == "failed"])
        counts.update(result.outcome for result in results)
        if not results:
            print(f"\nFAILED {part}: no test was run")
            counts["failed"] += 1
    print(f"\n{counts['passed']} passed, {counts['failed']} failed, {counts['skipped']} skipped")
    return counts["failed"] == 0


def print_names(tests):
    """Prints the test names in groups. Names in one group have the same text before the first dot."""
    groups = {}
    for test in tests:
        group, _, name = test["name"].partition(".")
        groups.setdefault(group, []).append(name)
    for group, names in sorted(groups.items()):
        named = [name for name in names if name]
        text = ", ".join(named) if len(named) <= NAMES_SHOWN else f"{len(named)} tests"
        print(f"  {group}" + (f": {text}" if named else ""))


if __name__ == "__main__":
    if sys.argv[1:] == ["--names"]:
        print_names(json.load(sys.stdin)["tests"])
    elif len(sys.argv) > 1 and all("=" in part for part in sys.argv[1:]):
        sys.exit(0 if summarise([part.split("=", 1) for part in sys.argv[1:]]) else 1)
    else:
        sys.exit(__doc__)
