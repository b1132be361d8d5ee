#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that doxygen, which generates the API pages, finds every public entity of include/grove/*.hpp documented.

    api_pages_test.py SOURCE_DIR DOXYFILE DOXYGEN

Exits with code 77 if doxygen is not installed.
"""
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SOURCE, DOXYFILE, DOXYGEN = (None,) * 3
UNDOCUMENTED = {"a function": "void nothing();", "a member": "/// A.\nstruct A { int x = 0; };",
          "a class": "class GROVE_API C {\n public:\n  /// A.\n  int x = 0;\n};",
          "a macro": "#define GROVE_D 1"}


def make(*lines, pages="*.html"):
    """Runs doxygen with the Doxyfile and the additional `lines`. Returns (exit code, warnings, {name of a page:
    text})."""
    with tempfile.TemporaryDirectory() as folder:
        configuration = "\n".join([DOXYFILE.read_text(), f"OUTPUT_DIRECTORY = {folder}", *lines])
        done = subprocess.run([DOXYGEN, "-"], input=configuration, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr, {path.name: path.read_text(encoding="utf-8")
                                              for path in Path(folder).rglob(pages)}


def undocumented_values(text):
    """Returns the enumerators without a comment in doxygen's XML. Doxygen does not warn about them."""
    values = xml.etree.ElementTree.fromstring(text).iter("enumvalue")
    return [value.findtext("name") for value in values
            if not any("".join(value.find(kind).itertext()).strip()
                       for kind in ("briefdescription", "detaileddescription"))]


class Pages(unittest.TestCase):
    def test_pages_of_all_public_headers_are_made_without_warnings(self):
        code, complaints, pages = make()
        self.assertEqual((code, complaints), (0, ""))
        self.assertIn("Grove from C++", pages["index.html"])
        for header in [*(SOURCE / "include/grove").glob("*.hpp"), Path("version.hpp")]:
            self.assertIn(header.name.replace(".", "_8") + ".html", pages)
        self.assertIn("from_rows", pages["classgrove_1_1World.html"])
        self.assertFalse([name for name in pages if "detail" in name or "Access" in name])

    def test_every_enumerator_is_documented(self):
        _, _, pages = make("GENERATE_XML = YES", pages="namespacegrove.xml")
        text = pages["namespacegrove.xml"]
        self.assertIn("<name>infeasible</name>", text)
        self.assertEqual(undocumented_values(text), [])
        value = "<enumvalue><name>{}</name><briefdescription>{}</briefdescription><detaileddescription/></enumvalue>"
        self.assertEqual(undocumented_values(f"<x>{value.format('a', '<para>A.</para>')}{value.format('b', '')}</x>"),
                         ["b"])

    def test_undocumented_entities_are_refused(self):
        for what, text in UNDOCUMENTED.items():
            with tempfile.TemporaryDirectory() as folder:
                header = Path(folder) / "x.hpp"
                header.write_text(f"/// \\file\n/// X.\n/// Y.\nnamespace grove {{\n{text}\n}}\n")
                code, complaints, _ = make(f"INPUT = {header}", "USE_MDFILE_AS_MAINPAGE =")
                self.assertNotEqual(code, 0, what)
                self.assertIn("is not documented", complaints, what)


if __name__ == "__main__":
    SOURCE, DOXYFILE, DOXYGEN = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    del sys.argv[1:]
    if not DOXYGEN:
        print("skipped: doxygen is not installed")
        sys.exit(77)
    unittest.main()
