"""What varies is drawn as it says: the same for the same seed, within its bounds."""

import math
import unittest

import numpy as np

import pedicel
from given import Case

VARY = """
material.density: {distribution: uniform, low: 500, high: 900}
material.youngs_modulus: {distribution: lognormal, mean: 2.0e7, deviation: 1.0e7}
detach.force: {distribution: normal, mean: 1.0, deviation: 0.5, low: 0.2, high: 1.6}
rods.solver: {distribution: choice, values: [direct, position_based]}
"""


class VariationTest(Case):
    def test_the_same_seed_draws_the_same(self):
        vary = pedicel.Variation.parse(VARY)
        self.assertEqual(vary.keys, ["material.density", "material.youngs_modulus", "detach.force",
                                     "rods.solver"])
        self.assertEqual(vary.draw(3), pedicel.Variation.parse(VARY).draw(3))
        self.assertNotEqual(vary.draw(3), vary.draw(4))
        self.assertEqual(list(vary.draw(3)), vary.keys)

    def test_distributions_are_what_they_say(self):
        vary, n = pedicel.Variation.parse(VARY), 4000
        drawn = [vary.draw(seed) for seed in range(n)]
        density = [float(d["material.density"]) for d in drawn]
        self.assertTrue(500 <= min(density) and max(density) < 900)
        self.assertAlmostEqual(sum(density) / n, 700, delta=8)
        modulus = [float(d["material.youngs_modulus"]) for d in drawn]
        mean = sum(modulus) / n
        self.assertAlmostEqual(mean / 2e7, 1, delta=0.04)
        deviation = math.sqrt(sum((m - mean) ** 2 for m in modulus) / n)
        self.assertAlmostEqual(deviation / 1e7, 1, delta=0.12)
        self.assertGreater(min(modulus), 0)
        force = [float(d["detach.force"]) for d in drawn]
        self.assertTrue(0.2 <= min(force) and max(force) <= 1.6)
        share = sum(d["rods.solver"] == "direct" for d in drawn) / n
        self.assertAlmostEqual(share, 0.5, delta=0.04)

    def test_a_reset_takes_what_was_drawn(self):
        vary = pedicel.Variation.parse("material.density: {distribution: uniform, low: 500, high: 900}")
        sim, other = pedicel.Simulation(self.scene), pedicel.Simulation(self.scene)
        plain = sim.state_hash
        hashes = []
        for run in (sim, other):
            run.reset(seed=7, settings=vary.draw(7))
            run.set_force("twig/berry", [0.02, 0, 0])
            run.step(20)
            hashes.append(run.state_hash)
        self.assertEqual(hashes[0], hashes[1])
        key = next(k for k in sim.parameters if k.endswith("material.density"))
        self.assertAlmostEqual(sim.parameters[key].value, float(vary.draw(7)["material.density"]))
        sim.reset()
        self.assertEqual(sim.state_hash, plain)
        self.assertEqual(sim.parameters[key].value, 700)

    def test_lengths_and_sensors_vary_in_a_run_that_goes_on(self):
        sim, n = pedicel.Simulation(self.scene), len(pedicel.Simulation(self.scene).segment_names)
        lengths = []
        for factor in (0.8, 0.93, 1.0, 1.07, 1.21, 2.0):
            sim.reset(settings={"shape.length": factor, "shape.radius": 1.5, "cameras.side.noise.latency": 0.05})
            self.assertEqual(len(sim.segment_names), n)
            lengths.append(sim.positions[-1, 2] / factor)
        np.testing.assert_allclose(lengths, lengths[2], rtol=0.02)
        with self.assertRaisesRegex(pedicel.UsageError, "haze"):
            sim.reset(settings={"cameras.side.noise.haze": 1})

    def test_settings_that_make_other_rows_are_refused(self):
        sim = pedicel.Simulation(self.scene)
        start = sim.state_hash
        sim.step(5)
        with self.assertRaisesRegex(pedicel.UsageError, "other segments"):
            sim.reset(settings={"sampling.distance": 0.04})
        self.assertEqual((sim.state_hash, sim.steps), (start, 0))
        with self.assertRaisesRegex(pedicel.UsageError, "nonsense"):
            sim.reset(settings={"rods.nonsense": 1})

    def test_faults_have_a_place(self):
        path = self.write("bad.vary.yaml", "format: pedicel-variation\nversion: 1\nvary:\n"
                          "  material.density: {distribution: uniform, low: 900, high: 500}\n"
                          "  dt: {distribution: gauss, low: 1}\n"
                          "  detach.force: {distribution: normal, mean: 1}\n")
        with self.assertRaises(pedicel.InvalidFile) as raised:
            pedicel.Variation.read(path)
        self.assertEqual([d.line for d in raised.exception.diagnostics], [4, 5, 5, 6],
                         str(raised.exception))
        self.assertEqual(raised.exception.file, path)


if __name__ == "__main__":
    unittest.main()
