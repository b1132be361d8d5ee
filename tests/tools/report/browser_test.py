#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens reports in Chromium and checks that they send no requests, log no errors and show their figures.

    browser_test.py GROVE

Exit codes: 0 passed, 1 failed, 77 skipped because Chromium is not installed.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parent.parent)]

import synthetic  # noqa: E402
from devtools import CHROMIUM, Chromium, is_blank, shares  # noqa: E402

GROVE = Path("build/release/bin/grove")
SKIPPED = 77
LINE_COLOUR = (0x00, 0x72, 0xB2)  # colour of the first method in every figure


def rows():
    """Returns only a few rows, because each map and number of agents adds a panel to draw."""
    found = synthetic.rows(1, maps=("room-32-32-4",), agents=(5,), tasks=(10, 30))
    return [row for row in found if row["method"] in ("auto", "cts-cbs-a", "hcbs") or row["problem"] == "cts"]


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Chromium())

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def visit(self, page):
        return self.browser.visit(page, size=(1280, 2400))

    def page(self, text):
        path = self.folder / "page.html"
        path.write_text(text, encoding="utf-8")
        return path

    def report(self, found):
        synthetic.write_jsonl(self.folder / "results.jsonl", found)
        subprocess.run([str(GROVE), "report", str(self.folder), "-o", str(self.folder / "out")], check=True)
        return self.folder / "out/report.html"

    def test_report_shows_figures_and_contradictions(self):
        def red(picture):
            return shares(picture).get((0xC0, 0, 0), 0)
        found = rows()
        page_visit = self.visit(self.report(found))
        self.assertEqual(page_visit.console, [])
        self.assertEqual(page_visit.requests, [])
        self.assertFalse(is_blank(page_visit.picture))
        self.assertGreater(shares(page_visit.picture).get(LINE_COLOUR, 0), 2e-4, "no figure is visible")
        # Dark text on a light page.
        self.assertGreater(shares(page_visit.picture)[255, 255, 255], 0.5)
        self.assertEqual(red(page_visit.picture), 0)
        # The warning about a contradiction is visible without scrolling.
        found = [row for row in found if row["problem"] == "mg" and row["solved"]]
        found += [row | {"method": "x", "status": "optimal", "cost": 1} for row in found]
        self.assertGreater(red(self.visit(self.report(found)).picture), 0.05)

    def test_false_claim_is_visible_and_figures_fit_400_pixels(self):
        found = list(synthetic.solver_rows(1, agents=(20, 60)))
        found[3] |= {"status": "invalid", "solved": False, "cost": None,
                     "error": "the plan is wrong: agents 3 and 7 collide"}
        page = self.report(found)
        page_visit = self.browser.visit(page, size=(400, 2400))
        self.assertEqual((page_visit.console, page_visit.requests), ([], []))
        self.assertGreater(shares(page_visit.picture).get((0xC0, 0, 0), 0), 0.05)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 400)

    def test_console_messages_are_detected(self):
        for script in ("console.error('boo')", "noSuchFunction()"):
            self.assertEqual(len(self.visit(self.page(f"<p>x</p><script>{script}</script>")).console), 1)
        refused = "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'\">"
        self.assertTrue(self.visit(self.page(refused + "<img src='http://example.invalid/x.png'>")).console)

    def test_network_requests_are_detected(self):
        self.assertEqual(self.visit(self.page("<img src='http://example.invalid/x.png'>")).requests,
                         ["http://example.invalid/x.png"])

    def test_blank_page_is_detected(self):
        self.assertTrue(is_blank(self.visit(self.page("")).picture))
        self.assertFalse(is_blank(self.visit(self.page("<p>Some words are not nothing.</p>" * 9)).picture))


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        GROVE = Path(sys.argv.pop(1)).resolve()
    if CHROMIUM is None:
        print("skipped: there is no chromium-headless-shell and no chromium")
        sys.exit(SKIPPED)
    unittest.main()
