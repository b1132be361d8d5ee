# SPDX-License-Identifier: MIT
"""Writes tables as CSV and as HTML."""
import csv
import html
import io
import math
import re
from typing import NamedTuple


def csv_value(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.6g}"
    text = str(value)
    return "'" + text if _is_like_a_formula(text) else text


def _is_like_a_formula(text):
    """Returns whether a spreadsheet would interpret the text as a formula (OWASP, CSV injection).

    The rule is the same as in src/io/csv.cpp.
    """
    bare = text.lstrip("'")
    return bare.startswith(("=", "+", "-", "@", "\t", "\r")) and not re.fullmatch(
        r"-[0-9]+(\.[0-9]*)?(e[-+]?[0-9]+)?", bare)


def text_of_cell(cell):
    """Returns the text from which csv_value() made this cell."""
    return cell[1:] if cell.startswith("'") and _is_like_a_formula(cell) else cell


def csv_text(header, rows):
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([csv_value(value) for value in row] for row in rows)
    return file.getvalue()


class Entry(NamedTuple):
    """One cell of an HTML table."""
    text: str
    hint: str = ""        # tooltip
    strong: bool = False
    number: bool = True   # right-aligned


def word(text, hint=""):
    return Entry(str(text), hint, number=False)


NOTHING = Entry("–", "no rows")


def seconds(value):
    """Formats seconds with at least three significant digits. Shorter times than 1 ms become "<0.001", None a dash."""
    if value is None:
        return "–"
    if value < 0.001:
        return "<0.001"
    digits = max(0, 2 - math.floor(math.log10(value)))
    return f"{value:.{digits}f}"


def percent(value):
    return f"{100 * value:.0f} %"


def ratio(value):
    return "–" if value is None else f"{value:.3f}"


def count(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if value >= 100 or value == int(value) else f"{value:.1f}"


def _cell(tag, entry):
    hint = f' title="{html.escape(entry.hint)}"' if entry.hint else ""
    kind = ' class="number"' if entry.number else ""
    text = html.escape(entry.text)
    return f"<{tag}{kind}{hint}>{f'<b>{text}</b>' if entry.strong else text}</{tag}>"


def html_table(header, rows):
    """Returns an HTML table with a sticky header. `header`: list of texts or Entries. `rows`: lists of Entries."""
    numbers = rows[0] if rows else [Entry("")] * len(header)
    heads = [entry if isinstance(entry, Entry) else Entry(entry, number=first.number)
             for entry, first in zip(header, numbers)]
    lines = ['<div class="scroll"><table>']
    lines.append("<thead><tr>" + "".join(_cell("th", head) for head in heads) + "</tr></thead>")
    lines.append("<tbody>")
    lines += ["<tr>" + "".join(_cell("td", entry) for entry in row) + "</tr>" for row in rows]
    lines.append("</tbody></table></div>")
    return "\n".join(lines)
