#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Mutation testing: which bugs of the search do certificates reveal to a user who does not know the optimum?

    mutants.py FOLDER [--count N] [--only K,K] [--jobs J]

Copies the sources to FOLDER, inserts the bugs of mutants.txt, and builds once. The environment variable GROVE_MUTANT
selects the bug of a process. For each bug, and each part of the search that the bug is tried on, grove-fuzz-certificates
solves N tiny instances and checks their certificates with grove-verify. Prints one table for each kind of result. A row
counts for one bug the claims that were false (the oracle knows the optimum), the certificates that were refused or proved
less than was claimed, and the false claims that were verified. Exit code 1: a false claim was verified.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIST = Path(__file__).with_suffix(".txt")
HELPER = """#pragma once
#include <cstdlib>
// Returns whether this process has the bug of this number.
inline bool grove_mutant(int number) {
  static const char* const chosen = std::getenv("GROVE_MUTANT");
  static const int mutant = chosen ? std::atoi(chosen) : -1;
  return mutant == number;
}
"""


def read_list():
    """Returns the entries of mutants.txt as [(number, file, before, old, new, parts)]."""
    mutants, file, parts = [], None, ()
    for line in LIST.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        if " => " not in line:
            file, parts = line.split(": ")
            parts = parts.split()
            continue
        place, new = line.rsplit(" => ", 1)
        before, old = place.split("@", 1)
        mutants.append((len(mutants) + 1, file, before, old, new, parts))
    return mutants


def pattern(text):
    """Returns a regular expression that matches `text` with any white space between its tokens."""
    return r"\s*".join(re.escape(word) for word in re.findall(r"\w+|[^\w\s]", text))


def mutate(text, number, before, old, new):
    found = list(re.finditer(f"({pattern(before)}\\s*)({pattern(old)})", text))
    if len(found) != 1:
        sys.exit(f"mutants.py: error: mutant {number}: found {len(found)} times, expected once: {before}@{old}")
    match = found[0]
    is_statement = old.endswith(";")
    there = match.group(2)
    mutated = (f"if (!grove_mutant({number})) {there}" if is_statement
               else f"(grove_mutant({number}) ? ({new}) : ({there}))")
    return text[:match.start(2)] + mutated + text[match.end(2):]


def write_if_new(file, text):
    """Writes a file unless it already has this content, so that unchanged files are not rebuilt."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


def copy_sources(folder, mutants):
    texts = {}
    for number, file, before, old, new, _ in mutants:
        text = texts.get(file) or (ROOT / file).read_text(encoding="utf-8")
        texts[file] = mutate(text, number, before, old, new)
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout.decode()
    for name in set(filter(None, names.split("\0"))) - set(texts):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)
    write_if_new(folder / "include/grove_mutant.h", HELPER)
    for file, text in texts.items():
        include = '#include "grove_mutant.h"\n'
        # In a header the include must follow #pragma once.
        write_if_new(folder / file, text.replace("#pragma once\n", "#pragma once\n" + include, 1)
                     if file.endswith(".h") else include + text)


def build(folder):
    options = ["-D", "GROVE_BUILD_TESTS=ON", "-D", "GROVE_WITH_MPI=OFF"]
    subprocess.run(["cmake", "--preset", "release", *options], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "release", "--target", "grove-fuzz-certificates", "grove-verify"],
                   cwd=folder, check=True)


def trial(folder, number, parts, count, seconds):
    place = folder / f"run-{number}"
    place.mkdir(exist_ok=True)
    try:
        return {part: trial_of_part(folder, place, number, part, count, seconds) for part in parts}
    finally:
        shutil.rmtree(place, ignore_errors=True)


def summed(of_parts, usual):
    """Sums the counts of all parts, minus the refusals and errors that also occur without a bug."""
    sums = collections.Counter()
    for part, counts in of_parts.items():
        sums.update(counts)
        for key in ("refused", "threw", "died"):
            sums[key] -= min(counts.get(key, 0), usual.get(part, {}).get(key, 0))
    return sums


def trial_of_part(folder, place, number, part, count, seconds):
    bin_folder = folder / "build/release/bin"
    program = next(path for path in (folder / "build/release").rglob("grove-fuzz-certificates") if path.is_file())
    command = [program, "--verify", bin_folder / "grove-verify", "--folder", place, "--count", str(count),
               "--part", part, "--json"]
    try:
        result = subprocess.run(command, env=os.environ | {"GROVE_MUTANT": str(number)}, capture_output=True,
                                text=True, timeout=seconds)
        lines = [line for line in result.stdout.splitlines() if line.startswith("{")]
        return json.loads(lines[-1]) if lines else {"died": 1}
    except subprocess.TimeoutExpired:
        return {"died": 1}


FALSE_CLAIM_VERIFIED = "A FALSE CLAIM WAS VERIFIED"
GROUPS = (FALSE_CLAIM_VERIFIED, "Detected with a false claim", "Detected without a false claim",
          "Detected by the search: it ends with an error, or not at all",
          "Not detected: no false claim, no refusal")


def group_of(counts):
    if counts["believed"] or counts["false"] > counts["refused_false"]:
        return FALSE_CLAIM_VERIFIED
    if counts["false"]:
        return GROUPS[1]
    if counts["refused"]:
        return GROUPS[2]
    return GROUPS[3] if counts["threw"] or counts["died"] else GROUPS[4]


def row(mutant, counts):
    number, file, _, old, new, parts = mutant
    what = f"`{old.strip()}` -> `{new.strip()}`".replace("|", "\\|") if number else "none"
    numbers = " | ".join(str(counts[key]) for key in ("cases", "false", "refused", "believed"))
    return f"| {number} | {file} | {what} | {' '.join(parts)} | {numbers} |"


HEAD = ("| | where | bug | tried on | claims | false | refused or short | false and verified |\n"
        "|---|---|---|---|---|---|---|---|")


def show(mutants, counts):
    """Prints one table for each group."""
    for group in GROUPS:
        rows = [row(m, c) for m, c in zip(mutants, counts) if group_of(c) == group]
        if rows:
            bugs = sum(m[0] > 0 and group_of(c) == group for m, c in zip(mutants, counts))
            print(f"\n## {group}: {bugs}\n\n{HEAD}", *rows, sep="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=100, help="instances for each part")
    parser.add_argument("--seconds", type=float, default=900, help="for each part and bug")
    parser.add_argument("--only", type=lambda text: {int(k) for k in text.split(",")})
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    mutants = read_list()
    folder = arguments.folder.resolve()
    copy_sources(folder, mutants)
    build(folder)
    chosen = [m for m in mutants if not arguments.only or m[0] in arguments.only]
    chosen.insert(0, (0, "", "", "", "", sorted({part for m in chosen for part in m[5]})))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = [pool.submit(trial, folder, m[0], m[5], arguments.count, arguments.seconds) for m in chosen]
        usual = runs[0].result()
        counts = [summed(usual, {})]
        for mutant, run in zip(chosen[1:], runs[1:]):
            counts.append(summed(run.result(), usual))
            print(row(mutant, counts[-1]), group_of(counts[-1]), file=sys.stderr, flush=True)
    show(chosen, counts)
    failed = any(group_of(c) == FALSE_CLAIM_VERIFIED for c in counts)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
