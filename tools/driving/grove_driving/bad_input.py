# SPDX-License-Identifier: MIT
"""What a user gave that cannot be used."""


class BadInput(Exception):
    """Its text is the line that the user reads."""


def at(file, place, found, expected):
    return BadInput(f"{file}: {place}: found {found}; expected {expected}" if place
                    else f"{file}: found {found}; expected {expected}")
