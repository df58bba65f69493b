"""What cameras see: depths against geometry, masks against rays, keypoints, noise, wrenches."""

import unittest

import numpy as np

import pedicel
from given import PULL_UP, SCENE, Case

BALLS = """format: pedicel-scene
version: 1
name: balls
purpose: a test
see: nothing
duration: 1
dt: 0.005
bodies:
  - {name: ball, sphere: {radius: 0.1}, position: [0, 0, 0.3]}
  - {name: behind, sphere: {radius: 0.04}, position: [0, 0.5, 0.3]}
  - {name: beside, sphere: {radius: 0.05}, position: [0.3, 0.2, 0.2]}
ground: {height: 0}
cameras:
  - {name: front, eye: [0, -1.2, 0.5], target: [0.1, 0, 0.2], fov: 0.8, size: [200, 150]}
  - {name: up, eye: [0, -1.2, 0.5], target: [0, -1.2, 2], fov: 0.3, size: [64, 48]}
  - {name: turned, position: [0, -1.2, 0.3], orientation: [-0.7071067811865476, 0, 0, 0.7071067811865476],
     focal: 240, size: [200, 150]}
"""


def rays_of(picture):
    """Directions through the middles of all pixels, with a depth of 1 m, in the world."""
    height, width = picture.depth.shape
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    k = picture.intrinsic
    camera = np.stack([(u - k[0, 2]) / k[0, 0], (v - k[1, 2]) / k[1, 1], np.ones_like(u)], axis=-1)
    return camera @ picture.extrinsic[:3, :3]


def depths_of(rays, eye):
    """By geometry alone: what each ray meets first, and its depth."""
    best = np.full(rays.shape[:2], np.inf)
    what = np.zeros(rays.shape[:2], dtype=int)
    for number, (centre, radius) in enumerate([([0, 0, 0.3], 0.1), ([0, 0.5, 0.3], 0.04), ([0.3, 0.2, 0.2], 0.05)]):
        to = np.array(centre) - eye
        a, b, c = (rays ** 2).sum(-1), rays @ to, to @ to - radius ** 2
        root = b * b - a * c
        depth = np.where(root > 0, (b - np.sqrt(np.maximum(root, 0))) / a, np.inf)
        what[depth < best], best = number + 1, np.minimum(best, depth)
    with np.errstate(divide="ignore"):
        depth = np.where(rays[..., 2] < 0, -eye[2] / rays[..., 2], np.inf)
    what[depth < best] = 4
    return np.minimum(best, depth), what


