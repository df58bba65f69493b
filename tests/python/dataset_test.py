"""Data sets as another program reads them: nothing here comes from the program but its files."""

import json
import os
import re
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

import numpy as np

from given import PROGRAM, SCENE, Case

VARY = """format: pedicel-variation
version: 1
vary:
  material.youngs_modulus: {distribution: uniform, low: 1.0e7, high: 4.0e7}
  shape.radius: {distribution: uniform, low: 0.8, high: 1.5}
  shape.length: {distribution: uniform, low: 0.9, high: 1.1}
  plants.twig.position.x: {distribution: uniform, low: -0.05, high: 0.05}
  plants.twig.yaw: {distribution: uniform, low: -3, high: 3}
  look.sun: {distribution: uniform, low: 0.3, high: 1.2}
  look.fruit_hue: {distribution: uniform, low: -0.5, high: 0.5}
  cameras.side.eye.z: {distribution: uniform, low: 0.2, high: 0.5}
"""

SHOWN = SCENE.replace("cameras:", "bodies:\n  - {name: wall, box: [0.1, 0.01, 0.2], position: [0.1, -0.12, 0.1]}\n"
                      "loads:\n  - {fruit: twig/berry, force: [0, 0, -2], from: 0.3, to: 1}\ncameras:") + \
    "  - {name: sky, eye: [0, 0, 3], target: [0, 0.1, 9], fov: 0.3}\n"


def read_png(path):
    """Gray or RGB of 8 or 16 bits, without interlacing."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, packed, head = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    width, height, bits, colour = head[:4]
    step = {0: 1, 2: 3}[colour] * bits // 8
    raw, rows = zlib.decompress(packed), []
    before = np.zeros(width * step, dtype=np.uint8)
    for y in range(height):
        line = raw[y * (width * step + 1):(y + 1) * (width * step + 1)]
        row = np.frombuffer(line[1:], dtype=np.uint8)
        if line[0] == 2:
            row = row + before
        elif line[0] != 0:
            row = unfiltered(line[0], row, before, step)
        rows.append(row)
        before = row
    pixels = np.array(rows)
    if bits == 16:
        pixels = pixels.reshape(height, -1, 2).astype(np.uint16)
        pixels = pixels[..., 0] * 256 + pixels[..., 1]
    return pixels.reshape(height, width, 3) if colour == 2 else pixels.reshape(height, width)


def unfiltered(kind, row, before, step):
    out = row.astype(int).copy()
    for i in range(len(out)):
        left = out[i - step] if i >= step else 0
        up, corner = int(before[i]), int(before[i - step]) if i >= step else 0
        if kind == 1:
            guess = left
        elif kind == 3:
            guess = (left + up) // 2
        else:
            p = left + up - corner
            guess = min((left, up, corner), key=lambda v: abs(p - v))
        out[i] = (out[i] + guess) % 256
    return out.astype(np.uint8)


def decoded(segmentation):
    """COCO's run lengths: down the columns, beginning with what is not in it."""
    height, width = segmentation["size"]
    counts = segmentation["counts"]
    flat = np.repeat(np.arange(len(counts)) % 2, counts)
    assert len(flat) == height * width
    return flat.reshape(width, height).T.astype(bool)


