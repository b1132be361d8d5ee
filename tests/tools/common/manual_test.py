#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the manual pages and the shell completions.

    manual_test.py GROVE

Tests bash always, and fish and zsh if they are installed.
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

GROVE = sys.argv[1]
CASES = [
    (["grove", "s"], {"solve"}),
    (["grove", "solve", "--om"], {"--omega"}),
    (["grove", "solve", "--policy", "f"], {"fixed", "free"}),
    (["grove", "generate", "map", "rooms", "--wi"], {"--width"}),
    (["grove", "view", "-"], {"--svg", "--drive", "-o"}),
]


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **options)


def script(shell):
    return run(GROVE, "help", "--completion", shell, check=True).stdout


class Completions(unittest.TestCase):
    def test_bash_completes_commands_and_options(self):
        for words, expected in CASES:
            comp_words = " ".join(f"'{word}'" for word in words)
            done = run("bash", "-c", script("bash") + f"\nCOMP_WORDS=({comp_words}); COMP_CWORD={len(words) - 1}\n"
                       '_grove; printf "%s\\n" "${COMPREPLY[@]}"')
            self.assertEqual(done.stderr, "")
            self.assertLessEqual(expected, set(done.stdout.split()))
        # After an option that takes a file, bash itself completes file names.
        done = run("bash", "-c", script("bash") + "\nCOMP_WORDS=(grove solve --output ''); COMP_CWORD=3\n"
                   '_grove; echo "${#COMPREPLY[@]}"')
        self.assertEqual(done.stdout, "0\n")

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish_completes_commands_and_options(self):
        for words, expected in CASES:
            done = run("fish", "--no-config", "-c", script("fish") + f"\ncomplete -C '{' '.join(words)}'")
            offered = {line.split("\t")[0] for line in done.stdout.splitlines()}
            self.assertLessEqual(expected - {"-o"}, offered, done.stderr)

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_script_is_valid(self):
        done = run("zsh", "-n", "/dev/stdin", input=script("zsh"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_unknown_help_topics_are_refused(self):
        for words in (["--completion", "csh"], ["--completion"], ["--manual"], ["--nonsense"]):
            done = run(GROVE, "help", *words)
            self.assertEqual(done.returncode, 2)
            self.assertIn("expected a command", done.stderr)


class Manual(unittest.TestCase):
    def test_every_command_has_a_manual_page(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run(GROVE, "help", "--manual", folder).returncode, 0)
            pages = {path.name: path.read_text() for path in Path(folder).iterdir()}
            self.assertLessEqual({"grove.1", "grove-solve.1", "grove-report.1"}, set(pages))
            self.assertIn("\\fB\\-\\-omega\\fR \\fIW|inf\\fR", pages["grove-solve.1"])
            self.assertIn(".SH grove generate map rooms", pages["grove-generate.1"])
            for name, text in pages.items():
                self.assertTrue(text.startswith(".TH "), name)
            if not shutil.which("groff"):
                return
            for name in pages:
                done = run("groff", "-man", "-Tutf8", "-ww", str(Path(folder) / name))
                self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
