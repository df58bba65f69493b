"""Many worlds with one call are single simulations, bit by bit."""

import gc
import unittest

import numpy as np

import pedicel
from given import PULL_UP, Case


class WorldsTest(Case):
    def test_worlds_are_single_runs_bit_by_bit(self):
        worlds = pedicel.Worlds(PULL_UP, 3, threads=2)
        self.assertEqual((len(worlds), worlds.threads), (3, 2))
        singles = [pedicel.Simulation(PULL_UP, threads=1) for _ in range(3)]
        joints = len(singles[0].joint_names)
        random = np.random.default_rng(1)
        for _ in range(15):
            speeds = random.uniform(-0.3, 0.3, (3, joints))
            worlds.set_joint_velocities(speeds)
            worlds.step(4)
            for sim, speed in zip(singles, speeds):
                sim.set_joint_velocities(speed)
                sim.step(4)
        for w, sim in enumerate(singles):
            self.assertEqual(worlds[w].state_hash, sim.state_hash)
            self.assertTrue(np.array_equal(worlds.positions[w], sim.positions))
            self.assertTrue(np.array_equal(worlds[w].positions, sim.positions))
            self.assertTrue(np.array_equal(worlds.attached[w], sim.attached))
        self.assertEqual(len({world.state_hash for world in (worlds[0], worlds[1], worlds[2])}), 3)

    def test_a_masked_reset_leaves_the_others(self):
        worlds = pedicel.Worlds(self.scene, 4)
        start = worlds.positions.copy()
        for w in range(4):
            worlds[w].set_force("twig/berry", [0.02 * (w + 1), 0, 0])
        worlds.step(20)
        moved = worlds.positions.copy()
        worlds.reset(np.array([True, False, False, True]))
        self.assertEqual(list(worlds.times), [0.0, 0.1, 0.1, 0.0])
        for w, begun in enumerate([True, False, False, True]):
            self.assertTrue(np.array_equal(worlds.positions[w], (start if begun else moved)[w]))
        worlds.step(20, [True, False, True, False])
        self.assertTrue(np.allclose(worlds.times, [0.1, 0.1, 0.2, 0.0]))
        self.assertFalse(np.array_equal(worlds.positions[2], moved[2]))
        self.assertTrue(np.array_equal(worlds.positions[1], moved[1]))

    def test_arrays_have_an_axis_of_worlds(self):
        worlds = pedicel.Worlds(PULL_UP, 2)
        sim = pedicel.Simulation(PULL_UP)
        for name in ("positions", "strains", "attached", "tool_pose", "joint_positions", "stalk_loads",
                     "energies", "stalk_margins"):
            self.assertEqual(getattr(worlds, name).shape, (2, *getattr(sim, name).shape), name)

    def test_a_world_that_fails_does_not_stop_the_others(self):
        worlds = pedicel.Worlds(self.scene, 2)
        worlds[1].set_force("twig/stem", [1e13, 0, 0], at=0.5)
        worlds.step(50)
        self.assertEqual(list(worlds.failed), [False, True])
        self.assertAlmostEqual(worlds.times[0], 0.25)
        worlds.reset([False, True])
        self.assertFalse(worlds.failed.any())

    def test_a_world_keeps_the_others(self):
        one = pedicel.Worlds(self.scene, 2)[1]
        view = one.positions
        gc.collect()
        one.step(3)
        self.assertEqual(view.shape[1], 3)
        saved = one.save()
        other = pedicel.Simulation(self.scene)
        other.restore(saved)
        self.assertEqual(other.state_hash, one.state_hash)

    def test_refusals(self):
        with self.assertRaisesRegex(pedicel.UsageError, "at least 1"):
            pedicel.Worlds(self.scene, 0)
        worlds = pedicel.Worlds(self.scene, 2)
        with self.assertRaisesRegex(pedicel.UsageError, "one a world"):
            worlds.reset([True])
        with self.assertRaises(IndexError):
            worlds[2]


if __name__ == "__main__":
    unittest.main()
