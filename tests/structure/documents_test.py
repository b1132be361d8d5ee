#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the commands that documents show.

    documents_test.py ROOT BIN_DIR DOCUMENT...           what is quick
    documents_test.py --slow ROOT BIN_DIR DOCUMENT...    also what is not

Commands are all lines of ```sh blocks and, of ```console blocks, those after "$ " (and "> ", where they go on).
They run as if one typed the document into one shell, whose folder is a copy of the tree at ROOT, with BIN_DIR as
build/release/bin; a block ends at the first command that fails.

What a ```console block shows below a command must be what the block prints, but for numbers and spaces; a line
"..." stands for lines, "..." at the end of one for the rest of it.

A comment of its own line before a block says that it is left out, and why:

    <!-- slow: some ten minutes -->      only with --slow
    <!-- not run: needs a cluster -->    never

Without one a block may only name programs that do no harm to who runs the tests (HARMLESS). Commands of ours
nowhere else: lines set in by blanks, and blocks of no language, may not begin with one.

Exit codes: 0 all ran, 1 one did not, 77 no program yet.
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
SECONDS = {False: 120, True: 4 * 3600}  # of a block, by whether it may be slow
BLOCK = re.compile(r"(?:^<!-- (?P<mark>slow|not run): (?P<why>[^\n]+) -->\n\s*)?"
                   r"^```(?P<language>console|sh)[ ]*\n(?P<body>.*?)^```", re.M | re.S)
HARMLESS = re.compile(r"(?:\w+=\S* )*(?:build/release/bin/)?(?:grove(?:-[\w-]+)?|mpirun|benchmarks/\w+\.py|"
                      r"python3|cat|cd|cp|echo|export|head|jq|ls|mkdir|wc)(?:\s|$)")
SOURCES = {"cmake", "include", "mpi", "python", "src", "tests", "tools"}
HIDDEN = re.compile(r"^ {4,}(?:\$ )?(?:build/release/bin/|benchmarks/\w+\.py|grove(?:-\w+)? |mpirun )[^\n]*|"
                    r"^```\n\s*\$ [^\n]*", re.M)
HERE = re.compile(r"<<-?\s*'?(\w+)'?")
# What mpirun minds: root, and fewer cores than ranks.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


class Block(NamedTuple):
    script: str
    shown: list  # lines of output
    mark: str  # "", "slow" or "not run"
    line: int


def script_and_output(language, body):
    if language == "sh":
        return body, []
    script, shown, goes_on = [], [], False
    for line in body.splitlines():
        if line.startswith("$ ") or (script and line.startswith("> ")) or goes_on:
            script.append(line if goes_on else line[2:])
            goes_on = line.endswith("\\")
        else:
            shown.append(line)
    return "".join(f"{line}\n" for line in script), shown


def blocks(document):
    return [Block(*script_and_output(each["language"], each["body"]), each["mark"] or "",
                  document.count("\n", 0, each.start("language")) + 1) for each in BLOCK.finditer(document)]


def commands(script):
    """The lines at which commands begin, without comments and the text of here-documents."""
    found, goes_on, end = [], False, None
    for line in script.splitlines():
        if end:
            end = None if line == end else end
        elif line.strip() and not line.lstrip().startswith("#"):
            if not goes_on:
                found.append(line.strip())
            goes_on = line.endswith("\\")
            if here := HERE.search(line):
                end = here.group(1)
    return found


def harmful(block):
    """Of a block without a mark, a program that is not known to do no harm."""
    parts = [part for command in commands(block.script) for part in re.split(r" (?:&&|\|\|?|;) ", command)]
    return next((part for part in parts if not HARMLESS.match(part)), None)


def hidden(document):
    """Commands that no test would run."""
    fenced = re.sub(r"^```\w+[ ]*\n.*?^```", "", document, flags=re.M | re.S)
    return [found.group().strip() for found in HIDDEN.finditer(fenced)]


def bare(line):
    """A line without what differs from run to run."""
    return re.sub(r"\d[\w.,]*", "#", " ".join(line.split()))


def unsaid(shown, output):
    """The first line shown that is none of the output."""
    said = [bare(line) for line in output.splitlines()]
    for line in shown:
        start = bare(line.removesuffix("..."))
        if not any(each == start or (line.endswith("...") and each.startswith(start)) for each in said):
            return line
    return None


def start_shell(folder):
    """What the shell of a document knows: its folder and, after the first block, its variables."""
    state = folder / ".shell"
    state.write_text(f'export PATH="{folder}/build/release/bin:$PATH"\ncd "{folder}"\n', encoding="utf-8")
    return state


def run(block, state):
    """What went wrong, or nothing."""
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
    if line := unsaid([line for line in block.shown if line.strip()], done.stdout):
        return f"shows '{line}', but what is printed is:\n{done.stdout}"
    return None


def tree(root, programs, folder, may_build):
    """A copy of the tree. Where nothing is built, programs and sources are only linked: no command writes there."""
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
    document = ("```console\n$ grove solve a \\\n    --quiet\nsome 12 s  of output\n$ grove x <<END\n> text\n> END\n```\n"
                "<!-- slow: builds -->\n```sh\ncmake --build . && ls  # all\n```\n"
                "```\ngrove not this\n```\n<!-- not run: why -->\n\n```sh\nrm x\n```\n```sh\nrm x\n```\n")
    found = blocks(document)
    assert [block.mark for block in found] == ["", "slow", "not run", ""], found
    assert found[0].script == "grove solve a \\\n    --quiet\ngrove x <<END\ntext\nEND\n", found[0]
    assert commands(found[0].script) == ["grove solve a \\", "grove x <<END"]
    assert harmful(found[0]) is None and harmful(found[3]) == "rm x" and found[3].line == 21, found[3]
    assert harmful(Block("A=1 grove x | head -1 && cd y\ncat <<'END'\nrm\nEND\n# rm\n", [], "", 1)) is None
    assert harmful(Block("grove x && rm y\n", [], "", 1)) == "rm y"
    assert unsaid(["some 3.5 s of output", "...", "so..."], "some 12 s of output\nso it is") is None
    assert unsaid(["other 3.5 s"], "some 12 s") == "other 3.5 s"
    assert hidden("a\n    grove solve x\n    ls\n```sh\n    grove y\n```\n```\n$ z\n```\n") == ["grove solve x", "```\n$ z"]
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
        print(f"skipped: there is no {programs / 'grove'}")
        return SKIPPED
    return 1 if sum(run_document(path.resolve(), root, programs, arguments.slow) for path in arguments.documents) else 0


if __name__ == "__main__":
    sys.exit(main())
