"""Errors are exceptions that say what, where, and what was expected."""

import os
import unittest

import pedicel
from given import PLANT, SCENE, Case


class ErrorsTest(Case):
    def test_a_fault_in_a_scene_has_file_line_and_column(self):
        path = self.write("bad.scene.yaml", SCENE.replace("dt: 0.005", "dt: fast"))
        with self.assertRaises(pedicel.InvalidFile) as raised:
            pedicel.Simulation(path)
        line = SCENE.splitlines().index("dt: 0.005") + 1
        fault = raised.exception
        self.assertEqual((fault.file, fault.line, fault.column), (path, line, 5))
        self.assertIn(f"{path}:{line}:5: error:", str(fault))
        self.assertIsInstance(fault, pedicel.Error)

    def test_every_fault_of_a_plant_is_told(self):
        self.write("twig.plant.yaml", PLANT.replace("poisson_ratio: 0.35", "poisson_ratio: 3")
                   .replace("radius: 0.01", "radius: -1"))
        with self.assertRaises(pedicel.InvalidFile) as raised:
            pedicel.Simulation(self.scene)
        lines = [d.line for d in raised.exception.diagnostics]
        self.assertEqual(len(lines), 2, raised.exception)
        self.assertEqual(str(raised.exception.diagnostics[0]),
                         str(raised.exception).splitlines()[0])

    def test_files_that_are_not_there(self):
        with self.assertRaises(pedicel.InvalidFile) as raised:
            pedicel.Simulation(os.path.join(self.folder, "none.scene.yaml"))
        self.assertTrue(raised.exception.file.endswith("none.scene.yaml"))

    def test_settings_that_are_impossible(self):
        with self.assertRaisesRegex(pedicel.UsageError, "dt"):
            pedicel.Simulation(self.scene, dt=-1)
        with self.assertRaisesRegex(pedicel.UsageError, "no_such_key"):
            pedicel.Simulation(self.scene, **{"rods.no_such_key": 1})
        with self.assertRaisesRegex(pedicel.UsageError, "twig"):
            pedicel.Simulation(self.scene, plants={"rose": pedicel.Plant("rose")})

    def test_names_that_are_not_there_are_told_with_those_that_are(self):
        sim = pedicel.Simulation(self.scene)
        with self.assertRaisesRegex(pedicel.UsageError, "twig/berry"):
            sim.set_force("twig/apple", [0, 0, 1])
        with self.assertRaisesRegex(pedicel.UsageError, "no robot"):
            sim.set_joint_velocities([0.0])
        with self.assertRaisesRegex(pedicel.UsageError, "side"):
            sim.render("above")
        with self.assertRaisesRegex(pedicel.UsageError, "3 in one"):
            sim.set_force("twig/berry", [1.0, 2.0])
        with self.assertRaisesRegex(pedicel.UsageError, "between 0 and 1"):
            sim.set_force("twig/stem", [0, 0, 1], at=1.5)
        with self.assertRaisesRegex(pedicel.UsageError, "finite"):
            sim.set_force("twig/berry", [0, 0, float("nan")])
        with self.assertRaisesRegex(pedicel.UsageError, "0 steps"):
            sim.step(-1)
        with self.assertRaisesRegex(pedicel.UsageError, "NoneType, expected a number"):
            sim.set("material.density", None)
        with self.assertRaisesRegex(pedicel.UsageError, "finite"):
            sim.visible_share("twig/berry", [float("nan"), 0, 0])
        with self.assertRaisesRegex(pedicel.UsageError, "all cores"):
            pedicel.Worlds(self.scene, 1, threads=-3)
        with self.assertRaisesRegex(pedicel.UsageError, "one a point"):
            pedicel.Plant("rose").add_stem("stem", [[0, 0, 0], [0, 0, 1]], "thick")
        self.assertEqual(sim.steps, 0)

    def test_seeds_are_whole_and_not_negative(self):
        sim = pedicel.Simulation(self.scene)
        for bad in (lambda: sim.reset(seed=-1), lambda: setattr(sim, "seed", -5),
                    lambda: pedicel.Variation.parse("dt: {low: 0.001, high: 0.002}").draw(-1)):
            with self.assertRaisesRegex(pedicel.UsageError, "from 0 on"):
                bad()
        for bad in (1.5, "one", 2**70):
            with self.assertRaises(TypeError):
                sim.reset(seed=bad)
        self.assertEqual(sim.seed, 0)
        sim.reset(seed=2**62)
        self.assertEqual(sim.seed, 2**62)

    def test_what_is_refused_leaves_the_run_as_it_was(self):
        sim, other = pedicel.Simulation(self.scene), pedicel.Simulation(self.scene)
        for bad in (lambda: sim.set_force("twig/apple", [0, 0, 1]), lambda: sim.set("rods.x", 1)):
            with self.assertRaises(pedicel.UsageError):
                bad()
        sim.step(10)
        other.step(10)
        self.assertEqual(sim.state_hash, other.state_hash)
        self.assertEqual(sim.save(), other.save())

    def test_an_unstable_run_says_so_and_stays(self):
        sim = pedicel.Simulation(self.scene)
        sim.set_force("twig/stem", [1e13, 0, 0], at=0.5)
        with self.assertRaisesRegex(pedicel.Unstable, "unstable at .* s: "):
            sim.step(400)
        steps = sim.steps
        with self.assertRaises(pedicel.Unstable):
            sim.step()
        self.assertEqual(sim.steps, steps)
        sim.reset()
        sim.step(5)


if __name__ == "__main__":
    unittest.main()
