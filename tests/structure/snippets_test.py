#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the C++ code in a document compiles and, except for complete programs, runs.

    snippets_test.py DOCUMENT COMPILER LIBRARY INSTANCE INCLUDE_DIR...

A ```cpp block with a main() is a program. All other blocks form, in order, the main() of one more program, which is
linked with LIBRARY and runs in a folder where INSTANCE is depot.cts.json. If LIBRARY does not exist, this program is
only compiled. Programs that include mpi.hpp are skipped if no INCLUDE_DIR contains mpi.h.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.M | re.S)
HEAD = """#include <cstdio>
#include <future>
#include <grove/grove.hpp>
#include <stop_token>
int main() {
"""


def programs(document):
    """Returns the sources of the programs in the document, with their line numbers."""
    found, body = [], ""
    for match in BLOCK.finditer(document):
        line = document.count("\n", 0, match.start()) + 2
        if re.search(r"^int main\(", match.group(1), re.M):
            found.append(f"#line {line}\n{match.group(1)}")
        else:
            body += f"#line {line}\n{match.group(1)}"
    return found + ([HEAD + body + "}\n"] if body else [])


def complaints(compiler, folders, source, *options):
    """Compiles a source and returns the errors and warnings, except those in Grove headers."""
    includes = [word for folder in folders for word in ("-isystem", folder)]
    done = subprocess.run([compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
                           "-Wno-unused-but-set-variable", *includes, "-x", "c++", "-",
                           *(options or ["-fsyntax-only"])],
                          input=source, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


def failure_of_run(compiler, folders, source, library, instance):
    with tempfile.TemporaryDirectory() as folder:
        for path in (instance, *instance.parent.glob("*.map")):
            shutil.copy(path, Path(folder) / ("depot.cts.json" if path == instance else path.name))
        program = Path(folder) / "program"
        failure = complaints(compiler, folders, source, "-o", program, "-x", "none", library,
                             f"-Wl,-rpath,{library.parent}")
        if failure:
            return failure
        done = subprocess.run([program], cwd=folder, capture_output=True, text=True, timeout=60, check=False)
        print(done.stdout, end="")
        return "" if done.returncode == 0 else f"it ended with {done.returncode}: {done.stderr}"


def self_test(compiler, folders):
    document = "a\n```cpp\nint a = 1;\n```\n```cpp\nint b = a;\n```\n```sh\nls\n```\n```cpp\nint main() {}\n```\n"
    program, snippets = programs(document)
    assert program == "#line 12\nint main() {}\n", program
    assert snippets.endswith("#line 3\nint a = 1;\n#line 6\nint b = a;\n}\n"), snippets
    assert "Wold" in complaints(compiler, folders, programs("```cpp\nconst grove::Wold world;\n```\n")[0])


def main():
    document, library, instance, *folders = (Path(argument) for argument in sys.argv[1:2] + sys.argv[3:])
    compiler = sys.argv[2]
    self_test(compiler, folders)
    has_mpi = any((folder / "mpi.h").exists() for folder in folders)
    found = programs(document.read_text(encoding="utf-8"))
    tried = [source for source in found if has_mpi or "mpi.hpp" not in source]
    assert tried, f"{document} shows no C++"
    failures = [failure_of_run(compiler, folders, source, library.resolve(), instance)
                if source.startswith(HEAD) and library.exists() else complaints(compiler, folders, source)
                for source in tried]
    print(*filter(None, failures), f"{failures.count('')} of {len(found)} are in order", sep="\n")
    return 1 if any(failures) else 0


if __name__ == "__main__":
    sys.exit(main())
