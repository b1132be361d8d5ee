# SPDX-License-Identifier: MIT
"""Runs programs with exit codes and error messages in the format of grove."""
import asyncio
import os
import signal
import sys

from .bad_input import BadInput

BAD_INPUT = 2
FAILURE = 1


def print_error(message):
    print("grove: error: " + message.replace("\n", "\\n"), file=sys.stderr)


def exit_code(run, arguments):
    """Calls run(arguments) and returns its exit code. Converts expected exceptions to exit codes and error messages."""
    try:
        return run(arguments)
    except BadInput as error:
        print_error(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except asyncio.CancelledError:
        return 128 + signal.SIGTERM
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # so that Python's flush at exit does not fail
        return FAILURE
    except OSError as error:
        print_error(f"{error.filename or 'the drive'}: {error.strerror or error}")
        return FAILURE
    except SystemExit:  # raised by --help
        return 0
