"""observe makes an experiment; validate, fit and diagnose read it; results are typed."""

import os
import shutil
import unittest

import pedicel
from given import Case

STEM = """format: pedicel-plant
version: 1
name: rod
material: {youngs_modulus: 2.0e+8, poisson_ratio: 0.35, density: 900, damping_time: 0.004}
sampling: {connect: 0.01, distance: 0.05}
root: [0, 0, 0]
curves:
  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.4]], radius: 0.003}
"""

EXPERIMENT = """format: pedicel-experiment
version: 1
title: a rod, loaded and let go
plant: plant.yaml
markers:
  - {name: m1, curve: stem, at: 0.5}
  - {name: m2, curve: stem, at: 1.0}
trials:
  - name: load
    folder: load
    drive:
      - {kind: load, curve: stem, at: 1.0, force: [0.05, 0, 0], from: 0.1, to: 0.5}
  - name: other
    folder: other
    drive:
      - {kind: load, curve: stem, at: 1.0, force: [0, 0.04, 0], from: 0.1, to: 0.5}
"""


class ExperimentsTest(Case):
    def plan(self):
        folder = os.path.join(self.folder, "plan")
        for trial in ("load", "other"):
            os.makedirs(os.path.join(folder, trial))
            rows = "".join(f"{i * 0.01:.2f},,,,,,\n" for i in range(101))
            self.write(f"plan/{trial}/markers.csv", "time,m1.x,m1.y,m1.z,m2.x,m2.y,m2.z\n" + rows)
        self.write("plan/plant.yaml", STEM)
        self.write("plan/experiment.yaml", EXPERIMENT)
        return folder

    def test_a_wrong_modulus_is_found(self):
        plan, out = self.plan(), os.path.join(self.folder, "measured")
        stiffer = self.write("stiffer.plant.yaml", STEM.replace("2.0e+8", "2.6e+8"))
        observed = pedicel.observe(stiffer, plan, out, noise_position=2e-4, seed=3)
        self.assertEqual((observed.folder, observed.trials), (out, ["load", "other"]))
        shutil.copy(os.path.join(plan, "plant.yaml"), os.path.join(out, "plant.yaml"))
        good = pedicel.validate(observed)
        self.assertTrue(good, good.text)

        fit = pedicel.fit(out, ["youngs_modulus"], out=os.path.join(self.folder, "fit"))
        found = fit["youngs_modulus"]
        self.assertIsInstance(found, pedicel.FittedParameter)
        value = found.value if found.value < 10 else found.value / 2.0e8
        self.assertAlmostEqual(value, 1.3, delta=0.03)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "fit", "fitted.plant.yaml")))

        verdict = pedicel.diagnose(out, out=os.path.join(self.folder, "diagnosis"))
        self.assertIsInstance(verdict, pedicel.Verdict)
        self.assertEqual((verdict.verdict, verdict.names), ("named", ["youngs_modulus"]), verdict.data)
        factor = verdict.causes[0].parameters["factor"]
        self.assertTrue(factor.low < 1.3 < factor.high or abs(factor.value - 1.3) < 0.03, factor)
        self.assertTrue(verdict.causes[0].because)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "diagnosis", "report.html")))

    def test_validate_has_the_places(self):
        bad = self.write("bad.plant.yaml", STEM.replace("density: 900", "density: -3"))
        found = pedicel.validate(bad, self.plant)
        self.assertFalse(found)
        self.assertEqual([(d.file, d.line, d.severity) for d in found.diagnostics
                          if d.severity == "error"], [(bad, 4, "error")])
        self.assertTrue(pedicel.validate(self.plant, self.scene))

    def test_an_experiment_that_is_not_there(self):
        with self.assertRaises(pedicel.InvalidFile):
            pedicel.diagnose(os.path.join(self.folder, "nothing"))
        with self.assertRaises(pedicel.UsageError):
            pedicel.fit(self.plan(), ["no_such_parameter"])


if __name__ == "__main__":
    unittest.main()
