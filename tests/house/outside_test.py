#!/usr/bin/python3
"""A clone has all that it needs: no scene and no comment leans on what lies beside it."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from house_checks import outside, source  # noqa: E402


def texts_of(paths):
    return {path: (ROOT / path).read_text(encoding="utf-8") for path in paths}


class Outside(unittest.TestCase):
    def test_no_source_names_a_page_elsewhere(self):
        tests = [path.relative_to(ROOT) for end in ("h", "cpp") for path in (ROOT / "tests").rglob(f"*.{end}")]
        self.assertEqual(outside.check_pages(texts_of(source.files(ROOT) + tests)), [])

    def test_shipped_scenes_lie_whole_in_the_tree(self):
        scenes = [path.relative_to(ROOT) for path in (ROOT / "assets/scenes").glob("*.yaml")]
        self.assertGreater(len(scenes), 8)
        self.assertEqual(outside.check_scenes(texts_of(scenes), ROOT), [])

    def test_faults_are_seen(self):
        text = {Path("a.h"): "// A time.\n// As section 1 of the formats says, and habit 9.\n"}
        self.assertEqual([line for _, line, _ in outside.check_pages(text)], [2, 2])
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder) / "clone"
            (root / "scenes").mkdir(parents=True)
            (root / "there.urdf").write_text("")
            (Path(folder) / "beside.mtg").write_text("")
            scene = "plants:\n  - {name: a, file: ../../beside.mtg}\nrobot:\n  file: ../there.urdf\n  # file\nbody: {mesh: gone.obj}\n"
            self.assertEqual(outside.check_scenes({Path("scenes/a.scene.yaml"): scene}, root),
                             [("scenes/a.scene.yaml", 2, "../../beside.mtg lies outside the repository"),
                              ("scenes/a.scene.yaml", 6, "gone.obj is not there")])


if __name__ == "__main__":
    unittest.main()
