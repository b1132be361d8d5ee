#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that links between documents have existing targets, that docs/README.md lists all pages, and that the README
is short.

    links_test.py [ROOT]   checks the documents of the tree at ROOT, by default this one
"""
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README_BYTES = 8000
COLUMNS = 80
FENCE = re.compile(r"^(```|~~~).*?^\1[ ]*$", re.M | re.S)
LINK = re.compile(r"\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)|^\[[^\]]+\]:\s*(\S+)|(?:src|href)=\"([^\"]+)\"", re.M)


def prose(document):
    """Returns the document without inline code and with code blocks replaced by empty lines."""
    without_blocks = FENCE.sub(lambda block: "\n" * block.group().count("\n"), document)
    return re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", "", without_blocks)


def links(document):
    return [next(filter(None, groups)) for groups in LINK.findall(prose(document))]


def anchor(heading):
    """Returns GitHub's anchor for a heading: lower case, spaces as '-', no punctuation except '-' and '_'."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def anchors(document):
    found = []
    for heading in re.findall(r"^#{1,6} +(.+?) *#*$", FENCE.sub("", document), re.M):
        name = anchor(heading)
        times = sum(re.fullmatch(rf"{re.escape(name)}(-\d+)?", other) is not None for other in found)
        found.append(f"{name}-{times}" if times else name)
    return {*found, *re.findall(r"<a (?:name|id)=\"([^\"]+)\"", document)}


def dead(link, page, root):
    """Returns the reason if a link in `page` has no target, otherwise None. Does not check links to other hosts."""
    if re.match(r"[a-z][a-z0-9+.-]*:", link):
        return None
    target, _, name = link.partition("#")
    path = (page.parent / target).resolve() if target else page
    if not path.is_relative_to(root) or not path.exists():
        return f"no {target}"
    if name and path.suffix == ".md" and name not in anchors(path.read_text(encoding="utf-8")):
        return f"no heading '{name}' in {path.relative_to(root)}"
    return None


def documents():
    return [path for path in sorted([*ROOT.glob("*.md"), *ROOT.glob("*/**/*.md")])
            if path.relative_to(ROOT).parts[0] != "build"]


class TheTree(unittest.TestCase):
    def test_links_have_targets(self):
        for page in documents():
            for link in links(page.read_text(encoding="utf-8")):
                with self.subTest(page=str(page.relative_to(ROOT)), link=link):
                    self.assertIsNone(dead(link, page, ROOT))

    def test_index_lists_every_page(self):
        index = ROOT / "docs/README.md"
        listed = {(index.parent / link.partition("#")[0]).resolve()
                  for link in links(index.read_text(encoding="utf-8")) if ":" not in link}
        for page in (ROOT / "docs").glob("*.md"):
            self.assertIn(page, listed | {index})

    def test_readme_is_short(self):
        self.assertLess(len((ROOT / "README.md").read_bytes()), README_BYTES)

    def test_readme_fits_a_terminal(self):
        wide = [line for line in (ROOT / "README.md").read_text(encoding="utf-8").splitlines() if len(line) > COLUMNS]
        self.assertEqual(wide, [])


class TheChecks(unittest.TestCase):
    """Tests the checks themselves."""

    def test_links_are_found(self):
        text = "[a](b.md#c) ![d](e.svg) `[f](g)` ``[h](`i`)``\n```sh\n[j](k)\n```\n" \
            "<img src=\"l.png\"> [m](<n> \"o\")\n[p]: q\n"
        self.assertEqual(links(text), ["b.md#c", "e.svg", "l.png", "n", "q"])

    def test_anchors_are_found(self):
        text = "# One `--two`, three!\n```\n# not this\n```\n" \
            "## [Four](x.md) & *five*\n## One\n## One\n### One\n<a id=\"six\"></a>\n"
        self.assertEqual(anchors(text), {"one---two-three", "four--five", "one", "one-1", "one-2", "six"})

    def test_dead_links_are_found(self):
        page = ROOT / "README.md"
        for link in ("https://nowhere.example", "docs/README.md", "docs"):
            self.assertIsNone(dead(link, page, ROOT))
        for link in ("docs/none.md", "#no-such-heading", "docs/README.md#no-such-heading", "../outside.md"):
            self.assertIsNotNone(dead(link, page, ROOT), link)


if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        ROOT = Path(sys.argv.pop(1)).resolve()
    unittest.main()
