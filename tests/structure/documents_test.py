#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the commands in documents.

    documents_test.py ROOT BIN_DIR DOCUMENT...           the quick blocks
    documents_test.py --slow ROOT BIN_DIR DOCUMENT...    also the slow ones

Commands are all lines of ```sh blocks and, in ```console blocks, the lines after "$ " (and after "> " on continuation
lines).
They run as if a user typed the document into one shell, whose folder is a copy of the tree at ROOT, with BIN_DIR as
build/release/bin. A block ends at the first command that fails.

The output that a ```console block shows below a command must be printed by the block, except for numbers and white
space. A line "..." stands for any lines, "..." at the end of a line for the rest of the line.

A comment on a line of its own before a block leaves the block out and gives the reason:

    <!-- slow: some ten minutes -->      runs only with --slow
    <!-- not run: needs a cluster -->    never runs

A block without such a comment may only call harmless programs (HARMLESS). Commands of Grove may not be in other
places: no indented line, and no block without a language, may begin with one.

Exit codes: 0 all chosen blocks ran, 1 a block failed or a command is in another place, 77 the programs are not built.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

SKIPPED = 77
SECONDS = {False: 120, True: 4 * 3600}  # time limit of a block, by whether it may be slow
BLOCK = re.compile(r"(?:^<!-- (?P<mark>slow|not run): (?P<why>[^\n]+) -->\n\s*)?"
                   r"^```(?P<language>console|sh)[ ]*\n(?P<body>.*?)^```", re.M | re.S)
HARMLESS = re.compile(r"(?:\w+=\S* )*(?:build/release/bin/)?(?:grove(?:-[\w-]+)?|mpirun|benchmarks/\w+\.py|"
                      r"python3|cat|cd|cp|echo|export|head|jq|ls|mkdir|wc)(?:\s|$)")
SOURCES = {"cmake", "include", "mpi", "python", "src", "tests", "tools"}
HIDDEN = re.compile(r"^ {4,}(?:\$ )?(?:build/release/bin/|benchmarks/\w+\.py|grove(?:-\w+)? |mpirun )[^\n]*|"
                    r"^```\n\s*\$ [^\n]*", re.M)
HERE = re.compile(r"<<-?\s*'?(\w+)'?")
# Permits mpirun to run as root, and with fewer cores than ranks.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


class Block(NamedTuple):
    script: str
    shown: list  # expected output lines
    mark: str  # "", "slow" or "not run"
    line: int


def script_and_output(language, body):
    if language == "sh":
        return body, []
    script, shown, is_continued = [], [], False
    for line in body.splitlines():
        if line.startswith("$ ") or (script and line.startswith("> ")) or is_continued:
            script.append(line if is_continued else line[2:])
            is_continued = line.endswith("\\")
        else:
            shown.append(line)
    return "".join(f"{line}\n" for line in script), shown


def blocks(document):
    return [Block(*script_and_output(each["language"], each["body"]), each["mark"] or "",
                  document.count("\n", 0, each.start("language")) + 1) for each in BLOCK.finditer(document)]


def commands(script):
    """Returns the lines at which commands start, ignoring comments and here-documents."""
    found, is_continued, end = [], False, None
    for line in script.splitlines():
        if end:
            end = None if line == end else end
        elif line.strip() and not line.lstrip().startswith("#"):
            if not is_continued:
                found.append(line.strip())
            is_continued = line.endswith("\\")
            if here := HERE.search(line):
                end = here.group(1)
    return found


def harmful(block):
    """Returns the first command of the block whose program is not in HARMLESS, or None."""
    parts = [part for command in commands(block.script) for part in re.split(r" (?:&&|\|\|?|;) ", command)]
    return next((part for part in parts if not HARMLESS.match(part)), None)


def hidden(document):
    """Returns commands outside the blocks that tests run."""
    fenced = re.sub(r"^```\w+[ ]*\n.*?^```", "", document, flags=re.M | re.S)
    return [found.group().strip() for found in HIDDEN.finditer(fenced)]


def normalised(line):
    """Returns the line with numbers replaced by # and white space reduced, because both differ from run to run."""
    return re.sub(r"\d[\w.,]*", "#", " ".join(line.split()))


def missing_line(shown, output):
    """Returns the first line of `shown` that is missing in the output, or None."""
    printed = [normalised(line) for line in output.splitlines()]
    for line in shown:
        start = normalised(line.removesuffix("..."))
        if not any(each == start or (line.endswith("...") and each.startswith(start)) for each in printed):
            return line
    return None


def start_shell(folder):
    """Writes the initial state of a document's shell (PATH and folder) and returns the path of the file. Each block
    replaces it by the state at its end."""
    state = folder / ".shell"
    state.write_text(f'export PATH="{folder}/build/release/bin:$PATH"\ncd "{folder}"\n', encoding="utf-8")
    return state


