#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that each package that CMake searches for belongs to a Debian package in the right list.

    packages_test.py [ROOT]   checks the tree at ROOT, by default this one

The build searches only for packages in tools/packages, required or not, because otherwise a package that happens to
be installed would change what is built. Tests and benchmarks can also use packages in tools/packages.test, with
which `tools/test` runs, and in tools/packages.test-all.
"""
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Debian packages by the name for which CMake searches.
PACKAGES = {
    "fmt": ["libfmt-dev"],
    "nlohmann_json": ["nlohmann-json3-dev"],
    "yaml-cpp": ["libyaml-cpp-dev"],
    "pugixml": ["libpugixml-dev"],
    "CLI11": ["libcli11-dev"],
    "Threads": ["build-essential"],
    "MPI": ["libopenmpi-dev"],
    "cereal": ["libcereal-dev"],
    "ZLIB": ["zlib1g-dev"],
    "PkgConfig": ["pkg-config"],
    "libzstd": ["libzstd-dev"],
    "zstd": ["libzstd-dev"],
    "cpp-httplib": ["libcpp-httplib-dev"],
    "cadical.hpp": ["libcadical-dev"],
    "cadical": ["libcadical-dev"],
    "cbc": ["coinor-libcbc-dev"],
    "cairo": ["libcairo2-dev"],
    "GIF": ["libgif-dev"],
    "PNG": ["libpng-dev"],
    "esbuild": ["esbuild"],
    "rustc": ["rustc"],
    "Python": ["python3", "python3-dev"],
    "Python3": ["python3"],
    "pybind11": ["pybind11-dev"],
    "GTest": ["libgtest-dev", "libgmock-dev"],
    "benchmark": ["libbenchmark-dev"],
    "node": ["nodejs"],
    "tsc": ["node-typescript"],
    "ccache": ["ccache"],
    "Doxygen": ["doxygen"],
}
# Packages that speed up the build or add a separate target, without an effect on the default build.
HARMLESS = {"ccache", "Doxygen"}
FOR_TESTS = ("tests", "benchmarks")


def searched_names(cmake):
    """Returns [(name, required)] of the calls in a CMake text that search for a package or program."""
    code = re.sub(r"#[^\n]*", "", cmake)
    found = []
    for call, text in re.findall(r"\b(find_package|pkg_check_modules|pkg_search_module|find_program|find_library"
                                 r"|find_path|find_file)\s*\(([^)]*)\)", code):
        words = text.split()
        required = "REQUIRED" in words
        if call == "find_package":
            found.append((words[0], required))
        elif call.startswith("pkg_"):
            names = [word for word in words[1:] if not word.isupper()]
            found += [(re.split(r"[<>=]", name)[0], required) for name in names]
        else:
            found.append((words[2] if words[1] == "NAMES" else words[1], required))
    return found


def packages_of(text):
    """Returns the packages in a list, read in the same way as by tools/setup.sh."""
    return {line.split()[0] for line in text.splitlines() if line.strip() and not line.startswith("#")}


def default_of(cmake, option):
    found = re.search(rf'option\(\s*{option}\s+"[^"]*"\s*([^)\s]*)\s*\)|set\({option} (\S+) CACHE ', cmake)
    return found and (found.group(1) or found.group(2))


class ThePackages(unittest.TestCase):
    def searches(self):
        """Yields (file, name, required) for all searches of the build, except in examples/ros2, a separate project."""
        files = [path for path in [*ROOT.rglob("CMakeLists.txt"), *ROOT.rglob("*.cmake")]
                 if not {"build", "ros2"} & set(path.relative_to(ROOT).parts)]
        for path in sorted(files):
            for name, required in searched_names(path.read_text(encoding="utf-8")):
                yield path.relative_to(ROOT), name, required

    def listed(self, name):
        return packages_of((ROOT / "tools" / name).read_text(encoding="utf-8"))

    def test_every_search_is_in_the_table(self):
        names = {name for _, name, _ in self.searches()}
        self.assertGreater(len(names), 20)
        self.assertEqual(names ^ PACKAGES.keys(), set())

    def test_build_searches_only_for_packages_of_its_list(self):
        build = self.listed("packages")
        for path, name, required in self.searches():
            if path.parts[0] not in FOR_TESTS and (required or name not in HARMLESS):
                self.assertLessEqual(set(PACKAGES[name]), build, f"{path}: {name}")

    def test_tests_search_only_for_packages_of_the_lists(self):
        base = self.listed("packages") | self.listed("packages.test")
        for path, name, required in self.searches():
            needed = required and path.parts[0] == "tests"
            allowed = base if needed else base | self.listed("packages.test-all")
            self.assertLessEqual(set(PACKAGES[name]), allowed, f"{path}: {name}")

    def test_tests_and_benchmarks_are_not_built_by_default(self):
        top = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        self.assertEqual(default_of(top, "GROVE_BUILD_TESTS"), "OFF")
        self.assertEqual(default_of(top, "GROVE_BUILD_BENCHMARKS"), "OFF")

    def test_no_package_is_in_two_lists(self):
        lists = [self.listed(name) for name in ("packages", "packages.test", "packages.test-all")]
        self.assertEqual(sum(map(len, lists)), len(set.union(*lists)))


class TheChecks(unittest.TestCase):
    """Tests the checks themselves."""

    def test_searches_are_found(self):
        text = """find_package(A 3.1 REQUIRED COMPONENTS X)  # find_package(No)
            pkg_check_modules(B REQUIRED IMPORTED_TARGET GLOBAL b-lib>=2 c)
            find_program(D_PROGRAM d HINTS /usr/bin)\nfind_library(E NAMES e REQUIRED)"""
        self.assertEqual(searched_names(text), [("A", True), ("b-lib", True), ("c", True), ("d", False), ("e", True)])

    def test_lists_are_read(self):
        self.assertEqual(packages_of("# a list\ng++   # a compiler\n\ncmake\n"), {"g++", "cmake"})

    def test_defaults_are_found(self):
        self.assertEqual(default_of('option(X "tests (all)" ${GTest_FOUND})', "X"), "${GTest_FOUND}")
        self.assertIsNone(default_of('option(XY "tests" OFF)', "X"))


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
