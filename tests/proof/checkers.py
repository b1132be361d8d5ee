# SPDX-License-Identifier: MIT
"""Runs the certificate checkers on an instance and the text of a certificate."""
import contextlib
import functools
import importlib.util
import io
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

VERIFY = None
SMALL = Path(__file__).resolve().parents[2] / "docs/proof_checker.py"


def main(suite):
    """Runs the tests of `suite`. The first command-line argument is the path of grove-verify."""
    global VERIFY
    VERIFY = Path(sys.argv.pop(1)).resolve()
    suite.main()


class Verdict:
    """Holds a checker's exit code, output, processor time in seconds and memory peak in bytes."""

    def __init__(self, command):
        Path("/proc/self/clear_refs").write_text("5")  # the measured peak of a child starts at that of its parent
        with tempfile.TemporaryFile() as out:
            process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = self.code = os.waitstatus_to_exitcode(status)
            out.seek(0)
            self.text = out.read().decode()
        self.seconds = usage.ru_utime + usage.ru_stime
        self.memory = 1024 * usage.ru_maxrss  # an upper bound


def verify(instance, certificate, *options):
    """Runs grove-verify and returns its Verdict. instance: an Instance, or the path of its file; certificate: text
    or bytes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        proof = folder / "proof"
        proof.write_bytes(certificate if isinstance(certificate, bytes) else certificate.encode())
        path = instance if isinstance(instance, Path) else instance.write(folder)
        return Verdict([VERIFY, path, proof, *options])


class Result(NamedTuple):
    code: int
    text: str


@functools.cache
def _small():
    spec = importlib.util.spec_from_file_location("proof_checker", SMALL)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def small_checker(instance, certificate):
    """Runs docs/proof_checker.py in this process, because starting Python takes longer than a check. Returns a
    Result."""
    output = io.StringIO()
    with tempfile.TemporaryDirectory() as name, contextlib.redirect_stdout(output):
        (Path(name) / "proof").write_text(certificate)
        path = instance if isinstance(instance, Path) else instance.write(Path(name))
        try:
            _small().main(path, Path(name) / "proof")
        except (SystemExit, Exception) as refused:  # a traceback counts as a refusal, too
            return Result(1, f"{refused}\n")
    return Result(0, output.getvalue())


def small_checker_within(memory, instance, certificate):
    """Runs docs/proof_checker.py in a separate process with a limit of `memory` bytes."""
    code = f"import sys; sys.path.insert(0, {str(SMALL.parent)!r}); import proof_checker as checker; " \
        f"checker.MEMORY = {memory}; checker.run(*sys.argv[1:])"
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "proof").write_bytes(certificate)
        return Verdict([sys.executable, "-c", code, instance.write(Path(name)), Path(name) / "proof"])


def following_note(following):
    """Returns the last words of a verdict: a note that following is forbidden, or nothing if it is allowed."""
    return "" if following else ", where following is forbidden"
