# SPDX-License-Identifier: MIT
"""Runs the checkers on an instance and the text of a certificate."""
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
    """For tests that are called with the program's path."""
    global VERIFY
    VERIFY = Path(sys.argv.pop(1)).resolve()
    suite.main()


class Verdict:
    """code, and what was said; seconds of processor time."""

    def __init__(self, command):
        Path("/proc/self/clear_refs").write_text("5")  # a child's peak begins with that of its parent
        with tempfile.TemporaryFile() as out:
            process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = self.code = os.waitstatus_to_exitcode(status)
            out.seek(0)
            self.text = out.read().decode()
        self.seconds = usage.ru_utime + usage.ru_stime
        self.memory = 1024 * usage.ru_maxrss  # bytes, at most


def verify(instance, certificate, *options):
    """Of grove-verify; instance: an Instance, or the path of its file; the certificate is text or bytes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        proof = folder / "proof"
        proof.write_bytes(certificate if isinstance(certificate, bytes) else certificate.encode())
        path = instance if isinstance(instance, Path) else instance.write(folder)
        return Verdict([VERIFY, path, proof, *options])


class Said(NamedTuple):
    code: int
    text: str


@functools.cache
def _small():
    spec = importlib.util.spec_from_file_location("proof_checker", SMALL)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def small_checker(instance, certificate):
    """Of docs/proof_checker.py, in this process: starting Python takes longer than a check."""
    said = io.StringIO()
    with tempfile.TemporaryDirectory() as name, contextlib.redirect_stdout(said):
        (Path(name) / "proof").write_text(certificate)
        path = instance if isinstance(instance, Path) else instance.write(Path(name))
        try:
            _small().main(path, Path(name) / "proof")
        except (SystemExit, Exception) as refused:  # a traceback refuses, too
            return Said(1, f"{refused}\n")
    return Said(0, said.getvalue())


def small_checker_within(memory, instance, certificate):
    """The same as a process of its own, which takes so many bytes at most."""
    code = f"import sys; sys.path.insert(0, {str(SMALL.parent)!r}); import proof_checker as checker; checker.MEMORY = {memory}; checker.run(*sys.argv[1:])"
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "proof").write_bytes(certificate)
        return Verdict([sys.executable, "-c", code, instance.write(Path(name)), Path(name) / "proof"])


def of(following):
    """What a verdict says of a certificate for worlds where agents may follow each other, or may not."""
    return "" if following else ", where following is forbidden"
