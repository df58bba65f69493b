# %% [markdown]
# # Pictures with labels
#
# What a camera sees, and a data set of pictures that vary.
# As a script it runs as a whole: `python3 data_set.py [PICTURES]`.

# %%
import json
import os
import sys
import tempfile

import numpy as np

import pedicel

count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
scene = pedicel.asset("scenes/cherry_tomato_pull_up.scene.yaml")
sim = pedicel.Simulation(scene)
try:
    seen = sim.camera("close", width=320, height=240)
except pedicel.NoPictures as why:
    print(why)
    sys.exit(0)
print("nearest thing:", round(float(seen.depth.min()), 3), "m away")
for name in sim.thing_classes:
    share = np.mean(seen.classes == sim.thing_classes.index(name))
    print(f"{name:12s}{100 * share:6.2f} % of the picture")

# %% [markdown]
# Keypoints say which organs are seen, and masks where they are.

# %%
for point in seen.keypoints:
    if point.name == "centre" and point.visibility == 2:
        pixels = int(np.sum(seen.instances == point.id))
        print(f"{point.organ} at ({point.u:.0f}, {point.v:.0f}), {point.depth:.2f} m away, {pixels} pixels")

# %% [markdown]
# Points lie on what is seen: those of a fruit are as far from its centre as it is thick.

# %%
positions, ids, colours = seen.points()
fruit = next(t.id for t in sim.things if t.name == "truss/fruit_5")
centre = sim.fruit_positions[sim.fruit_names.index("truss/fruit_5")]
distances = np.linalg.norm(positions[ids == fruit] - centre, axis=1)
if len(distances):
    print(f"fruit_5: {len(distances)} points, {1000 * np.median(distances):.1f} mm from its centre")

# %% [markdown]
# A data set: every picture has its own light, shape, pose and time.

# %%
with tempfile.TemporaryDirectory() as folder:
    out = os.path.join(folder, "tomatoes")
    pedicel.command("dataset", scene, "--count", count, "--out", out, "--size", "160x120", "--at", "0:2.5",
                    "--randomise", pedicel.asset("datasets/tomato.vary.yaml"))
    with open(os.path.join(out, "annotations", "all.json"), encoding="utf-8") as file:
        coco = json.load(file)
names = {c["id"]: c["name"] for c in coco["categories"]}
print(len(coco["images"]), "pictures,", len(coco["annotations"]), "annotations")
for number, name in names.items():
    of_kind = [a for a in coco["annotations"] if a["category_id"] == number]
    if of_kind:
        print(f"{name:8s}{len(of_kind):6d}, hidden by {100 * np.mean([a['occlusion'] for a in of_kind]):.0f} % in the mean")
assert len(coco["images"]) == count
