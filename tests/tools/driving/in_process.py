# SPDX-License-Identifier: MIT
"""Runs main() of a program in this process, because starting Python would take most of the time of a short run."""
import contextlib
import io
import signal


def run(main, *arguments):
    """Runs main(arguments) and returns (exit code, stdout, stderr)."""
    out, err = io.StringIO(), io.StringIO()
    handler = signal.getsignal(signal.SIGTERM)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(argument) for argument in arguments])
    finally:
        signal.signal(signal.SIGTERM, handler)
    return code, out.getvalue(), err.getvalue()
