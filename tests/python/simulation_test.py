"""A simulation is the run off screen, bit by bit; its arrays are views; a saved state comes back."""

import csv
import gc
import os
import pickle
import unittest

import numpy as np

import pedicel
from given import PULL_UP, Case


class SimulationTest(Case):
    def test_has_the_bits_of_a_run_off_screen(self):
        result, _ = self.headless(PULL_UP, "--steps", "200")
        sim = pedicel.Simulation(PULL_UP)
        sim.step(200)
        self.assertEqual(sim.state_hash, result["state_hash"])

    def test_settings_are_those_of_the_command_line(self):
        result, _ = self.headless(self.scene, "--dt", "0.002", "--set", "material.density=900",
                                  "--steps", "30")
        sim = pedicel.Simulation(self.scene, dt=0.002, **{"material.density": 900})
        sim.step(30)
        self.assertEqual(sim.state_hash, result["state_hash"])
        self.assertNotEqual(pedicel.Simulation(self.scene).state_hash, result["state_hash"])

    def test_a_lone_plant_is_a_scene(self):
        result, _ = self.headless(self.plant, "--steps", "20")
        sim = pedicel.Simulation(self.plant)
        sim.step(20)
        self.assertEqual(sim.state_hash, result["state_hash"])

    def test_quantities_are_the_log(self):
        _, out = self.headless(PULL_UP, "--steps", "60", "--log-rate", "240")
        sim = pedicel.Simulation(PULL_UP)
        sim.step(60)
        with open(os.path.join(out, "log.csv"), encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        now = sim.quantities()
        self.assertEqual(set(now), set(last) - {"time_s"})
        self.assertAlmostEqual(float(last["time_s"]), sim.time)
        for name, value in now.items():
            self.assertAlmostEqual(value, float(last[name]), delta=1e-6 + 1e-5 * abs(value), msg=name)
        for row, fruit in enumerate(sim.fruit_names):
            force, moment = np.linalg.norm(sim.stalk_loads[row].reshape(2, 3), axis=1)
            self.assertAlmostEqual(now[fruit + "_stalk_N"], force)
            self.assertAlmostEqual(now[fruit + "_stalk_Nm"], moment)
            self.assertAlmostEqual(now[fruit + "_margin_used_1"], sim.stalk_margins[row])
        for row, link in enumerate(sim.touching_names):
            self.assertAlmostEqual(now[f"contact_{link}_normal_N"], sim.link_contact_forces[row])

    def test_arrays_agree_with_each_other(self):
        sim = pedicel.Simulation(PULL_UP)
        sim.step(100)
        n = len(sim.segment_names)
        shapes = {"positions": (n, 3), "orientations": (n, 4), "velocities": (n, 3), "strains": (n, 6),
                  "segment_loads": (n, 6), "attached": (n,), "fruit_positions": (len(sim.fruit_names), 3),
                  "organ_forces": (len(sim.organ_names), 3), "link_forces": (len(sim.touching_names), 3),
                  "joint_positions": (len(sim.joint_names),), "link_poses": (len(sim.link_names), 7),
                  "tool_pose": (7,), "energies": (3,), "body_poses": (len(sim.body_names), 7)}
        for name, shape in shapes.items():
            self.assertEqual(getattr(sim, name).shape, shape, name)
        self.assertTrue(np.allclose(np.linalg.norm(sim.orientations, axis=1), 1))
        # A segment's third axis points from its parent's node to its own, but for strain.
        x, y, z, w = sim.orientations.T
        axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
        inner = sim.segment_parents >= 0
        way = sim.positions[inner] - sim.positions[sim.segment_parents[inner]]
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        self.assertGreater(np.min(np.sum(way * axis[inner], axis=1)), 0.99)
        now = sim.quantities()
        self.assertAlmostEqual(now["energy_elastic_J"], sim.energies[1])
        self.assertAlmostEqual(now["tool_z_m"], sim.tool_pose[2])
        stretch = np.linalg.norm(sim.strains[:, :3], axis=1)[sim.attached].max()
        self.assertAlmostEqual(now["stretch_max_1"], stretch)

    def test_arrays_are_views_that_follow(self):
        sim = pedicel.Simulation(self.scene)
        positions = sim.positions
        before = positions.copy()
        sim.set_force("twig/berry", [0.1, 0, 0])
        sim.step(10)
        self.assertFalse(np.array_equal(before, positions))
        self.assertTrue(np.array_equal(positions, sim.positions))
        self.assertTrue(np.shares_memory(positions, sim.positions))
        sim.reset()
        self.assertTrue(np.array_equal(before, positions))
        with self.assertRaises(ValueError):
            positions[0, 0] = 1.0

    def test_a_cut_falls_and_is_saved(self):
        sim = pedicel.Simulation(self.scene)
        sim.step(10)
        hung = sim.fruit_positions[0].copy()
        sim.cut("twig/stem", 0.4)
        sim.step(10)
        self.assertLess(sim.fruit_velocities[0, 2], -0.05, "it falls with the stem")
        sim.step(20)
        self.assertEqual([(e.organ, e.cause) for e in sim.events], [("twig/stem", "cut")])
        self.assertLess(sim.fruit_positions[0, 2], hung[2] - 0.01)
        with self.assertRaisesRegex(pedicel.UsageError, "has come off there already"):
            sim.cut("twig/stem", 0.8)
        state = sim.save()
        sim.step(5)
        later = sim.state_hash
        sim.restore(state)
        sim.step(5)
        self.assertEqual(sim.state_hash, later)

    def test_views_keep_the_simulation(self):
        positions = pedicel.Simulation(self.scene).positions
        gc.collect()
        # Memory that is taken now would be that of a simulation that went.
        rest = [np.full(positions.shape, 7.0) for _ in range(200)]
        self.assertTrue(np.all(np.abs(positions) < 1.0), rest[0][0])

    def test_simulations_do_not_know_each_other(self):
        alone = pedicel.Simulation(self.scene)
        alone.step(40)
        a, b = pedicel.Simulation(self.scene), pedicel.Simulation(PULL_UP)
        for _ in range(40):
            a.step()
            b.step()
        self.assertEqual(a.state_hash, alone.state_hash)
        del a
        gc.collect()
        b.step(5)
        c = pedicel.Simulation(self.scene)
        del b
        gc.collect()
        c.step(40)
        self.assertEqual(c.state_hash, alone.state_hash)

    def test_reset_gives_the_same_bits(self):
        sim = pedicel.Simulation(PULL_UP)
        sim.step(50)
        first = sim.state_hash
        sim.set_joint_velocities(np.full(len(sim.joint_names), 0.1))
        sim.step(20)
        sim.reset(seed=5)
        self.assertEqual((sim.steps, sim.time, sim.seed), (0, 0.0, 5))
        sim.step(50)
        self.assertEqual(sim.state_hash, first)

    def led(self, sim, steps):
        """Does something else before each step."""
        for _ in range(steps):
            sim.set_joint_velocities(0.3 * np.sin(np.arange(len(sim.joint_names)) + sim.steps))
            if sim.steps % 7 == 0:
                sim.set_force("truss/fruit_2", [0.05 * np.cos(sim.steps), 0.0, 0.02])
            sim.step()

    def test_a_saved_state_comes_back_bit_by_bit(self):
        sim = pedicel.Simulation(PULL_UP)
        self.led(sim, 30)
        sim.set("material.density", 900)
        saved, hash_then, positions = sim.save(), sim.state_hash, sim.positions.copy()
        self.led(sim, 20)
        after = sim.state_hash
        sim.restore(saved)  # back
        self.assertEqual((sim.state_hash, sim.steps), (hash_then, 30))
        self.assertTrue(np.array_equal(sim.positions, positions))
        self.led(sim, 20)
        self.assertEqual(sim.state_hash, after)
        other = pedicel.Simulation(PULL_UP)  # elsewhere, through a file
        other.restore(pickle.loads(pickle.dumps(saved)))
        self.assertEqual(other.state_hash, hash_then)
        self.led(other, 20)
        self.assertEqual(other.state_hash, after)

    def test_restoring_another_way_forgets_this_one(self):
        sim = pedicel.Simulation(self.scene)
        sim.set_force("twig/berry", [0.1, 0, 0])
        sim.step(10)
        saved, there = sim.save(), sim.state_hash
        sim.reset()
        sim.set_force("twig/berry", [0, 0.1, 0])
        sim.step(10)
        self.assertNotEqual(sim.state_hash, there)
        sim.restore(saved)
        self.assertEqual(sim.state_hash, there)

    def test_a_state_of_another_scene_is_refused(self):
        saved = pedicel.Simulation(self.scene).save()
        with self.assertRaisesRegex(pedicel.UsageError, "same scene"):
            pedicel.Simulation(PULL_UP).restore(saved)
        with self.assertRaisesRegex(pedicel.UsageError, "same scene"):
            pedicel.Simulation(self.scene, **{"material.density": 900}).restore(saved)
        for broken in (b"", b"something", saved[:20], saved + b"1 2 3"):
            with self.assertRaises(pedicel.UsageError):
                pedicel.Simulation(self.scene).restore(broken)

    def test_a_force_bends_and_breaks(self):
        sim = pedicel.Simulation(self.scene)
        sim.set_force("twig/berry", [0.1, 0, 0])
        sim.step(40)
        pushed = sim.fruit_positions[0].copy()
        mirror = pedicel.Simulation(self.scene)
        mirror.set_force("twig/berry", [-0.1, 0, 0])
        mirror.step(40)
        self.assertGreater(pushed[0], mirror.fruit_positions[0, 0] + 0.002)
        self.assertEqual(sim.events, [])
        sim.set_force("twig/berry", [0, 0, 2.0])
        sim.step(40)
        self.assertEqual([e.organ for e in sim.events], ["twig/berry"])
        self.assertEqual(sim.events[0].cause, "force")
        self.assertFalse(sim.fruit_attached[0])
        self.assertEqual(sim.stalk_margins[0], 1.0)
        # Pulled up with more than its weight, it rises.
        self.assertGreater(sim.fruit_velocities[0, 2], 0.1)
        rises = sim.fruit_velocities[0, 2]
        sim.clear_forces()
        sim.step(40)
        self.assertAlmostEqual(sim.fruit_velocities[0, 2] - rises, -9.81 * 0.2, delta=0.1)

    def test_a_constant_changes_while_it_runs(self):
        soft, same = pedicel.Simulation(self.scene), pedicel.Simulation(self.scene)
        for sim in (soft, same):
            sim.set_force("twig/berry", [0.05, 0, 0])
            sim.step(5)
        key = next(k for k in soft.parameters if k.endswith("material.youngs_modulus"))
        self.assertEqual(soft.parameters[key].value, 2.0e7)
        self.assertEqual(soft.parameters[key].unit, "Pa")
        self.assertIn("material.youngs_modulus = 2e+07 Pa>", repr(soft.parameters[key]))
        soft.set(key, 5.0e6)
        self.assertEqual(soft.parameters[key].value, 5.0e6)
        for sim in (soft, same):
            sim.step(40)
        self.assertGreater(soft.fruit_positions[0, 0], same.fruit_positions[0, 0] + 1e-4)
        with self.assertRaisesRegex(pedicel.UsageError, "dt: changes what is set up once"):
            soft.set("dt", 0.001)


if __name__ == "__main__":
    unittest.main()