class DatasetTest(Case):
    def setUp(self):
        super().setUp()
        self.shown = self.write("shown.scene.yaml", SHOWN)
        self.vary = self.write("twig.vary.yaml", VARY)

    def make(self, out, *options, good=(0,)):
        out = os.path.join(self.folder, out)
        run = subprocess.run([PROGRAM, "dataset", self.shown, "--out", out, "--size", "96x72", "--randomise", self.vary,
                              "--seed", "7", *options], capture_output=True, text=True)
        if run.returncode == 77:
            self.skipTest(run.stderr)
        self.assertIn(run.returncode, good, run.stderr)
        return out, run

    def test_coco_says_what_the_pictures_show(self):
        out, _ = self.make("set", "--count", "12")
        with open(os.path.join(out, "annotations", "all.json")) as file:
            coco = json.load(file)
        with open(os.path.join(out, "things.json")) as file:
            things = {t["name"]: t for t in json.load(file)}
        categories = {c["id"]: c for c in coco["categories"]}
        ids = [a["id"] for a in coco["annotations"]]
        self.assertEqual((len(coco["images"]), len(set(ids))), (12, len(ids)))
        self.assertEqual(len({i["id"] for i in coco["images"]}), 12)
        by_image = {i["id"]: [] for i in coco["images"]}
        for one in coco["annotations"]:
            by_image[one["image_id"]].append(one)
        empty, off = 0, 0
        for image in coco["images"]:
            rgb = read_png(os.path.join(out, image["file_name"]))
            self.assertEqual(rgb.shape, (72, 96, 3))
            depth = read_png(os.path.join(out, image["depth_file"]))
            mask = read_png(os.path.join(out, image["instances_file"]))
            classes = read_png(os.path.join(out, image["classes_file"]))
            empty += not by_image[image["id"]]
            self.assertTrue(np.all(depth[mask == 0] == 0))
            seen = set()
            for one in by_image[image["id"]]:
                thing = things[one["organ_id"]]
                seen.add(thing["id"])
                own = decoded(one["segmentation"])
                self.assertTrue(np.array_equal(own, mask == thing["id"]), one["organ_id"])
                self.assertTrue(np.all(classes[own] == one["category_id"]))
                self.assertTrue(np.all(depth[own] > 0))
                ys, xs = np.nonzero(own)
                self.assertEqual(one["bbox"], [xs.min(), ys.min(), np.ptp(xs) + 1, np.ptp(ys) + 1])
                self.assertEqual((one["area"], one["iscrowd"]), (own.sum(), 0))
                self.assertTrue(0 <= one["occlusion"] < 1)
                self.check_keypoints(one, categories[one["category_id"]], image)
                off += one["detached"] and one["organ_id"] == "twig/berry"
            # Whatever is in the mask is annotated, but the ground.
            self.assertEqual(set(np.unique(mask)) - {0, things["ground"]["id"]}, seen)
            for hidden in image["hidden"]:
                self.assertNotIn(things[hidden]["id"], np.unique(mask))
        # Every other picture is of the sky; the pull takes the berry off in some of the others.
        self.assertEqual(empty, 6)
        self.assertGreater(off, 0)

    def check_keypoints(self, one, category, image):
        names = category.get("keypoints", [])
        numbers = one.get("keypoints", [])
        self.assertEqual(len(numbers), 3 * len(names))
        points = np.array(numbers, dtype=float).reshape(-1, 3)
        if names:
            self.assertEqual(one["num_keypoints"], (points[:, 2] > 0).sum())
        for x, y, v in points:
            self.assertIn(v, (0, 1, 2))
            if v == 0:
                self.assertEqual((x, y), (0, 0))
            else:
                self.assertTrue(0 <= x <= image["width"] and 0 <= y <= image["height"])

    def test_cameras_and_depths_agree(self):
        out, _ = self.make("set", "--count", "3", "--at", "0")
        with open(os.path.join(out, "cameras", "000000.json")) as file:
            one = json.load(file)
        depth = read_png(os.path.join(out, "depth", "000000.png"))
        k, e = np.array(one["camera"]["intrinsic"]), np.array(one["camera"]["extrinsic"])
        centre = next(p for p in one["keypoints"] if p["name"] == "centre")
        u, v, z = centre["x"], centre["y"], centre["depth_m"]
        # What is seen of a fruit of 10 mm radius is its near side; so small, its facets are 1.5 mm inside.
        if centre["v"] == 2:
            self.assertAlmostEqual(depth[int(v), int(u)] / 1000, z - 0.01, delta=0.0025)
        camera = np.array([(u - k[0, 2]) / k[0, 0] * z, (v - k[1, 2]) / k[1, 1] * z, z])
        world = e[:3, :3].T @ (camera - e[:3, 3])
        self.assertTrue(0.2 < world[2] < 0.4)                # at the tip of the twig
        np.testing.assert_allclose(e[:3, :3] @ np.array(one["camera"]["position"]) + e[:3, 3], 0, atol=1e-9)

    def test_splits_share_the_pictures(self):
        out, _ = self.make("set", "--count", "10", "--at", "0")
        parts = {}
        for part in ("all", "train", "val", "test"):
            with open(os.path.join(out, "annotations", part + ".json")) as file:
                parts[part] = [i["id"] for i in json.load(file)["images"]]
        self.assertEqual([len(parts[p]) for p in ("train", "val", "test")], [8, 1, 1])
        self.assertEqual(sorted(parts["train"] + parts["val"] + parts["test"]), sorted(parts["all"]))

    def files_of(self, folder):
        found = {}
        for path, _, names in os.walk(folder):
            for name in names:
                with open(os.path.join(path, name), "rb") as file:
                    found[os.path.relpath(os.path.join(path, name), folder)] = file.read()
        return found

    def test_a_stopped_set_goes_on_to_the_same_bits(self):
        whole, _ = self.make("whole", "--count", "8")
        part, _ = self.make("part", "--count", "3")
        # As a killed run leaves it: a picture without its labels, and half a file.
        os.remove(os.path.join(part, "labels", "000001.json"))
        os.remove(os.path.join(part, "depth", "000001.png"))
        with open(os.path.join(part, "images", "000003.png.part4711"), "wb") as file:
            file.write(b"half")
        _, run = self.make("part", "--count", "8", "--json")
        self.assertEqual(json.loads(run.stdout)["made"], 6)
        self.assertEqual(self.files_of(part), self.files_of(whole))

    def test_a_killed_run_goes_on(self):
        out = os.path.join(self.folder, "killed")
        words = [PROGRAM, "dataset", self.shown, "--out", out, "--size", "96x72", "--randomise", self.vary, "--seed", "7",
                 "--count", "40"]
        run = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while run.poll() is None and not os.path.exists(os.path.join(out, "labels", "000002.json")):
            time.sleep(0.01)
        if run.poll() == 77:
            self.skipTest("no pictures")
        run.send_signal(signal.SIGKILL)
        run.wait()
        self.make("killed", "--count", "6")
        whole, _ = self.make("whole", "--count", "6")
        found = {k: v for k, v in self.files_of(out).items()
                 if not re.search(r"\d{6}", k) or int(re.search(r"\d{6}", k)[0]) < 6}
        self.assertEqual(found, self.files_of(whole))

    def test_other_sets_are_not_mixed(self):
        out, _ = self.make("set", "--count", "1")
        _, run = self.make("set", "--count", "1", "--set", "dt=0.004", good=(6,))
        self.assertIn("another scene, seed or setting", run.stderr)
        shutil.rmtree(out)
        os.makedirs(out)
        with open(os.path.join(out, "mine.txt"), "w") as file:
            file.write("mine")
        self.make("set", "--count", "1", good=(6,))

    def test_a_key_that_nothing_has_ends_it_before_the_first_picture(self):
        for key in ("look.smell", "material.smell"):
            with open(self.vary, "w") as file:
                file.write(f"{VARY}  {key}: {{distribution: uniform, low: 0, high: 1}}\n")
            out, run = self.make("other", "--count", "1", good=(3,))
            self.assertIn(key, run.stderr)
            self.assertIn("twig.vary.yaml:12", run.stderr)
            self.assertFalse(os.path.exists(os.path.join(out, "labels")))


if __name__ == "__main__":
    unittest.main()
