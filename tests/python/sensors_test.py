"""What a run off screen writes of its sensors, how gently it was, and what varies in a scene."""

import csv
import json
import os
import subprocess
import unittest

import numpy as np

import pedicel
from given import PROGRAM, PULL_UP, SCENE, Case

WATCHED = SCENE.replace("fov: 0.6}", "fov: 0.6, size: [80, 60], sensors: [rgb, depth, instances, classes, keypoints, "
                        "points], rate: 4,\n     noise: {depth_std: 0.001, latency: 0.1}}\n"
                        "  - {name: plain, eye: [0.5, 0.5, 0.3]}").replace("duration: 1", "duration: 0.5\nseed: 3")


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class SensorsTest(Case):
    def run_off_screen(self, scene, *options, good=(0,)):
        out = os.path.join(self.folder, "out")
        run = subprocess.run([PROGRAM, "--headless", scene, "--json", "--no-video", "--quiet", "--out", out, *options],
                             capture_output=True, text=True)
        if run.returncode == 77:
            self.skipTest(run.stderr)
        self.assertIn(run.returncode, good, run.stderr)
        return json.loads(run.stdout), out

    def test_cameras_leave_their_files(self):
        _, out = self.run_off_screen(self.write("watched.scene.yaml", WATCHED))
        found = sorted(os.listdir(os.path.join(out, "sensors", "side")))
        ends = ["classes.png", "depth.npy", "depth.png", "instances.png", "json", "points.ply", "rgb.png"]
        self.assertEqual(found, [f"{i:06d}.{end}" for i in range(3) for end in ends])
        self.assertFalse(os.path.exists(os.path.join(out, "sensors", "plain")))
        # Pictures come at 0, 0.25 and 0.5 s, and show what was 0.1 s before; at the start there is no before.
        times = []
        for i in range(3):
            with open(os.path.join(out, "sensors", "side", f"{i:06d}.json"), encoding="utf-8") as file:
                times.append(json.load(file)["time_s"])
        np.testing.assert_allclose(times, [0.0, 0.15, 0.4], atol=1e-9)
        # The same as in Python, noise included.
        sim = pedicel.Simulation(os.path.join(self.folder, "watched.scene.yaml"))
        sim.camera("side")
        sim.step(50)
        seen = sim.camera("side")
        depth = np.load(os.path.join(out, "sensors", "side", "000001.depth.npy"))
        self.assertTrue(np.array_equal(depth, seen.depth, equal_nan=True))
        with open(os.path.join(out, "sensors", "things.json"), encoding="utf-8") as file:
            self.assertEqual([t["name"] for t in json.load(file)], [t.name for t in sim.things])

    def test_fingertips_feel_what_the_log_says(self):
        with open(PULL_UP, encoding="utf-8") as file:
            text = file.read().replace("../../", os.path.join(os.path.dirname(PULL_UP), "../../")).replace(
                "../robots", os.path.join(os.path.dirname(PULL_UP), "../robots"))
        links = pedicel.Simulation(PULL_UP).touching_names
        finger = next(n for n in links if "finger" in n)
        scene = self.write("felt.scene.yaml", text + "\nwrenches:\n  - {name: tip, link: " + finger.split("/")[-1] +
                           ", touch: true}\n  - {name: wrist, link: " + finger.split("/")[-1] + "}\n")
        _, out = self.run_off_screen(scene, "--duration", "1.5", "--no-pictures", "--no-sweep", good=(0, 5))
        tip = rows_of(os.path.join(out, "wrench_tip.csv"))
        self.assertEqual(list(tip[0]), ["time", "fx", "fy", "fz", "tx", "ty", "tz"])
        sim, largest, felt = pedicel.Simulation(scene), 0.0, 0.0
        for row in tip:
            while sim.time < float(row["time"]) - 1e-6:
                sim.step(1)
            force = np.array([float(row[k]) for k in ("fx", "fy", "fz")])
            exact = sim.link_forces[links.index(finger)]
            self.assertAlmostEqual(np.linalg.norm(force), np.linalg.norm(exact), places=6)
            largest, felt = max(largest, np.linalg.norm(exact)), felt + 1
        self.assertGreater(largest, 0.1)
        self.assertGreater(felt, 100)
        # A fruit's weight does not pass a fingertip alone: the wrist carries the finger as well.
        wrist = rows_of(os.path.join(out, "wrench_wrist.csv"))
        self.assertNotEqual(wrist[-1]["fx"], tip[-1]["fx"])

    def test_imus_feel_what_carries_them(self):
        with open(PULL_UP, encoding="utf-8") as file:
            text = file.read().replace("../../", os.path.join(os.path.dirname(PULL_UP), "../../")).replace(
                "../robots", os.path.join(os.path.dirname(PULL_UP), "../robots"))
        sim = pedicel.Simulation(self.write("shaken.scene.yaml", text + "\nimus:\n  - {name: stem, organ: truss/stem}\n"))
        sim.step(20)
        self.assertEqual(sim.imus["stem"].shape, (6,))
        self.assertAlmostEqual(np.linalg.norm(sim.imus["stem"][:3]), 9.81, places=2)
        self.assertEqual(sim.quantities()["imu_stem_wx_rad/s"], sim.imus["stem"][3])
        self.assertEqual(sim.wrenches, {})

    def test_gentleness_is_in_every_result(self):
        result, out = self.run_off_screen(PULL_UP, "--duration", "3.6", "--no-pictures", "--no-sweep", good=(0, 5))
        handled = result["gentleness"]
        self.assertEqual(handled["broken"], 1)
        rows = {row["organ"]: row for row in rows_of(os.path.join(out, "gentleness.csv"))}
        for one in handled["organs"]:
            self.assertAlmostEqual(float(rows[one["organ"]]["peak_force_N"]), one["peak_force_N"])
        self.assertEqual(rows["truss/fruit_5"]["broken"], "1")
        # The log's largest contact force on the fruit is its peak, as far as the log has seen it.
        log = rows_of(os.path.join(out, "log.csv"))
        column = next(c for c in log[0] if "fruit_5" in c and "contact" in c and c.endswith("_N"))
        seen = max(float(row[column]) for row in log if row[column] != "nan")
        self.assertLessEqual(seen, handled["organs"][[o["organ"] for o in handled["organs"]].index("truss/fruit_5")]
                             ["peak_force_N"] + 1e-6)
        with open(os.path.join(out, "report.html"), encoding="utf-8") as file:
            self.assertIn("How gently it was done", file.read())

    def test_a_scene_varies_with_its_seed_and_not_what_is_set(self):
        varied = self.write("varied.scene.yaml", SCENE + "vary:\n  material.density: {distribution: uniform, low: 300, "
                            "high: 900}\n  twig.none: {distribution: uniform, low: 0, high: 1}\n")
        run = subprocess.run([PROGRAM, "--headless", varied, "--quiet", "--no-pictures"], capture_output=True, text=True,
                             cwd=self.folder)
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("twig.none", run.stderr)
        varied = self.write("varied.scene.yaml", SCENE + "vary:\n  material.density: {distribution: uniform, low: 300, "
                            "high: 900}\nloads:\n  - {fruit: twig/berry, force: [0.1, 0, 0], to: 1}\n")
        hashes = [self.run_off_screen(varied, "--no-pictures", *more)[0]["state_hash"]
                  for more in ((), ("--seed", "0"), ("--seed", "1"), ("--set", "material.density=700"),
                               ("--set", "material.density=700", "--seed", "1"))]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])
        self.assertNotEqual(hashes[0], hashes[3])
        self.assertEqual(hashes[3], hashes[4])
        # Python has the same, and draws anew with a seed.
        sim = pedicel.Simulation(varied)
        sim.step(200)
        self.assertEqual(sim.state_hash, hashes[0])
        sim.reset(seed=1)
        sim.step(200)
        self.assertEqual(sim.state_hash, hashes[2])

    def test_a_sweep_over_directions_is_a_polar_picture(self):
        pulled = self.write("pulled.scene.yaml", SCENE + "loads:\n  - {fruit: twig/berry, force: [0, 0, -2], to: 1, ramp: "
                            "true}\n")
        out = os.path.join(self.folder, "sweep")
        run = subprocess.run([PROGRAM, "sweep", pulled, "--set", "loads.angle=0,0.8,1.6,2.4,3.1", "--out", out,
                              "--quiet", "--no-pictures"], capture_output=True, text=True)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        with open(os.path.join(out, "polar.svg"), encoding="utf-8") as file:
            svg = file.read()
        self.assertEqual(svg.count("<circle") - svg.count('fill="none" stroke="#d0d7de"'), 5)
        rows = rows_of(os.path.join(out, "sweep.csv"))
        self.assertEqual([row["loads.angle"] for row in rows], ["0", "0.8", "1.6", "2.4", "3.1"])
        with open(os.path.join(out, "report.html"), encoding="utf-8") as file:
            self.assertIn("Force at detachment over the pull", file.read())


if __name__ == "__main__":
    unittest.main()