class CamerasTest(Case):
    def setUp(self):
        super().setUp()
        try:
            pedicel.Simulation(self.scene).render(width=16, height=16)
        except pedicel.NoPictures as why:
            self.skipTest(str(why))
        self.balls = self.write("balls.scene.yaml", BALLS)

    def test_depths_and_masks_are_those_of_rays(self):
        sim = pedicel.Simulation(self.balls)
        for camera in ("front", "turned"):
            seen = sim.camera(camera)
            self.assertEqual((seen.rgb.shape, seen.depth.shape), ((150, 200, 3), (150, 200)))
            depth, what = depths_of(rays_of(seen), seen.pose[:3])
            ids = {t.name: t.id for t in seen.things}
            expected = np.array([0, ids["ball"], ids["behind"], ids["beside"], ids["ground"]])[what]
            # The ground is drawn as far as it is seen, and not beyond.
            wrong = (expected != seen.instances) & ((what != 4) | (depth < 4))
            self.assertLess(wrong.mean(), 0.004)          # at the rims
            self.assertGreater((what == 1).sum(), 300)
            right = ~wrong & np.isfinite(depth) & (depth < 5)
            # Balls have facets, 1 % of their radius inside; at their rims rays see more of that.
            self.assertLess(np.quantile(np.abs(seen.depth[right] - depth[right]), 0.99), 0.004)
            ground = right & (what == 4)
            self.assertLess((np.abs(seen.depth[ground] - depth[ground]) / depth[ground]).max(), 1e-4)
            kinds = np.array([sim.thing_classes.index(t.kind) for t in seen.things])
            self.assertTrue(np.array_equal(seen.classes, kinds[seen.instances]))
        # The ball behind is hidden from the front.
        self.assertNotIn(ids["behind"], np.unique(seen.instances))

    def test_a_plants_masks_and_depths_are_those_of_rays(self):
        near = SCENE.replace("{name: side,", "{name: near, eye: [0.3, -0.3, 0.3], target: [0, 0, 0.2], fov: 0.6, "
                             "size: [320, 240]}\n  - {name: side,")
        sim = pedicel.Simulation(self.write("near.scene.yaml", near))
        sim.set_force("twig/berry", [0.03, 0.05, 0])
        sim.step(40)
        seen = sim.camera("near")
        ids = {t.name: t.id for t in seen.things}
        rays, eye = rays_of(seen).reshape(-1, 3), seen.pose[:3]
        labels, depths = seen.instances.ravel(), seen.depth.ravel()
        nodes = np.vstack([[0, 0, 0], sim.positions])
        radius, berry = 0.003, 0.01
        gap, depth = np.full(len(rays), np.inf), np.full(len(rays), np.inf)
        for a, b in zip(nodes[:-1], nodes[1:]):            # from each ray to the axis of each segment
            t = np.linspace(0, 1, 21)[:, None]
            for point in a + t * (b - a):
                way = np.linalg.norm(np.cross(rays, point - eye), axis=1) / np.linalg.norm(rays, axis=1)
                along = rays @ (point - eye) / (rays ** 2).sum(axis=1)
                closer = way < gap
                gap, depth = np.where(closer, way, gap), np.where(closer, along, depth)
        to_berry = np.linalg.norm(np.cross(rays, sim.fruit_positions[0] - eye), axis=1) / np.linalg.norm(rays, axis=1)
        stem = (gap < 0.6 * radius) & (to_berry > 2.5 * berry)
        self.assertGreater(stem.sum(), 200)
        self.assertTrue(np.all(labels[stem] == ids["twig/stem"]))
        self.assertEqual(np.sum((labels == ids["twig/stem"]) & (gap > 1.5 * radius)), 0)
        # The near side of a stem of 3 mm; its axis is sampled every millimetre.
        middle = stem & (gap < 0.3 * radius)
        self.assertLess(np.abs(depths[middle] - (depth[middle] - radius)).max(), 0.002)
        fruit = (to_berry < 0.85 * berry) & (gap > 1.5 * radius)
        self.assertGreater(fruit.sum(), 30)
        self.assertTrue(np.all(labels[fruit] == ids["twig/berry"]))
        self.assertEqual(np.sum((labels == ids["twig/berry"]) & (to_berry > 2 * berry)), 0)

    def test_the_sky_is_empty(self):
        seen = pedicel.Simulation(self.balls).camera("up")
        self.assertTrue(np.all(seen.instances == 0) and np.all(np.isinf(seen.depth)))
        self.assertEqual(len(seen.points()[0]), 0)

    def test_points_lie_on_what_is_seen(self):
        seen = pedicel.Simulation(self.balls).camera("front")
        positions, ids, colours = seen.points()
        self.assertEqual((len(positions), len(colours)), (len(ids), len(ids)))
        ball = next(t.id for t in seen.things if t.name == "ball")
        distance = np.linalg.norm(positions[ids == ball] - [0, 0, 0.3], axis=1)
        self.assertLess(np.abs(distance - 0.1).max(), 0.002)
        ground = next(t.id for t in seen.things if t.name == "ground")
        self.assertLess(np.abs(positions[ids == ground][:, 2]).max(), 1e-3)

    def test_labels_stay_when_a_fruit_comes_off(self):
        sim = pedicel.Simulation(self.scene)
        before = sim.camera("side", width=160, height=120)
        berry = next(t for t in before.things if t.name == "twig/berry")
        self.assertEqual(berry.kind, "fruit")
        self.assertEqual([t.kind for t in before.things if t.name == "twig/stem"], ["stem"])
        centre = next(k for k in before.keypoints if k.name == "centre")
        self.assertEqual((centre.organ, centre.visibility), ("twig/berry", 2))
        self.assertEqual(before.instances[int(centre.v), int(centre.u)], berry.id)
        sim.set_force("twig/berry", [0.3, 0, -1.0])
        sim.step(40)
        self.assertEqual(len(sim.events), 1)
        after = sim.camera("side", width=160, height=120)
        self.assertEqual([t.name for t in after.things], [t.name for t in before.things])
        self.assertIn(berry.id, after.instances)
        centre = next(k for k in after.keypoints if k.name == "centre")
        np.testing.assert_allclose(centre.position, sim.fruit_positions[0], atol=1e-9)

    def test_a_keypoint_is_hidden_behind_something(self):
        walled = SCENE.replace("ground:", "bodies:\n  - {name: wall, box: [0.3, 0.01, 0.6], position: "
                               "[0.2, -0.2, 0.3]}\nground:")
        sim = pedicel.Simulation(self.write("walled.scene.yaml", walled))
        seen = sim.camera("side", width=160, height=120)
        found = {(k.organ, k.name): k.visibility for k in seen.keypoints}
        self.assertEqual(found["twig/berry", "centre"], 1)
        wide = sim.camera("side", width=20, height=200)       # narrow: the rest is outside
        self.assertEqual({k.visibility for k in wide.keypoints} - {0, 1, 2}, set())

    def test_noise_is_as_large_as_it_says_and_the_same_for_a_seed(self):
        noisy = BALLS.replace("size: [200, 150]}", "size: [200, 150], noise: {depth_std: 0.01, dropout: 0.5, "
                              "edge: 0.05, rgb_std: 0.02, gain_std: 0.05}}", 1)
        sim = pedicel.Simulation(self.write("noisy.scene.yaml", noisy))
        exact, seen = sim.camera("front", noise=False), sim.camera("front")
        self.assertTrue(np.array_equal(exact.instances, seen.instances))
        both = np.isfinite(exact.depth) & np.isfinite(seen.depth) & (exact.depth < 3)
        scaled = (seen.depth[both] - exact.depth[both]) / exact.depth[both] ** 2
        self.assertAlmostEqual(scaled.std() / 0.01, 1, delta=0.05)
        self.assertAlmostEqual(scaled.mean(), 0, delta=0.001)
        lost = np.isnan(seen.depth)
        self.assertTrue(0.001 < lost.mean() < 0.1)
        # Half of the pixels between a ball and what is behind it are lost, and none of the floor's middle.
        rims = np.zeros_like(lost)
        rims[:, 1:-1] = (exact.classes[:, 1:-1] == 7) & (exact.classes[:, :-2] == 8)
        self.assertAlmostEqual(lost[rims].mean(), 0.5, delta=0.2)
        self.assertEqual(lost[140:, :60].sum(), 0)
        self.assertTrue(np.array_equal(sim.camera("front").depth, seen.depth, equal_nan=True))
        again = pedicel.Simulation(os_path(self, "noisy.scene.yaml"))
        self.assertTrue(np.array_equal(again.camera("front").rgb, seen.rgb))
        again.seed = 5
        self.assertFalse(np.array_equal(again.camera("front").rgb, seen.rgb))

    def test_a_late_camera_shows_the_past(self):
        late = SCENE.replace("fov: 0.6}", "fov: 0.6, noise: {latency: 0.05}}")
        sim = pedicel.Simulation(self.write("late.scene.yaml", late))
        sim.set_force("twig/berry", [0.2, 0, 0])
        sim.camera("side", width=64, height=48)
        sim.step(20)
        before = sim.camera("side", width=160, height=120, noise=False)
        sim.step(10)                                          # 0.05 s
        seen = sim.camera("side", width=160, height=120)
        self.assertAlmostEqual(seen.time, before.time, places=9)
        self.assertTrue(np.array_equal(seen.rgb, before.rgb))
        self.assertFalse(np.array_equal(sim.camera("side", width=160, height=120, noise=False).rgb, seen.rgb))

    def test_a_late_camera_of_a_world_is_that_of_a_simulation(self):
        late = SCENE.replace("fov: 0.6}", "fov: 0.6, noise: {latency: 0.05, rgb_std: 0.01}}")
        path = self.write("late.scene.yaml", late)
        sim, worlds = pedicel.Simulation(path, threads=1), pedicel.Worlds(path, 2)
        for run in (sim, worlds[1]):
            run.reset(seed=4)
            run.set_force("twig/berry", [0.2, 0, 0])
            run.camera("side", width=64, height=48)
        sim.step(30), worlds.step(30)
        exact, seen = sim.camera("side", width=160, height=120), worlds[1].camera("side", width=160, height=120)
        self.assertAlmostEqual(seen.time, 0.1)
        self.assertEqual(exact.time, seen.time)
        self.assertTrue(np.array_equal(exact.rgb, seen.rgb))
        self.assertEqual(worlds[1].seed, 4)

    def test_cameras_are_checked(self):
        sim = pedicel.Simulation(self.balls)
        with self.assertRaisesRegex(pedicel.UsageError, "no camera"):
            sim.camera("nobody")
        with self.assertRaisesRegex(pedicel.UsageError, "width and height"):
            sim.camera("front", width=100)
        for bad, words in (("sensors: [rgb, smell]", "smell"), ("noise: {smell: 1}", "unknown key"),
                           ("noise: {dropout: 2}", "between 0 and 1"), ("focal: 100", "fov or focal"),
                           ("rate: 0", "rate")):
            text = BALLS.replace("fov: 0.8", "fov: 0.8, " + bad)
            with self.assertRaisesRegex(pedicel.InvalidFile, words):
                pedicel.Simulation(self.write("bad.scene.yaml", text))

    def test_gentleness_is_told(self):
        sim = pedicel.Simulation(PULL_UP)
        sim.step(20)
        self.assertEqual(sim.gentleness["broken"], 0)
        while not sim.events and sim.time < 4:
            sim.step(20)
        handled = sim.gentleness
        self.assertEqual((handled["broken"], handled["margin_used"]), (1, 1.0))
        fruit = handled["organs"]["truss/fruit_5"]
        self.assertTrue(fruit["broken"] and fruit["peak_force"] > 0 and fruit["impulse"] > 0)
        self.assertLess(fruit["touched_at"], sim.time)
        self.assertGreater(handled["strain_energy"], 0)
        self.assertFalse(handled["organs"]["truss/fruit_1"]["broken"])


def os_path(case, name):
    import os
    return os.path.join(case.folder, name)


if __name__ == "__main__":
    unittest.main()
