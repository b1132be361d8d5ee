#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the option table of docs/command-line.md agrees with the program.

    options_test.py PAGE GROVE

Every option in `grove solve --help` must be in the table under "## Options of grove solve" and vice versa. The same
holds for the techniques of `--without`. Exit codes: 0 agreement, 1 disagreement, 77 the program is not built.
"""
import re
import subprocess
import sys
from pathlib import Path

OPTION = re.compile(r"--[a-z][a-z-]*")


def documented(page):
    section = page.split("## Options of grove solve", 1)[1].split("\n## ", 1)[0]
    first_columns = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return {option for column in first_columns for option in OPTION.findall(column)}


def offered(help_text):
    names = [line.split("  ")[1] for line in help_text.splitlines()
             if re.match(r"  (-\w,)?--", line)]
    return {option for name in names for option in OPTION.findall(name)} - {"--help"}


def documented_techniques(page):
    section = page.split("The techniques that `--without` knows", 1)[1].split("\n## ", 1)[0]
    return set(re.findall(r"^\| `([a-z-]+)` \|", section, re.M))


def offered_techniques(program):
    refusal = subprocess.run([program, "solve", "--without", "?", "-"], capture_output=True, text=True,
                             check=False).stderr
    return set(refusal.split("expected one of ", 1)[1].split(" (", 1)[0].split(", "))


def main():
    page, program = (Path(argument) for argument in sys.argv[1:])
    if not program.exists():
        print(f"skipped: {program} is not built")
        return 77
    help_text = subprocess.run([program, "solve", "--help"], capture_output=True, text=True,
                               check=True).stdout
    in_page, in_help = documented(page.read_text(encoding="utf-8")), offered(help_text)
    assert in_help, "no option found in the help"
    for option in sorted(in_help - in_page):
        print(f"FAILED: {option} is not in the page's table")
    for option in sorted(in_page - in_help):
        print(f"FAILED: {option} of the page's table is no option of grove solve")
    techniques = documented_techniques(page.read_text(encoding="utf-8"))
    for name in sorted(techniques ^ offered_techniques(program)):
        print(f"FAILED: technique {name} is not in both the page and the program")
    return 0 if in_help == in_page and techniques == offered_techniques(program) else 1


if __name__ == "__main__":
    sys.exit(main())
