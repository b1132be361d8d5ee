# SPDX-License-Identifier: MIT
"""How a program ends: messages and exit codes as grove's own."""
import asyncio
import os
import signal
import sys

from .bad_input import BadInput

BAD_INPUT = 2
FAILURE = 1


def complain(message):
    print("grove: error: " + message.replace("\n", "\\n"), file=sys.stderr)


def exit_code(run, arguments):
    """Of run(arguments), whatever becomes of it."""
    try:
        return run(arguments)
    except BadInput as error:
        complain(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except asyncio.CancelledError:
        return 128 + signal.SIGTERM
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the flush at the end
        return FAILURE
    except OSError as error:
        complain(f"{error.filename or 'the drive'}: {error.strerror or error}")
        return FAILURE
    except SystemExit:  # of --help
        return 0
