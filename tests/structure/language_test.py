#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the wording of code, documents and messages, and the layout of documents.

    language_test.py [ROOT]   checks the tree at ROOT, by default this one

CONTRIBUTING.md states the rules; language_allowed.txt lists the uses that are justified.
"""
import fnmatch
import functools
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Words that readers misunderstand or that name no actor, each with the words to use instead.
WORDS = {
    r"whoever|nobody|somebody|everybody|anybody": "the caller, no thread, another rank, all agents",
    r"(?:go|goes|going|gone|went) on": "continue, resume",
    r"settle[sd]?|settling": "complete, prove, solve",
    r"limits? (?:strikes?|struck)|struck|strikes?": "is reached",
    r"dear(?:er|est)?": "expensive, of high cost",
    r"anew": "again, re-plan",
    r"(?:give|gives|giving|gave|given) up": "evict, abort, stop",
    r"but for": "except",
    r"meanwhile": "in the meantime, concurrently",
    r"for want of": "because there is no",
    r"in hand": "in progress",
    r"at one go": "per call",
    r"of late": "recently",
    r"in vain": "without success",
    r"(?:is|are|was|were) told": "receives, is called with",
    r"so (?:many|much)": "the name of the parameter or number",
    r"(?:stand|stands|standing|stood) still": "is unresponsive, rests, does not change",
    r"beside the tree": "outside the tree search",
    r"(?:find|finds|finding|found) out": "compute, cached",
    r"as a rule": "usually",
    r"likewise|and the like|by the same token": "also",
    r"essays?": "proof",
    r"(?<!on )demands?": "constraint",
    r"obeys?|obeyed": "satisfies",
    r"crowd(?:s|ed|ing)?": "dense instance, congested",
}
WORD = re.compile("|".join(rf"(?<![A-Za-z])(?:{words})(?![A-Za-z])" for words in WORDS), re.I)
# Data, generated files and third-party texts.
EXCLUDED = ["*.csv", "*.html", "*.png", "*.svg", "*.gif", "*.xml", "*.scen", "*.map", "*.graphml", "*.pdf", "*.zst",
            "LICENSE*", "*/fonts/*", "tools/vda5050/grove_vda5050/schemas/*", "tests/fuzz/cases/*",
            "tests/structure/language_*"]
MAX_LINE_LENGTH = 140  # limit for prose in documents


@functools.cache
def texts():
    """Returns (name, text) of each file to check."""
    if not (ROOT / ".git").exists():
        raise unittest.SkipTest("not a clone: which files belong to Grove is unknown")
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    found = []
    for name in filter(None, names.split("\0")):
        if any(fnmatch.fnmatch(name, pattern) for pattern in EXCLUDED):
            continue
        try:
            found.append((name, (ROOT / name).read_text(encoding="utf-8")))
        except (UnicodeDecodeError, IsADirectoryError, FileNotFoundError):
            continue
    return found


@functools.cache
def uses():
    """Returns (file name, line number, word) of each use of a listed word."""
    return [(name, number, word) for name, text in texts() for number, word in words_in(text)]


def words_in(text):
    """Yields (line number, word) of each listed word in a text, including identifiers."""
    for number, line in enumerate(text.splitlines(), 1):
        for found in WORD.finditer(re.sub(r"(?<=[a-z])(?=[A-Z])", " ", line.replace("_", " "))):
            yield number, found.group().lower()


def allowed():
    """Returns the entries (file pattern, word) of language_allowed.txt."""
    lines = (ROOT / "tests/structure/language_allowed.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split("|") for line in lines if line and not line.startswith("#")]
    return [(pattern.strip(), word.strip()) for pattern, word, _ in rows]


def prose(text):
    """Yields (line number, line) of a Markdown text, skipping code blocks."""
    is_code = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            is_code = not is_code
        elif not is_code:
            yield number, line


class Words(unittest.TestCase):
    def test_words_of_the_list_are_not_used(self):
        permitted = allowed()
        found = [f"{name}:{number}: '{word}'" for name, number, word in uses()
                 if not any(word == allowed_word and fnmatch.fnmatch(name, pattern)
                            for pattern, allowed_word in permitted)]
        self.assertEqual(found, [], "see WORDS in this file for what to write instead")

    def test_every_permission_is_needed(self):
        idle = [(pattern, word) for pattern, word in allowed()
                if not any(word == found and fnmatch.fnmatch(name, pattern) for name, _, found in uses())]
        self.assertEqual(idle, [])

    def test_words_are_found(self):
        text = "The thread goes on.\nint in_vain_ = 0;  // nobody\nclass TestsThatSettleThis;\ncandies, endearing"
        self.assertEqual(list(words_in(text)),
                         [(1, "goes on"), (2, "in vain"), (2, "nobody"), (3, "settle")])


class Documents(unittest.TestCase):
    def documents(self):
        return [(name, text) for name, text in texts() if name.endswith(".md") and name != "docs/python-api.md"]

    def test_prose_has_short_lines(self):
        long = [f"{name}:{number}: {len(line)} columns" for name, text in self.documents()
                for number, line in prose(text) if len(line) > MAX_LINE_LENGTH and not line.startswith("|")
                and " " in line.strip()]
        self.assertEqual(long, [])

    def test_headings_are_in_sentence_case_without_a_full_stop(self):
        wrong = []
        for name, text in self.documents():
            for number, line in prose(text):
                heading = re.fullmatch(r"#+ (.*)", line)
                if heading and not re.fullmatch(r"(?:\d+(?:\.\d+)*\.? )?[A-Z`a-z0-9-].*[^.:;,?! ]", heading[1]):
                    wrong.append(f"{name}:{number}: {line}")
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    if len(sys.argv) > 1:
        ROOT = Path(sys.argv.pop()).resolve()
    unittest.main()
