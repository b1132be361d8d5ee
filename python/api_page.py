#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints docs/python-api.md, made from the stubs (names and signatures) and the docstrings.

    api_page.py PACKAGE_DIR > docs/python-api.md

PACKAGE_DIR: directory of the built package grove, such as build/release/python.
A test fails if the page is out of date.
"""
import ast
import inspect
import re
import sys
from pathlib import Path

WIDTH = 100
HEAD = """# Python: every name

[python.md](python.md) is the guide. `python/api_page.py` makes this page from the stubs and the docstrings.

`Place` is `(x, y)` on a grid. On a roadmap it is `"A"`, a vertex, or `("A", "B", steps)`, a place on a road, with the
number of the edge as a fourth entry if several roads join the two vertices. `Path` is a `str` or an `os.PathLike`.
Times in plans are in steps, run times in seconds.

Errors are subclasses of `grove.Error`: `InputError` for files, agents and tasks, `InvalidArgument` for other values.
Worlds, instances, plans and solutions are immutable: any thread may read them. Only one thread at a time may use a
session. Other Python threads keep running during a search. `grove.__version__` is a str, "0.1.0".
"""
SECTIONS = {
    "Worlds and instances": ["World", "Instance", "instance_from_dict", "instance_from_arrays", "read_instance",
                             "read_scenario"],
    "Solving": ["solve", "Solution", "Progress", "Session", "default_threads", "default_memory_limit"],
    "Plans": ["Plan", "AgentPlan", "check", "read_plan", "fix_choices", "visits", "data_frame"],
    "Displaying": ["view", "View", "picture"],
    "Errors": ["Error", "InputError", "InvalidArgument"],
}


def code_text(node):
    text = ast.unparse(node).replace("'", '"')
    return re.sub(r"\bnumpy\.(typing\.)?", "", text).replace("_Place", "Place").replace("_Path", "Path")


def parameter(argument, default=None, star=""):
    text = star + argument.arg + (f": {code_text(argument.annotation)}" if argument.annotation else "")
    return text + (f" = {code_text(default)}" if default else "")


def parameters(arguments):
    """Returns the parameters as written in a definition, without self."""
    needed = len(arguments.args) - len(arguments.defaults)
    found = [parameter(argument, default)
             for argument, default in zip(arguments.args, [None] * needed + arguments.defaults)
             if argument.arg != "self"]
    if arguments.vararg:
        found.append(parameter(arguments.vararg, star="*"))
    elif arguments.kwonlyargs:
        found.append("*")
    return found + [parameter(*pair) for pair in zip(arguments.kwonlyargs, arguments.kw_defaults)]


def signature(name, node):
    """Returns the signature on one line if it fits WIDTH columns, otherwise with the parameters on indented lines."""
    result = code_text(node.returns)
    tail = ")" + (f" -> {result}" if result != "None" else "")
    parts = parameters(node.args)
    if len(f"{name}(" + ", ".join(parts) + tail) <= WIDTH:
        return f"{name}(" + ", ".join(parts) + tail
    lines = [f"{name}("]
    for part in [part + "," for part in parts[:-1]] + [parts[-1] + tail]:
        if len(lines) == 1 or len(f"{lines[-1]} {part}") > WIDTH:
            lines.append("   ")
        lines[-1] += f" {part}"
    return "\n".join(lines)


def doc_of(thing, name):
    """Returns the docstring without the signature that pybind11 adds."""
    text = re.sub(r"^\w+\(.*\) -> .*\n+", "", inspect.getdoc(thing) or "").strip()
    if not text:
        raise SystemExit(f"api_page.py: {name} has no docstring")
    return text


def markdown(text):
    """Converts a docstring to Markdown. `name: text` lines become list items, paragraphs that start with >>> become
    code."""
    blocks = []
    for paragraph in re.split(r"\n\s*\n", text):
        if paragraph.startswith(">>>"):
            blocks.append(f"```python\n{paragraph}\n```")
            continue
        for number, line in enumerate(paragraph.splitlines()):
            named = re.match(r"((?:[a-z]\w*, )*[a-z]\w*): (.*)", line)
            if named:
                blocks.append(f"- `{named.group(1).replace(', ', '`, `')}`: {named.group(2)}")
            elif number == 0:
                blocks.append(line)
            else:
                blocks[-1] += " " + line.strip()
    text = "\n\n".join(blocks).replace("*.", "\\*.")
    return re.sub(r"^(- .*)\n\n(?=- )", r"\1\n", text, flags=re.M)


def has_mark(node, mark):
    return any(isinstance(found, ast.Name) and found.id == mark for found in node.decorator_list)


def code(text):
    return f"```python\n{text}\n```"


def class_blocks(name, node, thing):
    functions = {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}
    init = functions.pop("__init__", None)
    blocks = [code(signature(f"grove.{name}", init) if init else f"grove.{name}"),
              markdown(doc_of(thing, name))]
    bases = [f"`{base.id}`" for base in node.bases if base.id != "Exception"]
    if bases:
        blocks.append(f"Bases: {', '.join(bases)}.")
    rows, methods = [], []
    for key, item in functions.items():
        description = markdown(doc_of(getattr(thing, key), f"{name}.{key}"))
        if has_mark(item, "property"):
            kind = code_text(item.returns).replace(" | ", " or ")  # a bar would separate cells
            rows.append(f"| `{key}` | `{kind}` | {description} |")
        else:
            owner = f"grove.{name}" if has_mark(item, "staticmethod") else name.lower()
            methods += [code(signature(f"{owner}.{key}", item)), description]
    if rows:
        blocks.append("\n".join(["| property | type | |", "|---|---|---|", *rows]))
    return blocks + methods


def blocks_of(name, node, thing):
    if isinstance(node, ast.ClassDef):
        return class_blocks(name, node, thing)
    return [code(signature(f"grove.{name}", node)), markdown(doc_of(thing, name))]


def page(grove, stubs):
    nodes = {node.name: node for node in stubs.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    documented = [name for names in SECTIONS.values() for name in names] + ["__version__"]
    if sorted(documented) != sorted(grove.__all__):
        raise SystemExit(f"api_page.py: SECTIONS and grove.__all__ differ in {set(documented) ^ set(grove.__all__)}")
    blocks = [HEAD.strip()]
    for section, names in SECTIONS.items():
        blocks.append(f"## {section}")
        for name in names:
            blocks += [f"### {name}", *blocks_of(name, nodes[name], getattr(grove, name))]
    return "\n\n".join(blocks) + "\n"


if __name__ == "__main__":
    package = Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(package))
    import grove as module
    print(page(module, ast.parse((package / "grove/__init__.pyi").read_text(encoding="utf-8"))), end="")
