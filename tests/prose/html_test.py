#!/usr/bin/python3
"""The manual as HTML: it builds without a warning, its search finds words, and nothing in it needs the
network, so that it works from disk. Exit code 77 where Sphinx is absent.
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


class Html(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.html = Path(cls.folder.name) / "manual"
        built = subprocess.run([ROOT / "tools/manual", "--no-install", cls.html], capture_output=True, text=True)
        if built.returncode == 77:
            print(built.stderr.strip())
            sys.exit(77)
        cls.said = built.stderr
        cls.code = built.returncode

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_builds_without_a_warning(self):
        self.assertEqual((self.code, self.said), (0, ""))

    def test_every_page_is_there_and_in_the_search(self):
        index = (self.html / "searchindex.js").read_text(encoding="utf-8")
        for page in (ROOT / "assets/manual").glob("*.md"):
            self.assertTrue((self.html / (page.stem + ".html")).exists(), page)
            self.assertIn(f'"{page.stem}"', index)
        for word in ["youngs_modulu", "quaternion", "winsoris"]:  # as the search's stemmer leaves them
            self.assertIn(word, index)

    def test_nothing_comes_from_the_network(self):
        for page in self.html.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            self.assertEqual(re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="https?:[^"]*"', text), [], page)

    def test_all_that_pages_ask_for_lies_beside(self):
        for page in self.html.glob("*.html"):
            text = page.read_text(encoding="utf-8")
            for asked in re.findall(r'(?:src|href)="((?:_static|_images)/[^"?#]+)', text):
                self.assertTrue((self.html / asked).exists(), f"{page.name}: {asked}")

    def test_options_keep_both_dashes(self):
        text = (self.html / "settings.html").read_text(encoding="utf-8")
        self.assertIn("also --duration", text)
        self.assertNotIn("\u2013duration", text)

    def test_formulas_are_drawn(self):
        text = (self.html / "theory_rods.html").read_text(encoding="utf-8")
        self.assertIn('<span class="math', text)
        self.assertIn('<div class="math', text)
        self.assertIn("_static/katex.min.js", text)
        self.assertIn("katex.render(", text)


if __name__ == "__main__":
    unittest.main()
