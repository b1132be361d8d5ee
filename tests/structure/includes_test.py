#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that every C++ file includes, directly or through headers of Grove, the headers of the Grove types and of the
standard names (STANDARD) that it uses.

The compiler does not detect a missing include, because it compiles several sources as one and uses precompiled
headers.

    includes_test.py [ROOT]   checks the tree at ROOT, by default this one
"""
import re
import sys
import unittest
from pathlib import Path

from structure_test import CPP, ROOT, named_types, without_comments_and_strings

FOLDERS = ["include", "src", "mpi", "tools", "python", "tests", "benchmarks"]
# Names in std:: by header, except names that almost every header includes, such as std::move.
STANDARD = {
    "algorithm": "any_of all_of binary_search clamp copy count count_if equal_range fill find find_if "
                 "lower_bound make_heap max max_element min min_element minmax none_of nth_element "
                 "pop_heap push_heap remove_if reverse rotate shuffle sort stable_sort transform "
                 "unique upper_bound",
    "array": "array",
    "atomic": "atomic memory_order_relaxed",
    "bit": "bit_ceil bit_width countr_zero has_single_bit popcount",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": "ceil floor isfinite isnan lround pow sqrt",
    "condition_variable": "condition_variable",
    "deque": "deque",
    "exception": "current_exception exception_ptr rethrow_exception",
    "filesystem": "filesystem",
    "fstream": "fstream ifstream ofstream",
    "functional": "function greater",
    "iostream": "cerr cin cout",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "lock_guard mutex scoped_lock unique_lock",
    "numeric": "accumulate gcd iota reduce",
    "optional": "nullopt optional",
    "queue": "priority_queue queue",
    "random": "mt19937 mt19937_64 uniform_int_distribution",
    "regex": "regex regex_match regex_replace regex_search",
    "set": "multiset set",
    "span": "span",
    "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "invalid_argument length_error logic_error out_of_range runtime_error",
    "string": "string to_string",
    "string_view": "string_view",
    "thread": "jthread this_thread thread",
    "tuple": "tie tuple",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "variant": "get_if holds_alternative variant visit",
    "vector": "vector",
}
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}


def standard_names(code):
    return set(re.findall(r"\bstd::(?:ranges::)?(\w+)", code)) & HEADER_OF.keys()


def other_names(code):
    """Returns the identifiers in the code, except members, names in other namespaces, and tests."""
    code = re.sub(r"\b\w*TEST\w*\(\s*\w+,\s*\w+", "", code)
    return set(re.findall(r"(?:(?<![.>\w:])|\bgrove::(?:detail::)?)(\w+)", code))


def declared_names(code):
    return set(re.findall(r"\b(?:enum class|class|struct|enum|using|typename)\s+(?:GROVE_API\s+)?(\w+)", code))


class Tree:
    """Holds the sources below a folder: {path: text}."""

    def __init__(self, root, texts):
        self.root, self.texts = root, texts
        self.code = {path: re.sub(r"^\s*#(?:[^\n\\]|\\\n)*", "", without_comments_and_strings(text),
                                  flags=re.M) for path, text in texts.items()}
        self.declared = {path: declared_names(code) for path, code in self.code.items()}
        self.defined_in = {}
        for path in texts:
            for name in named_types(texts[path], True) if path.suffix in (".h", ".hpp") else []:
                self.defined_in.setdefault(name.split("::")[-1], set()).add(path)

    def included(self, path):
        """Yields the sources that `path` includes."""
        for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', self.texts[path], re.M):
            candidates = [folder / name
                          for folder in (path.parent, self.root, self.root / "include", self.root / "src")]
            yield from (found for found in candidates if found in self.texts)

    def seen_by(self, path):
        """Returns `path` and all sources that it includes, directly or indirectly."""
        seen, new = set(), {path}
        while new:
            seen |= new
            new = {other for each in new for other in self.included(each)} - seen
        return seen

    def missing(self, path):
        """Returns the names that `path` uses without an include: {name: headers that define it}."""
        seen = self.seen_by(path)
        standard = {header for each in seen
                    for header in re.findall(r"^\s*#\s*include\s*<([^>]+)>", self.texts[each], re.M)}
        ours = other_names(self.code[path]) & self.defined_in.keys()
        ours -= set().union(*(self.declared[each] for each in seen))
        return {f"std::{name}": {HEADER_OF[name]} for name in standard_names(self.code[path])
                if HEADER_OF[name] not in standard} | {name: self.defined_in[name] for name in ours}


class TheTree(unittest.TestCase):
    def test_every_file_includes_what_it_names(self):
        tree = Tree(ROOT, {path: path.read_text(encoding="utf-8") for folder in FOLDERS
                           for path in (ROOT / folder).rglob("*") if path.suffix in CPP})
        self.assertTrue(tree.texts)
        for path in sorted(tree.texts):
            with self.subTest(path.relative_to(ROOT)):
                self.assertEqual(tree.missing(path), {})


class TheCheck(unittest.TestCase):
    def test_missing_includes_are_found(self):
        files = {"include/grove/a.h": "#include <vector>\nstruct A { std::vector<int> v; };",
                 "include/grove/b.h": '#include "grove/a.h"\nstruct B { A a; };',
                 "src/good.cpp": '#include "grove/b.h"\nA f(std::vector<B> b, C* c);  struct C;',
                 "src/bad.cpp": '#include <string>\nstd::vector<A> f(std::string); // B, std::map\n'
                                'x.A(); using std::set; TEST(B, C) {}'}
        root = Path("/")
        tree = Tree(root, {root / name: text for name, text in files.items()})
        self.assertEqual(tree.missing(root / "src/bad.cpp"),
                         {"std::vector": {"vector"}, "std::set": {"set"}, "A": {root / "include/grove/a.h"}})
        for path in set(tree.texts) - {root / "src/bad.cpp"}:
            self.assertEqual(tree.missing(path), {})


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
