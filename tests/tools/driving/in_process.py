# SPDX-License-Identifier: MIT
"""Runs a program's main() in this process: for command lines that end at once, of which starting Python is most."""
import contextlib
import io
import signal


def run(main, *arguments):
    """(exit code, stdout, stderr) of main(arguments), as of the program."""
    out, err = io.StringIO(), io.StringIO()
    handler = signal.getsignal(signal.SIGTERM)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(argument) for argument in arguments])
    finally:
        signal.signal(signal.SIGTERM, handler)
    return code, out.getvalue(), err.getvalue()
