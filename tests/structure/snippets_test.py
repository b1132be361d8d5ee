#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The C++ that a document shows compiles.

    snippets_test.py DOCUMENT COMPILER INCLUDE_DIR...

A ```cpp block with a main() is a program; the others are, one after the other, the body of one function.
Programs that include mpi.hpp are left out where no INCLUDE_DIR has mpi.h.
"""
import re
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.M | re.S)
HEAD = """#include <cstdio>
#include <future>
#include <grove/grove.hpp>
#include <stop_token>
int main() {
"""


def programs(document):
    """Their sources, with the lines that they have in the document."""
    found, body = [], ""
    for match in BLOCK.finditer(document):
        line = document.count("\n", 0, match.start()) + 2
        if re.search(r"^int main\(", match.group(1), re.M):
            found.append(f"#line {line}\n{match.group(1)}")
        else:
            body += f"#line {line}\n{match.group(1)}"
    return found + ([HEAD + body + "}\n"] if body else [])


def complaints(compiler, folders, source):
    """Of the compiler; of headers none."""
    includes = [word for folder in folders for word in ("-isystem", folder)]
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
                           "-Wno-unused-variable", "-Wno-unused-but-set-variable", *includes, "-x", "c++", "-"],
                          input=source, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


def self_test(compiler, folders):
    document = "a\n```cpp\nint a = 1;\n```\n```cpp\nint b = a;\n```\n```sh\nls\n```\n```cpp\nint main() {}\n```\n"
    program, snippets = programs(document)
    assert program == "#line 12\nint main() {}\n", program
    assert snippets.endswith("#line 3\nint a = 1;\n#line 6\nint b = a;\n}\n"), snippets
    assert "Wold" in complaints(compiler, folders, programs("```cpp\nconst grove::Wold world;\n```\n")[0])


def main():
    document, compiler, folders = Path(sys.argv[1]), sys.argv[2], [Path(folder) for folder in sys.argv[3:]]
    self_test(compiler, folders)
    has_mpi = any((folder / "mpi.h").exists() for folder in folders)
    found = programs(document.read_text(encoding="utf-8"))
    tried = [source for source in found if has_mpi or "mpi.hpp" not in source]
    assert tried, f"{document} shows no C++"
    failures = [failure for source in tried if (failure := complaints(compiler, folders, source))]
    print(*failures, f"{len(tried) - len(failures)} of {len(found)} compile", sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
