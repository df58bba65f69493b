#!/usr/bin/env python3
"""Draws a young apple tree: plants/apple_tree.plant.yaml with apples and leaves, and its bare wood
as plants/apple_tree.mtg, as people who digitise trees write it.

A slender spindle as orchards grow them: one trunk, branches about it by the golden angle, longer
and flatter below, short twigs on them that bear. Nothing is measured; the sizes are those a grower
would expect in the third year. Lengths in metres. Run from anywhere: tools/make_apple_tree.py [FOLDER]
"""
import argparse
import math
import pathlib
import random

TRUNK = 2.2          # m
BRANCHES = 16
GOLDEN = math.pi * (3 - math.sqrt(5))
STALK = 0.03         # m, of an apple

HEAD = """\
# A young apple tree, drawn by tools/make_apple_tree.py: nothing in it is measured. Wood of 3e9 Pa
# and 950 kg/m3 is green apple wood in the order of magnitude (Niklas, Plant Biomechanics, 1992,
# table 2.1: 1e9 to 1e10 Pa for wood). Apples of 70 mm and 850 kg/m3, which float; they come off at
# 20 N, in the middle of the 10 to 30 N that pickers pull with.
format: pedicel-plant
version: 1
name: apple tree
shape: drawn
look: apple
material: {youngs_modulus: 3.0e+9, poisson_ratio: 0.3, density: 950, damping_time: 0.02}
sampling: {connect: 0.003, distance: 0.06}
root: [0, 0, 0]
curves:
"""

MTG_HEAD = """\
# A young apple tree, drawn by tools/make_apple_tree.py: nothing in it is measured. Lengths in mm,
# diameters in tenths of them.
CODE :\tFORM-A

CLASSES:
SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION
$\t0\tFREE\tFREE\tIMPLICIT
P\t1\tFREE\tFREE\tEXPLICIT
E\t2\tFREE\tFREE\tEXPLICIT

DESCRIPTION :
LEFT\tRIGHT\tRELTYPE\tMAX
E\tE\t+\t?
E\tE\t<\t1

FEATURES:
NAME\tTYPE
XX\tREAL
YY\tREAL
ZZ\tREAL
TopDia\tREAL

MTG :
ENTITY-CODE\t\t\tXX\tYY\tZZ\tTopDia
/P1
"""


class Axis:
    """A stem: points, radii, and the axes that start at its points."""

    def __init__(self, name, points, radii):
        # Whole millimetres and tenths: the MTG has no finer ones, and both files say the same.
        self.name = name
        self.points = [tuple(round(c, 3) for c in p) for p in points]
        self.radii = [round(r, 5) for r in radii]
        self.branches = {}  # index of a point: axes

    def add(self, point, axis):
        self.branches.setdefault(point, []).append(axis)
        return axis

    def all(self):
        yield self
        for axes in self.branches.values():
            for axis in axes:
                yield from axis.all()


def shoot(name, foot, azimuth, rise, droop, length, r0, r1, count, rng):
    """An axis that leaves `foot` at the angle `rise` (rad) and bends down by `droop` on its way."""
    points, at = [foot], list(foot)
    for k in range(count):
        angle = rise - droop * k / max(1, count - 1) + rng.uniform(-0.06, 0.06)
        around = azimuth + rng.uniform(-0.1, 0.1)
        step = length / count
        at = [at[0] + step * math.cos(angle) * math.cos(around),
              at[1] + step * math.cos(angle) * math.sin(around),
              at[2] + step * math.sin(angle)]
        points.append(tuple(at))
    radii = [r0 + (r1 - r0) * k / count for k in range(count + 1)]
    return Axis(name, points, radii)


