#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests `grove view --proof` in a browser, with certificates of grove solve, deep certificates, and hostile names.

    proof_page_test.py GROVE
"""
import json
import re
import subprocess

import pages
from pages import CHOSEN

ALERT = '<script>document.title = "owned"</script>'
LEMMAS = "lemma 9 0 1\ndemand 0 bar 1 2 inf\nsplit 0 bar 2 2 2 | 1 bar 2 2 2\nleaf\nleaf\n"


class ProofPages(pages.PageTest):
    def run_grove(self, *words):
        return subprocess.run([self.grove, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              check=True)

    def proof_page(self, instance, certificate, *words):
        self.run_grove("view", instance, "--proof", certificate, *words)
        return self.folder / f"{certificate.name}.html"

    def solved_page(self, name):
        """Solves an instance, opens the page with its plan and certificate as the README shows, and returns the
        cost."""
        instance = pages.DATA / f"{name}.cts.json"
        self.run_grove("solve", instance, "--omega", 0, "--threads", 1, "--quiet", "--proof", "c.proof", "-o", "p.json")
        self.browser.open(self.proof_page(instance, self.folder / "c.proof", "p.json"))
        return json.loads((self.folder / "p.json").read_text())["cost"]

    def written(self, instance, text):
        """Writes an uncompressed certificate of the instance, with its head and these lines, and returns its path."""
        refused = self.folder / "none.proof"
        refused.write_text("grove-proof 1\ninstance 0\n")
        done = subprocess.run([self.grove, "view", instance, "--proof", refused], capture_output=True, text=True)
        checksum = re.search(r"expected ([0-9a-f]{16}), the checksum", done.stderr)[1]
        certificate = self.folder / "w.proof"
        certificate.write_text(f"grove-proof 1\ninstance {checksum}\nfollowing yes\n{text}end\n")
        return certificate

    def text(self, selector="body"):
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def corridor(self, name="a"):
        return self.grid(4, 2,
                         [{"id": name, "start": [0, 0], "goal": [3, 0]}, {"id": "b", "start": [3, 0], "goal": [0, 0]}],
                         [{"id": "t", "cell": [1, 1], "agents": [name]}])

    def chosen_row(self):
        return self.text(".tree [aria-selected=true] .what")

    def test_certificate_of_a_run_is_shown(self):
        cost = self.solved_page("rooms-32x32_n10_m30")
        self.assertRegex(self.text(".strip"), f"No plan costs less than {cost:,}\\s+"
                         r"proven by \d+ splits, \d+ leaves and \d+ lemmas\s+"
                         f"p.json costs {cost:,}, so it is optimal")
        self.assertIn("grove-verify rooms-32x32_n10_m30.cts.json c.proof", self.text(".strip"))
        leaves = self.evaluate("grove.app.statement.steps.filter((s) => s.kind === 'leaf').length")
        self.assertIn(f"{leaves} leaves", self.text(".strip"))
        self.assertEqual(leaves, self.evaluate("grove.app.rows.filter((s) => s.kind === 'leaf').length"))
        self.assertNotIn("does not permit this split", "".join(self.every_split()))
        for size in ((390, 844), (2560, 1440)):
            self.browser.resize(*size)
            self.browser.settle()
            self.assertEqual(self.evaluate("document.documentElement.scrollWidth <= innerWidth"), True)
        self.assert_silent()

    def every_split(self):
        """Returns the details of each split, including splits in proofs of lemmas."""
        return self.evaluate("""[...grove.app.certificate.lemmas, grove.app.certificate.theorem].flatMap((statement) =>
          (grove.app.show(statement), statement.steps).filter((step) => step.children.length > 0).map((step) =>
            (grove.app.select(step), document.querySelector(".details").textContent)))""")

    def test_places_of_the_step_are_marked_on_the_map(self):
        self.solved_page("rooms-32x32_n10_m30")
        for step in range(3):
            self.evaluate(f"grove.app.select(grove.app.statement.steps[{step}])")
            self.browser.settle()
            self.browser.settle()
            for colour in self.colours_of_places():
                self.assertEqual(tuple(colour), CHOSEN)

    def colours_of_places(self):
        """Returns the colours at the left edges of the places that are marked for the constraints of the current
        step."""
        return self.evaluate("""(() => {
          const {camera, element} = grove.stages[0];
          const canvas = element.querySelector("canvas");
          const c = canvas.getContext("2d");
          const {world} = grove.app.model;
          const {step} = grove.app;
          const constraints = step.sides.length > 0 ? step.sides : [step.above.step.sides[step.above.side]];
          return constraints.flatMap(({places}) => places).map((place) => {
            const at = camera.toView(world.xs[place], world.ys[place]);
            const left = at.x - Math.max(5, 0.46 * camera.scale);
            return [...c.getImageData(left, at.y + 4, 1, 1).data].slice(0, 3);
          });
        })()""")

    def test_keys_select_and_fold_the_tree(self):
        instance = self.corridor()
        certificate = self.written(instance, LEMMAS + "theorem 8\nsplit 0 bar 1 1 1 | 1 bar 1 1 1\nleaf\n"
                                   "later 0 3 1 4 0\nleaf 0\nleaf\n")
        self.browser.open(self.proof_page(instance, certificate))
        self.assertIn("proven by 2 splits, 3 leaves and 1 lemma", self.text(".strip"))
        self.assertEqual(len(self.texts(".tree .row")), 5)
        self.evaluate("document.querySelector('.tree [tabindex=\"0\"]').focus()")
        for key, row in (("ArrowDown", "a is not on [1, 0] at 1"), ("ArrowDown", "b is not on [1, 0] at 1"),
                         ("ArrowRight", "a costs more than 3"), ("End", "b costs more than 4"),
                         ("ArrowLeft", "b is not on [1, 0] at 1")):
            self.browser.key(key)
            self.assertEqual(self.chosen_row(), row)
        self.assertIn("Otherwise a and b together cost at most 7, and by lemma 0 they cost more.",
                      self.text(".details"))
        self.browser.key("ArrowLeft")
        self.assertEqual(len(self.texts(".tree .row")), 3)
        self.press("Fold all")
        self.assertEqual(self.texts(".tree .row"), ["▸All plans3 leaves"])
        self.press("Unfold all")
        self.assertEqual(len(self.texts(".tree .row")), 5)
        self.evaluate("grove.app.choose(1)")
        self.assertEqual(self.texts(".tree .of .what"), ["b is not on [1, 0] at 1", "b costs more than 4"])
        self.assert_silent()

    def test_lemma_opens_and_closes(self):
        instance = self.corridor()
        self.browser.open(self.proof_page(instance, self.written(instance, LEMMAS + "theorem 8\nleaf 0\n")))
        self.assertIn("the excess by lemma 0: together 8 or more", self.text(".details"))
        self.press("lemma 0")
        self.assertIn("In plans that satisfy its constraints a and b together cost 9 or more.", self.text(".details"))
        self.assertIn("a is not on [1, 0] from 2 on", self.text(".details"))
        self.assertEqual(self.texts(".tree .what"),
                         ["All plans that satisfy its constraints", "a is not on [2, 0] at 2",
                           "b is not on [2, 0] at 2"])
        self.press("Back to the theorem")
        self.press("Lemmas (1)")
        self.assertEqual(self.evaluate("document.querySelector('.tree').checkVisibility()"), False)
        self.press("0: a and b together cost 9 or more")
        self.assertIn("Lemma 0", self.text(".details"))
        self.assertIn("All plans that satisfy its constraints", self.text(".tree"))
        self.assert_silent()

    def test_proofs_without_a_tree_are_shown(self):
        instance = self.corridor()
        self.browser.open(self.proof_page(instance, self.written(instance, "theorem inf\njoint\n")))
        self.assertIn("There is no plan", self.text(".strip"))
        self.assertIn("all joint paths of a and b that satisfy the constraints: there are none", self.text(".details"))
        self.browser.open(self.proof_page(instance, self.written(
            instance, "theorem 6\nprices\nplace 1 1 500\nedge 1 2 2 100\nfinish 0 3 1 3 7\nend\n")))
        self.assertIn("proven by 3 multipliers", self.text(".strip"))
        self.assert_silent()

    def test_invalid_split_is_reported(self):
        instance = self.corridor()
        self.browser.open(self.proof_page(instance, self.written(
            instance, "theorem 8\nsplit 0 bar 1 1 1 | 1 bar 2 1 1\nleaf\nleaf\n")))
        self.assertIn("docs/proof.md does not permit this split", self.text(".details"))

    def test_deep_certificate_is_shown(self):
        instance = self.corridor()
        proof = "theorem 8\n" + "split 0 bar 1 1 1 | 1 bar 1 1 1\nleaf\n" * 5000 + "leaf\n"
        seconds = self.browser.open(self.proof_page(instance, self.written(instance, proof)))
        self.assertLess(len(self.texts(".tree .row")), 100)
        self.press("Unfold all")
        self.assertEqual(len(self.texts(".tree .row")), 10001)
        print(f"5,000 splits, each below the one before: loaded in {seconds:.2f} s")
        self.assert_silent()

    def test_names_are_not_markup(self):
        instance = self.corridor(ALERT)
        self.browser.open(self.proof_page(instance, self.written(instance, LEMMAS + "theorem 8\nleaf 0\n")))
        self.press("lemma 0")
        self.assertIn("<script>document.title", self.text(".tree"))
        self.assertNotEqual(self.evaluate("document.title"), "owned")
        self.assert_silent()


if __name__ == "__main__":
    pages.main()
