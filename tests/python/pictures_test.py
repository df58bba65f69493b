"""Pictures by cameras, from any thread."""

import threading
import unittest

import numpy as np

import pedicel
from given import PULL_UP, Case


class PicturesTest(Case):
    def setUp(self):
        super().setUp()
        try:
            pedicel.Simulation(self.scene).render(width=16, height=16)
        except pedicel.NoPictures as why:
            self.skipTest(str(why))

    def test_a_picture_shows_the_scene(self):
        sim = pedicel.Simulation(self.scene)
        picture = sim.render("side", width=160, height=120)
        self.assertEqual((picture.shape, picture.dtype), ((120, 160, 3), np.uint8))
        self.assertTrue(np.array_equal(picture, sim.render("side", width=160, height=120)))
        sim.set_force("twig/berry", [0.1, 0, 0])
        sim.step(40)
        moved = sim.render("side", width=160, height=120)
        changed = np.any(moved != picture, axis=2)
        # The twig bends; the ground far from it stays.
        self.assertGreater(changed.sum(), 20)
        self.assertLess(changed.mean(), 0.5)
        self.assertFalse(np.array_equal(sim.render(strain=True, width=160, height=120),
                                        sim.render(width=160, height=120)))

    def test_a_picture_changes_no_bits(self):
        sim, other = pedicel.Simulation(PULL_UP), pedicel.Simulation(PULL_UP)
        for _ in range(3):
            sim.step(10)
            sim.render("front", width=64, height=48)
        other.step(30)
        self.assertEqual(sim.state_hash, other.state_hash)
        sim.reset()
        sim.render("close", width=64, height=48)

    def test_pictures_from_several_threads(self):
        sims = [pedicel.Simulation(self.scene) for _ in range(3)]
        pictures = {}

        def take(i):
            for _ in range(3):
                pictures[i] = sims[i].render(width=80, height=60)

        threads = [threading.Thread(target=take, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(np.array_equal(pictures[0], pictures[1]))
        self.assertTrue(np.array_equal(pictures[0], pictures[2]))


if __name__ == "__main__":
    unittest.main()
