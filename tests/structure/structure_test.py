#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the structure of the source tree: which layers each layer may include, and what no source may contain.

    structure_test.py [ROOT]   checks the tree at ROOT, by default this one
"""
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Lowest layer first. Each layer may use only the layers before it.
LAYERS = ["model", "execution", "io", "sequencing", "planning", "assignment", "joint", "lagrangian", "conflicts", "search", "cores",
          "proof", "primal", "baselines",
          "engine", "batch", "api", "mpi", "tools"]
CODE_FOLDERS = ["include", "src", "mpi", "cluster", "examples", "python", "tools", "tests", "benchmarks"]
CPP = {".h", ".hpp", ".cpp"}
FORBIDDEN_IN_LIBRARIES = {
    "ends the process": r"(?<![.>\w])(?:exit|_exit|_Exit|quick_exit|abort|terminate)\s*\((?!\) override)",
    "prints": r"\bstd::(?:cout|cerr|clog)\b|\b(?:printf|puts|putchar)\s*\(|\bstd(?:out|err)\b"
              r"|\bfmt::print(?:ln)?\s*\(\s*\"",
    "is unfinished": r"\b(?:TODO|FIXME|XXX)\b",
}


def without_comments_and_strings(text):
    """Returns the code without comments and without the contents of strings. Line ends and quotes remain."""
    token = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
                       r"|(?<!\w)'(?:\\.|[^'\\\n])+'", re.S)

    def empty(match):
        quote = '""' if match.group()[0] in 'R"' else ""
        return quote + "\n" * match.group().count("\n")

    return token.sub(empty, text)


def includes(text):
    """Returns the layer headers that `text` includes, for example "search/global_bounds.h"."""
    named = re.findall(r'^\s*#\s*include\s*"([\w./]+)"', text, re.M)
    return {name for name in named if name.split("/")[0] in LAYERS}


def layers_of(headers):
    return {header.split("/")[0] for header in headers}


def points_back(layer, included):
    """Returns the layers among `included` that `layer` must not include."""
    return {other for other in included if LAYERS.index(other) > LAYERS.index(layer)}


def forbidden(text):
    code = without_comments_and_strings(text)
    found = [what for what, pattern in FORBIDDEN_IN_LIBRARIES.items()
             if what != "is unfinished" and re.search(pattern, code)]
    if re.search(FORBIDDEN_IN_LIBRARIES["is unfinished"], text):
        found.append("is unfinished")
    return found


def names_mpi(text):
    return bool(re.search(r"\bMPI_[A-Z]", without_comments_and_strings(text)))


def has_license(text):
    return any("SPDX-License-Identifier: MIT" in line for line in text.splitlines()[:2])


def named_files(document):
    """Returns the source files that a document names, except placeholders such as `mine.cpp` and `x_test.cpp`."""
    named = re.findall(r"`(?:\./)?([\w./-]+\.(?:cpp|h|py|def|cmake))`", document)
    return [name for name in named if not re.match(r"(?:.*/)?(?:mine|my_\w*|x_\w+)\.", name)]


def named_types(text, is_header):
    """Returns the types that `text` defines in a named namespace or at global scope, for example "grove::Grid".
    Aliases count only in headers."""
    code = re.sub(r"^\s*#(?:[^\n\\]|\\\n)*", "", without_comments_and_strings(text), flags=re.M)
    found, scopes, start = [], [], 0
    for token in re.finditer(r"[{};]", code):
        head, start = code[start:token.start()].strip(), token.end()
        in_namespace = None not in scopes
        if token.group() == "}":
            scopes[-1:] = []
            continue
        alias = re.search(r"^(?:template\s*<.*>\s*)?using\s+(\w+)\s*=", head, re.S)
        if alias and is_header and in_namespace:
            found.append("::".join([*scopes, alias.group(1)]))
        if token.group() == "{":
            namespace = re.search(r"\bnamespace\s+([\w:]+)$", head)
            defined = re.search(r"(?:^|[>\s])(?:class|struct|union|enum(?:\s+class)?)\s+(?:GROVE_API\s+)?([\w:]+)"
                                r"(?:\s+final)?(?:\s*:[^{]*)?$", head)
            if defined and in_namespace:
                found.append("::".join([*scopes, defined.group(1)]))
            scopes.append(namespace.group(1) if namespace else None)
    return found


def declared_depends(cmake):
    """Returns {layer: [layers it declares]} of the grove_layer() calls in a CMakeLists.txt."""
    code = re.sub(r"#[^\n]*", "", cmake)
    result = {}
    for name, body in re.findall(r"grove_layer\(\s*(\w+)(.*?)\)", code, re.S):
        words = re.split(r"\b(?:SOURCES|LINK_PUBLIC|LINK_PRIVATE)\b", body)
        depends = [part.split("DEPENDS", 1)[1].split() for part in words if "DEPENDS" in part]
        result[name] = sum(depends, [])
    return result


def private_headers(cmake):
    """Returns the headers of all grove_private_headers() calls in a CMakeLists.txt."""
    calls = re.findall(r"grove_private_headers\(([^)]*)\)", re.sub(r"#[^\n]*", "", cmake))
    return [header for call in calls for header in call.split()[1:]]


def as_included(path):
    """Returns the path by which sources include the header at `path`, for example "search/frontier.h"."""
    return path.relative_to(ROOT / "src" if (ROOT / "src") in path.parents else ROOT).as_posix()


def closure(layer, declared):
    reached = {layer}
    for other in declared.get(layer, []):
        reached |= closure(other, declared)
    return reached


class TheTree(unittest.TestCase):
    def sources(self, *folders, suffixes=CPP):
        for folder in folders:
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix in suffixes and path.is_file():
                    yield path, path.read_text(encoding="utf-8")

    def layer_sources(self, layer):
        return self.sources(layer if layer in ("mpi", "tools") else f"src/{layer}")

    def declared(self):
        result = {}
        for path in [*(ROOT / "src").glob("*/CMakeLists.txt"), ROOT / "mpi/CMakeLists.txt"]:
            if path.exists():
                result |= declared_depends(path.read_text())
        return result

    def test_sources_are_found(self):
        self.assertTrue(list(self.layer_sources("model")))
        self.assertIn("model", self.declared())

    def test_readers_agree_on_renamed_counters(self):
        """Checks that the plan reader, the run page and the report map the old names of counters to the same current
        names."""
        def pairs(file, pattern, begin, end):
            text = (ROOT / file).read_text(encoding="utf-8").split(begin, 1)[1].split(end, 1)[0]
            return dict(re.findall(pattern, text))
        plans = pairs("src/io/plan_file.cpp", r'\{"(\w+)", "(\w+)"\}', "kRenamed{", "};")
        self.assertGreater(len(plans), 20)
        self.assertEqual(pairs("tools/view/run/renamed.ts", r'(\w+): "(\w+)"', "kCounters", "};"), plans)
        self.assertEqual(pairs("tools/report/grove_report/rows.py", r'"(\w+)": "(\w+)"', "RENAMED_COUNTERS = {", "}"),
                         plans)

    def test_every_tunable_is_used(self):
        names = re.findall(r"^GROVE_TUNABLE\(\w+, (\w+),",
                           (ROOT / "src/model/tunables.def").read_text(), re.M)
        code = "".join(text for _, text in self.sources("src", "mpi"))
        self.assertTrue(names)
        self.assertEqual([n for n in names if not re.search(rf"\btuning(?:_|\(\))?\.{n}\b", code)], [])

    def test_every_folder_is_a_known_layer(self):
        for folder in (ROOT / "src").iterdir():
            if folder.is_dir():
                self.assertIn(folder.name, LAYERS, folder)

    def test_only_the_public_interface_is_in_include(self):
        for path in (ROOT / "include").rglob("*"):
            if path.is_file() and path.name != "README.md":
                self.assertEqual(path.parent, ROOT / "include/grove", path)
                self.assertTrue(path.name.endswith((".hpp", ".hpp.in")), path)

    def test_public_interface_includes_no_other_header(self):
        for path, text in self.sources("include"):
            self.assertEqual(includes(text), set(), path)

    def test_headers_are_included_by_the_folder_of_their_layer(self):
        for path, text in self.sources("src", "mpi"):
            self.assertEqual(re.findall(r'#\s*include\s*"(?:src/\S+|\w+\.h)"', text), [], path)

    def test_private_headers_are_those_that_only_their_layer_includes(self):
        used_by = {}
        for path, text in self.sources("src", "mpi", "tools", "tests", "benchmarks", "python"):
            first, second = (*path.relative_to(ROOT).parts, "")[:2]
            layer = second if first in ("src", "tests") else first
            for header in includes(text):
                used_by.setdefault(header, set()).add(layer)
        marked = []
        for path in [*(ROOT / "src").rglob("CMakeLists.txt"), *(ROOT / "mpi").rglob("CMakeLists.txt")]:
            marked += [as_included(path.parent / header) for header in private_headers(path.read_text())]
        headers = [as_included(path) for path, _ in self.sources("src", "mpi", suffixes={".h"})]
        private = [header for header in headers if used_by.get(header, set()) <= {header.split("/")[0]}]
        self.assertEqual(sorted(marked), sorted(private))

    def test_includes_never_point_back(self):
        for layer in LAYERS:
            for path, text in self.layer_sources(layer):
                self.assertFalse(points_back(layer, layers_of(includes(text))), path)

    def test_a_layer_includes_only_what_it_declares(self):
        declared = self.declared()
        for layer in declared:
            for path, text in self.layer_sources(layer):
                self.assertLessEqual(layers_of(includes(text)), closure(layer, declared), path)

    def test_declared_dependencies_never_point_back(self):
        for layer, depends in self.declared().items():
            for other in depends:
                self.assertLess(LAYERS.index(other), LAYERS.index(layer), f"{layer} -> {other}")

    def test_only_mpi_names_mpi(self):
        for path, text in self.sources("include", "src", "tools", "tests", "benchmarks"):
            if (ROOT / "tests/mpi") not in path.parents and path != ROOT / "include/grove/mpi.hpp":
                self.assertFalse(names_mpi(text), path)

    def test_no_two_files_define_one_type(self):
        defined_in = {}
        for path, text in self.sources("include", "src", "mpi", "tools", "tests", "benchmarks"):
            for name in named_types(text, path.suffix != ".cpp"):
                self.assertEqual(defined_in.setdefault(name, path), path, name)

    def test_libraries_neither_end_the_process_nor_print(self):
        for path, text in self.sources("include", "src"):
            self.assertFalse(forbidden(text), path)

    def test_documents_name_existing_files(self):
        documents = [path for path in [*ROOT.glob("*.md"), *ROOT.glob("*/**/*.md")]
                     if not {"build", "results"} & set(path.relative_to(ROOT).parts)]
        there = ["/" + str(path.relative_to(ROOT)) for folder in (*CODE_FOLDERS, "cmake", "docs", "cluster")
                 for path in (ROOT / folder).rglob("*.*")]
        for document in documents:
            for name in named_files(document.read_text(encoding="utf-8")):
                self.assertTrue(any(path.endswith("/" + name) for path in there), (document, name))

    def test_every_source_has_the_license_line(self):
        scripts = (path for folder in CODE_FOLDERS for path in (ROOT / folder).rglob("*")
                   if path.is_file() and path.suffix == "" and path.read_bytes()[:2] == b"#!")
        paths = [path for path, _ in self.sources(*CODE_FOLDERS, "cmake",
                                                  suffixes=CPP | {".cmake", ".py", ".sh"})]
        for path in [*paths, *scripts, *ROOT.glob("*/**/CMakeLists.txt"), ROOT / "CMakeLists.txt"]:
            if (ROOT / "build") not in path.parents:
                self.assertTrue(has_license(path.read_text(encoding="utf-8")), path)


class TheChecks(unittest.TestCase):
    """Tests the checks themselves."""

    def test_includes_are_found(self):
        self.assertEqual(includes('#include "io/x.h"\n#include <vector>\n#include "tests/y.h"\n'), {"io/x.h"})
        self.assertEqual(layers_of({"io/x.h", "mpi/batch/y.h"}), {"io", "mpi"})
        self.assertEqual(points_back("io", {"model", "io", "search"}), {"search"})

    def test_forbidden_calls_are_found(self):
        for text in ["exit(1);", "std::abort();", "std::cout << 1;", "std::fprintf(stderr, \"\");",
                     "printf(\"\");", "fmt::print(\"x\");", "int a;  // TODO: b"]:
            self.assertTrue(forbidden(text), text)
        for text in ["// exit(1)", "to_exit(1);", "std::snprintf(a, 3, \"\");", "queue.exit();",
                     "fmt::print(file, \"x\");", 'f("std::cout");', "1'000; exit_code(2);"]:
            self.assertFalse(forbidden(text), text)

    def test_mpi_calls_are_found(self):
        self.assertTrue(names_mpi("MPI_Send(x);"))
        self.assertFalse(names_mpi("int x;  // unlike MPI_Send"))

    def test_comments_and_strings_are_removed(self):
        self.assertEqual(without_comments_and_strings('a "b\\"c" d /* e\n */ f // g\n1\'0\'h'),
                         'a "" d \n f \n1\'0\'h')

    def test_type_definitions_are_found(self):
        text = """#define X {
            namespace grove { class A; class B final : public A { struct Inner {}; };
            template <class T> requires std::is_trivial_v<T> struct C { int x{}; };
            using D = B; enum class E : int { k }; void f() { struct Local {}; }
            namespace { struct Hidden {}; using X = B; }
            class B::F { }; struct B make() { return {}; } }
            namespace grove::fuzz { class A {}; } struct G {};"""
        types = ["grove::B", "grove::C", "grove::E", "grove::B::F", "grove::fuzz::A", "G"]
        self.assertEqual(named_types(text, False), types)
        self.assertEqual(named_types(text, True), types[:2] + ["grove::D"] + types[2:])

    def test_dependencies_are_found(self):
        cmake = "grove_layer(b SOURCES x.cpp DEPENDS a model\n LINK_PUBLIC y)\n# grove_layer(c)\n"
        self.assertEqual(declared_depends(cmake), {"b": ["a", "model"]})
        self.assertEqual(declared_depends("grove_layer(a SOURCES x)"), {"a": []})
        self.assertEqual(closure("c", {"c": ["b"], "b": ["a"]}), {"a", "b", "c"})

    def test_private_headers_are_found(self):
        cmake = "grove_private_headers(io\n  a.h b.h)  # c.h\ngrove_layer(io)\ngrove_private_headers(x s/d.h)"
        self.assertEqual(private_headers(cmake), ["a.h", "b.h", "s/d.h"])

    def test_named_files_are_found(self):
        text = "`search/global_bounds.cpp`, `./a.py`; `conflicts/mine.cpp`, `x_test.cpp`, `FILE.map`, a.cpp"
        self.assertEqual(named_files(text), ["search/global_bounds.cpp", "a.py"])

    def test_license_line_is_found(self):
        self.assertTrue(has_license("#!/bin/sh\n# SPDX-License-Identifier: MIT\n"))
        self.assertFalse(has_license("int a;\n"))


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