def run(block, state):
    """Runs a block and returns a description of its failure, or None."""
    seconds = SECONDS[block.mark == "slow"]
    script = f". {state}\nset -ev -o pipefail\n{block.script}\nset +v\n" \
        f"{{ export -p; printf 'cd %q\\n' \"$PWD\"; }} >{state}\n"
    try:
        done = subprocess.run(["bash", "-c", script], timeout=seconds, env={**os.environ, **MPI}, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    except subprocess.TimeoutExpired:
        return f"no end after {seconds} s:\n{block.script}"
    if done.returncode != 0:
        return f"exit {done.returncode}:\n{done.stdout}"
    if line := missing_line([line for line in block.shown if line.strip()], done.stdout):
        return f"shows '{line}', but the output is:\n{done.stdout}"
    return None


def tree(root, programs, folder, may_build):
    """Creates a copy of the tree. If no block builds anything, programs and sources are linked instead of copied,
    because no command writes to them."""
    linked = set() if may_build else SOURCES
    left_out = {"build", ".git", "results"} | linked
    shutil.copytree(root, folder, symlinks=True,
                    ignore=lambda at, names: left_out & set(names) if Path(at) == root else set())
    for name in linked:
        (folder / name).symlink_to(root / name)
    target = folder / "build/release/bin"
    target.parent.mkdir(parents=True)
    if may_build:
        shutil.copytree(programs, target, symlinks=True)
    else:
        target.symlink_to(programs)


def run_document(path, root, programs, is_slow):
    text = path.read_text(encoding="utf-8")
    found = blocks(text)
    wanted = [block for block in found if block.mark == "" or (is_slow and block.mark == "slow")]
    lost = hidden(text)
    for command in lost:
        print(f"FAILED: {path.relative_to(root)}: '{command}' is never run; expected a ```sh or ```console block")
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "grove"
        if wanted:
            tree(root, programs, folder, is_slow)
            state = start_shell(folder)
        for block in wanted:
            place = f"{path.relative_to(root)}:{block.line}"
            other = None if block.mark else harmful(block)
            wrong = f"'{other}' may do harm; expected a comment <!-- slow: WHY --> or <!-- not run: WHY --> before " \
                "the block" if other else run(block, state)
            failed += wrong is not None
            print(f"FAILED: {place}: {wrong}" if wrong else f"ok: {place}: {len(commands(block.script))} commands",
                  flush=True)
    print(f"{path.relative_to(root)}: {len(wanted) - failed} of {len(found)} blocks ran, {failed} failed, "
          f"{len(found) - len(wanted)} left out")
    return failed + len(lost)


def self_test():
    document = ("```console\n$ grove solve a \\\n    --quiet\nsome 12 s  of output\n"
                "$ grove x <<END\n> text\n> END\n```\n"
                "<!-- slow: builds -->\n```sh\ncmake --build . && ls  # all\n```\n"
                "```\ngrove not this\n```\n<!-- not run: why -->\n\n```sh\nrm x\n```\n```sh\nrm x\n```\n")
    found = blocks(document)
    assert [block.mark for block in found] == ["", "slow", "not run", ""], found
    assert found[0].script == "grove solve a \\\n    --quiet\ngrove x <<END\ntext\nEND\n", found[0]
    assert commands(found[0].script) == ["grove solve a \\", "grove x <<END"]
    assert harmful(found[0]) is None and harmful(found[3]) == "rm x" and found[3].line == 21, found[3]
    assert harmful(Block("A=1 grove x | head -1 && cd y\ncat <<'END'\nrm\nEND\n# rm\n", [], "", 1)) is None
    assert harmful(Block("grove x && rm y\n", [], "", 1)) == "rm y"
    assert missing_line(["some 3.5 s of output", "...", "so..."], "some 12 s of output\nso it is") is None
    assert missing_line(["other 3.5 s"], "some 12 s") == "other 3.5 s"
    text = "a\n    grove solve x\n    ls\n```sh\n    grove y\n```\n```\n$ z\n```\n"
    assert hidden(text) == ["grove solve x", "```\n$ z"]
    with tempfile.TemporaryDirectory() as name:
        state = start_shell(Path(name))
        assert run(Block("export A='b c'\nmkdir d\ncd d\n", [], "", 1), state) is None
        assert run(Block('test "$A" = "b c"\ntest "$PWD" -ef ../d\n', [], "", 1), state) is None
        assert run(Block("exit 3\n", [], "", 1), state).startswith("exit 3")
        assert run(Block("false\ntrue\n", [], "", 1), state) and run(Block("echo 1\n", ["a"], "", 1), state)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slow", action="store_true")
    parser.add_argument("root", type=Path)
    parser.add_argument("programs", type=Path)
    parser.add_argument("documents", type=Path, nargs="+")
    arguments = parser.parse_args()
    self_test()
    root, programs = arguments.root.resolve(), arguments.programs.resolve()
    if not (programs / "grove").exists():
        print(f"skipped: {programs / 'grove'} is not built")
        return SKIPPED
    return 1 if sum(run_document(path.resolve(), root, programs, arguments.slow) for path in arguments.documents) else 0


if __name__ == "__main__":
    sys.exit(main())
