#!/usr/bin/python3
"""No file but its own knows an effect of plants or measurements by name."""

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from house_checks import plant_effects, source  # noqa: E402


class PlantEffects(unittest.TestCase):
    def test_the_tree(self):
        texts = {path: (ROOT / path).read_text(encoding="utf-8") for path in source.files(ROOT)}
        self.assertGreater(len(plant_effects.effects_of(texts)), 30)
        self.assertEqual(plant_effects.check(texts), [])

    def test_a_name_in_another_file(self):
        own = Path("plugins/effects/creep.cpp")
        other = Path("plugins/discrepancy/fit/causes.cpp")
        texts = {
            own: 'd.name = "creep";\n',
            Path("plugins/effects/density.cpp"): "",
            Path("plugins/effects/relaxation.cpp"): 'd.limits = {{"time", true, "creep"}};\n',
            other: '// "creep" in a comment\nif (name == "density") a = "creep and more";\nif (name == "creep") b();\n',
            Path("tests/unit/a_test.cpp"): 'effect("creep");\n',
            Path("plugins/cosserat/laws/terms.h"): '{"creep", 1}\n',
        }
        said = "names the effect {}; expected a field of its definition"
        self.assertEqual(plant_effects.check(texts),
                         [(str(other), 2, said.format("density")), (str(other), 3, said.format("creep"))])

    def test_a_key_of_files_outside_the_diagnosis(self):
        texts = {
            Path("plugins/effects/density.cpp"): "",
            Path("plugins/plant/plant_reader.cpp"): 'read("density");\n',
        }
        self.assertEqual(plant_effects.check(texts), [])


if __name__ == "__main__":
    unittest.main()
