# SPDX-License-Identifier: MIT
"""Parses command lines, with help and error messages in the format of grove."""
import argparse

from .bad_input import BadInput


class Help(argparse.RawDescriptionHelpFormatter):
    def __init__(self, prog):
        super().__init__(prog, width=106, max_help_position=30)


class Parser(argparse.ArgumentParser):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, allow_abbrev=False, formatter_class=Help, **options)

    def error(self, message):
        raise BadInput(f"{message.removeprefix('argument ')} (see '{self.prog} --help')")


def wrong(text, expected):
    return argparse.ArgumentTypeError(f"found '{text}'; expected {expected}")


def number(text, least, most, expected):
    try:
        value = float(text)
    except ValueError:
        raise wrong(text, expected) from None
    if not least <= value <= most:
        raise wrong(text, expected)
    return value


def share(text):
    return number(text, 0, 0.9, "a number from 0 to 0.9")


def amount(text):
    return number(text, 0, 1e6, "a number of at least 0")


def positive(text):
    return number(text, 1e-3, 1e6, "a number of at least 0.001")


def integers(text, parts, least, most, expected):
    """Returns the parts as integers. Raises ArgumentTypeError for `text` unless all are integers in [least, most]."""
    if not all(p.isascii() and p.isdigit() and least <= int(p) <= most for p in parts):
        raise wrong(text, expected)
    return [int(p) for p in parts]


def integer(text, least, most, expected):
    return integers(text, [text], least, most, expected)[0]


def seed(text):
    return integer(text, 0, 10 ** 18, "an integer of at least 0")


def robot_at_for(text, endless=True):
    """Parses ROBOT@SECONDS=SECONDS and returns (robot, begin, duration). With `endless` the duration can be 'never'."""
    expected = "ROBOT@SECONDS=SECONDS" + (", or ROBOT@SECONDS=never" if endless else "")
    robot, mark, when = text.rpartition("@")
    begin, equals, seconds = when.partition("=")
    if not robot or not mark or not equals:
        raise wrong(text, expected)
    try:
        return robot, amount(begin), float("inf") if endless and seconds == "never" else amount(seconds)
    except argparse.ArgumentTypeError:
        raise wrong(text, expected) from None
