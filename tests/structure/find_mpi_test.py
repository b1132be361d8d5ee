#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that a failed search for MPI reports the cause and does not make the next search fail.

    find_mpi_test.py SOURCES COMPILER MPICXX      MPICXX: the compiler wrapper of an MPI installation
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCES, COMPILER, MPICXX = sys.argv[1:]
PROJECT = """cmake_minimum_required(VERSION 3.22)
project(finds_mpi LANGUAGES CXX)
list(APPEND CMAKE_MODULE_PATH {sources}/cmake)
include(GroveFindMpi)
grove_find_mpi()
"""
# Error of Open MPI on a machine without an active network interface.
COMPLAINT = "opal_ifinit: unable to find network interfaces."


class FindMpi(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "CMakeLists.txt").write_text(PROJECT.format(sources=SOURCES))

    def wrapper(self, first):
        path = self.folder / "mpicxx"
        path.write_text(f'#!/bin/sh\n{first}\nexec "{MPICXX}" "$@"\n')
        path.chmod(0o755)
        return path

    def configure(self, *options):
        """Runs CMake and returns the exit code and the error output as one line (CMake wraps messages)."""
        done = subprocess.run(["cmake", "-S", self.folder, "-B", self.folder / "build", *options],
                              capture_output=True, text=True)
        return done.returncode, " ".join(done.stderr.split())

    def test_error_of_mpi_is_quoted_and_the_next_search_succeeds(self):
        wrapper = self.wrapper(f"echo '{COMPLAINT}' >&2")
        code, errors = self.configure("-D", f"CMAKE_CXX_COMPILER={COMPILER}", "-D", f"MPI_CXX_COMPILER={wrapper}")
        self.assertNotEqual(code, 0)
        for words in (COMPLAINT, "ip link set lo up", "GROVE_WITH_MPI=OFF"):
            self.assertIn(words, errors)
        self.wrapper("")
        code, errors = self.configure()
        self.assertEqual(code, 0, errors)
        used = (self.folder / "build/CMakeCache.txt").read_text()
        self.assertIn(f"={wrapper}\n", used, "the value of the user is kept")

    def test_error_of_the_wrapper_is_quoted(self):
        wrapper = self.wrapper("echo 'no such thing' >&2; exit 1")
        code, errors = self.configure("-D", f"CMAKE_CXX_COMPILER={COMPILER}", "-D", f"MPI_CXX_COMPILER={wrapper}",
                                    "-D", "MPI_ASSUME_NO_BUILTIN_MPI=ON", "-D", "MPI_SKIP_GUESSING=ON")
        self.assertNotEqual(code, 0)
        self.assertIn(f"{wrapper} complains: no such thing", errors)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
