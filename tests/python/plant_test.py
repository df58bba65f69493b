"""Plants are built, edited, saved, and simulated."""

import copy
import os
import pickle
import unittest

import numpy as np

import pedicel
from given import PLANT, Case


def bush():
    plant = pedicel.Plant("bush", youngs_modulus=3e7)
    plant.add_stem("stem", [[0, 0, 0], [0, 0, 0.2], [0, 0.02, 0.4]], [0.004, 0.0035, 0.003])
    plant.add_stem("branch", [[0, 0, 0.2], [0.1, 0, 0.25]], 0.002, interpolation="linear")
    plant.add_fruit("plum", "branch", 1.0, 0.012, density=950, detach={"force": 2.0})
    plant.add_leaf("leaf_1", "stem", 0.7, "tomato", 0.06)
    return plant


class PlantTest(Case):
    def test_a_built_plant_stands_as_drawn(self):
        plant = bush()
        self.assertEqual((plant.stems, plant.fruits, plant.leaves), (["stem", "branch"], ["plum"], ["leaf_1"]))
        found = plant.check()
        self.assertGreater(found["segments"], 20)
        self.assertAlmostEqual(found["length"], 0.4 + 0.112, delta=0.01)
        sim = pedicel.Simulation(plant)
        start = sim.positions.copy()
        sim.step(50)
        self.assertLess(np.abs(sim.positions - start).max(), 1e-5)

    def test_a_saved_plant_is_the_same(self):
        plant = bush()
        path = os.path.join(self.folder, "bush.plant.yaml")
        plant.save(path)
        again = pedicel.Plant.load(path)
        self.assertEqual(again, plant)
        self.assertEqual(pedicel.Plant.parse(plant.text()), plant)
        self.assertTrue(pedicel.validate(path), pedicel.validate(path).text)
        a, b = pedicel.Simulation(plant), pedicel.Simulation(path)
        for sim in (a, b):
            sim.step(20)
        self.assertEqual(a.state_hash, b.state_hash)

    def test_a_plant_can_be_copied_and_sent(self):
        plant = bush()
        for other in (copy.copy(plant), copy.deepcopy(plant), pickle.loads(pickle.dumps(plant)), plant.copy()):
            self.assertEqual(other, plant)
            other.set("material.density", 500)
            self.assertNotEqual(other, plant)

    def test_a_fruit_without_a_density_has_the_usual_one(self):
        plant = bush()
        plant.add_fruit("pea", "stem", 0.5, 0.004)
        self.assertIn("radius: 0.004, density: 950", plant.text())

    def test_edits_change_what_is_simulated(self):
        plant = pedicel.Plant.load(self.plant)
        copy = plant.copy()
        copy.set_length("stem", 0.4)
        copy.set_radius("stem", 0.004)
        copy.set_organ("berry", "radius", 0.015)
        copy.set("material.density", 800)
        self.assertNotEqual(copy, plant)
        self.assertEqual(plant.text(), pedicel.Plant.parse(PLANT).text())
        self.assertEqual(copy.get("material.density"), 800)
        sim = pedicel.Simulation(self.scene, plants={"twig": copy})
        self.assertAlmostEqual(sim.fruit_positions[0, 2], 0.39, delta=0.02)
        self.assertGreater(len(sim.segment_names), len(pedicel.Simulation(self.scene).segment_names))

    def test_points_and_removal(self):
        plant = bush()
        points = plant.points("branch")
        points[1] += [0, 0, 0.05]
        plant.set_points("branch", points)
        self.assertTrue(np.allclose(plant.points("branch")[1], [0.1, 0, 0.3]))
        plant.rename("plum", "damson")
        plant.place("damson", "stem", 1.0)
        plant.remove("branch")
        plant.remove("leaf_1")
        self.assertEqual((plant.stems, plant.fruits, plant.leaves), (["stem"], ["damson"], []))

    def test_impossible_edits_change_nothing(self):
        plant = bush()
        text = plant.text()
        for edit in (lambda: plant.add_stem("stem", [[0, 0, 0], [0, 0, 1]], 0.01),
                     lambda: plant.add_fruit("plum", "stem", 0.5, 0.01),
                     lambda: plant.add_fruit("new", "stem", 0.5, 0.01, detach={"colour": 1.0}),
                     lambda: plant.remove("nobody"), lambda: plant.set("material.colour", 1.0),
                     lambda: plant.set("material.density", -1.0),
                     lambda: plant.set_length("stem", -1.0)):
            with self.assertRaises(pedicel.UsageError):
                edit()
        self.assertEqual(plant.text(), text)

    def test_faults_of_a_plant_have_a_place(self):
        with self.assertRaises(pedicel.InvalidFile) as raised:
            pedicel.Plant.parse(PLANT.replace("density: 700", "density: heavy"), "mine.plant.yaml")
        self.assertEqual((raised.exception.file, raised.exception.line), ("mine.plant.yaml", 4))


if __name__ == "__main__":
    unittest.main()