def grow(rng):
    heights = [0.0, 0.3]
    heights += [0.55 + (TRUNK - 0.7) * i / (BRANCHES - 1) for i in range(BRANCHES)]
    heights += [TRUNK]
    trunk = Axis("trunk",
                 [(0.012 * math.sin(3.1 * z), 0.010 * math.sin(2.3 * z), z) for z in heights],
                 [0.024 - 0.019 * z / TRUNK for z in heights])
    for i in range(BRANCHES):
        z = i / (BRANCHES - 1)
        branch = trunk.add(i + 2, shoot(
            f"branch_{i + 1}", trunk.points[i + 2], GOLDEN * i, 0.35 + 0.5 * z, 0.5 - 0.2 * z,
            (0.85 - 0.55 * z) * rng.uniform(0.9, 1.1), 0.010 - 0.005 * z, 0.0035 - 0.001 * z,
            6 - round(2 * z), rng))
        for k in range(1, len(branch.points)):
            if k == len(branch.points) - 1 and i % 2:
                continue
            side = GOLDEN * i + (1 if k % 2 else -1) * rng.uniform(0.6, 1.1)
            branch.add(k, shoot(f"twig_{i + 1}_{k}", branch.points[k], side, rng.uniform(0.2, 0.8),
                                0.3, rng.uniform(0.07, 0.16), 0.0028, 0.0018, 2, rng))
    return trunk


def numbers(values):
    return "[" + ", ".join(f"{v + 0.0:g}" for v in values) + "]"


def plant_text(trunk, rng):
    curves, fruits, leaves = [], [], []

    def add_curve(name, points, radii):
        shown = ", ".join(numbers(round(c, 4) for c in p) for p in points)
        curves.append(f"  - {{name: {name}, points: [{shown}], radius: {numbers(radii)}}}")

    for axis in trunk.all():
        add_curve(axis.name, axis.points, axis.radii)
        if not axis.name.startswith("twig"):
            continue
        foot, tip = axis.points[0], axis.points[-1]
        around = math.atan2(tip[1] - foot[1], tip[0] - foot[0])
        if rng.random() < 0.35:
            number = len(fruits) + 1
            out = (0.004 * math.cos(around), 0.004 * math.sin(around))
            points = [tip, (tip[0] + out[0], tip[1] + out[1], tip[2] - 0.3 * STALK),
                      (tip[0] + out[0], tip[1] + out[1], tip[2] - STALK)]
            add_curve(f"stalk_{number}", points, [0.0013] * 3)
            fruits.append(f"  - {{name: apple_{number}, curve: stalk_{number}, at: 1.0, "
                          f"radius: {rng.uniform(0.032, 0.037):.4f}, density: 850, "
                          "detach: {force: 20}}")
        for at, turn in ((0.6, 1.0), (0.97, -0.3)):
            way = around + turn + rng.uniform(-0.2, 0.2)
            fall = rng.uniform(-1.0, -0.1)
            direction = (math.cos(way), math.sin(way), fall)
            normal = (-fall * math.cos(way), -fall * math.sin(way), 1.0)
            leaves.append(f"  - {{name: leaf_{len(leaves) + 1}, curve: {axis.name}, at: {at}, "
                          f"template: apple, size: {rng.uniform(0.08, 0.11):.3f}, "
                          f"normal: {numbers(round(c, 3) for c in normal)}, "
                          f"direction: {numbers(round(c, 3) for c in direction)}}}")
    return (HEAD + "\n".join(curves) + "\nfruits:\n" + "\n".join(fruits) + "\nleaves:\n" +
            "\n".join(leaves) + "\n")


def mtg_text(trunk):
    lines = []

    def add(axis, depth):
        for k, (point, radius) in enumerate(zip(axis.points, axis.radii)):
            if k == 0 and depth > 0:
                continue  # the parent's point
            first = k == (1 if depth > 0 else 0)
            sign = ("+" if depth > 0 else "^/") if first else "^<"
            place = [round(1000 * c) for c in point] + [round(20000 * radius)]
            lines.append("\t" * depth + f"{sign}E{k + 1}" + "\t" * (3 - depth) +
                         "\t".join(str(v) for v in place))
            for branch in axis.branches.get(k, []):
                add(branch, depth + 1)

    add(trunk, 0)
    return MTG_HEAD + "\n".join(lines) + "\n"


def main():
    here = pathlib.Path(__file__).resolve().parent.parent / "plants"
    parser = argparse.ArgumentParser(description="Draws the apple tree, as a plant file and an MTG.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=here,
                        help="where they are written (default: plants)")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    rng = random.Random(5)
    trunk = grow(rng)
    (folder / "apple_tree.plant.yaml").write_text(plant_text(trunk, rng))
    (folder / "apple_tree.mtg").write_text(mtg_text(trunk))


if __name__ == "__main__":
    main()
