"""What the tests of the module have in common: a small plant, a scene around it, the program."""

import json
import os
import subprocess
import tempfile
import unittest

import pedicel

PROGRAM = os.environ["PEDICEL_PROGRAM"]
PULL_UP = pedicel.asset("scenes/cherry_tomato_pull_up.scene.yaml")

PLANT = """format: pedicel-plant
version: 1
name: twig
material: {youngs_modulus: 2.0e+7, poisson_ratio: 0.35, density: 700, damping_time: 0.01}
sampling: {connect: 0.01, distance: 0.02}
root: [0, 0, 0]
curves:
  - {name: stem, points: [[0, 0, 0], [0, 0, 0.15], [0.02, 0, 0.3]], radius: 0.003}
fruits:
  - {name: berry, curve: stem, at: 1.0, radius: 0.01, density: 950, detach: {force: 0.5}}
"""

SCENE = """format: pedicel-scene
version: 1
name: twig
purpose: a test
see: nothing
duration: 1
dt: 0.005
plants:
  - {name: twig, file: twig.plant.yaml}
ground: {height: 0}
cameras:
  - {name: side, eye: [0.8, -0.8, 0.3], target: [0, 0, 0.15], fov: 0.6}
"""


class Case(unittest.TestCase):
    """A test with a folder of its own that has a small scene."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.plant = self.write("twig.plant.yaml", PLANT)
        self.scene = self.write("twig.scene.yaml", SCENE)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def headless(self, scene, *options):
        """The result of a run off screen."""
        out = os.path.join(self.folder, "out")
        run = subprocess.run([PROGRAM, "--headless", scene, "--json", "--no-pictures", "--no-sweep",
                              "--quiet", "--out", out, *options], capture_output=True, text=True)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        return json.loads(run.stdout), out
