#!/usr/bin/env python3
"""Draws the visual meshes of assets/robots/stalk6 (also used by gantry_gripper) as OBJ files.

Closed solids of revolution and rounded boxes in each link's own frame, one file a colour. Lengths
in metres. Run from anywhere: tools/make_robot_meshes.py [FOLDER]
"""
import argparse
import math
import pathlib

SIDES = 28  # of a solid of revolution
ARC = 3     # steps of a rounded edge


class Mesh:
    def __init__(self):
        self.vertices, self.triangles = [], []

    def add(self, vertices, triangles):
        first = len(self.vertices)
        self.vertices += vertices
        self.triangles += [tuple(first + i for i in t) for t in triangles]
        return self

    def tube(self, start, end, r0, r1=None, edge=0.006):
        """A cylinder or cone from start to end with rounded edges."""
        r1 = r0 if r1 is None else r1
        axis = [b - a for a, b in zip(start, end)]
        length = math.sqrt(sum(c * c for c in axis))
        edge = min(edge, 0.5 * length, r0, r1)
        profile = []
        for k in range(ARC + 1):
            a = 0.5 * math.pi * k / ARC
            profile.append((r0 - edge + edge * math.sin(a), edge - edge * math.cos(a)))
        for k in range(ARC + 1):
            a = 0.5 * math.pi * k / ARC
            profile.append((r1 - edge + edge * math.cos(a), length - edge + edge * math.sin(a)))
        return self.add(*revolve(profile, start, [c / length for c in axis], length))

    def box(self, centre, size, edge=0.004, cells=4):
        """A box with rounded edges: the points of a divided cube, pressed onto the rounded shape."""
        half = [0.5 * s for s in size]
        inner = [h - edge for h in half]
        for axis in range(3):
            for side in (-1, 1):
                self.add(*rounded_face(centre, half, inner, edge, axis, side, cells))
        return self

    def write(self, path):
        lines = ["# made by tools/make_robot_meshes.py"]
        lines += ["v %.6f %.6f %.6f" % tuple(v) for v in self.vertices]
        lines += ["f %d %d %d" % tuple(i + 1 for i in t) for t in self.triangles]
        path.write_text("\n".join(lines) + "\n")
        print(f"{path.name}: {len(self.triangles)} triangles")


def revolve(profile, start, axis, length):
    side = perpendicular(axis)
    up = cross(axis, side)
    point = lambda r, h, a: [start[i] + h * axis[i] + r * (math.cos(a) * side[i] + math.sin(a) * up[i])
                             for i in range(3)]
    vertices = [point(0.0, 0.0, 0.0), point(0.0, length, 0.0)]
    for r, h in profile:
        vertices += [point(r, h, 2.0 * math.pi * k / SIDES) for k in range(SIDES)]
    ring = lambda row, k: 2 + row * SIDES + k % SIDES
    triangles = []
    last = len(profile) - 1
    for k in range(SIDES):
        triangles.append((0, ring(0, k + 1), ring(0, k)))
        triangles.append((1, ring(last, k), ring(last, k + 1)))
        for row in range(last):
            a, b = ring(row, k), ring(row, k + 1)
            c, d = ring(row + 1, k), ring(row + 1, k + 1)
            triangles += [(a, b, d), (a, d, c)]
    return vertices, triangles


def rounded_face(centre, half, inner, edge, axis, side, cells):
    u, v = (axis + 1) % 3, (axis + 2) % 3
    # Rows of points lie densely in the rounded rims and at the ends of the flat middle.
    rim = [math.tan(0.25 * math.pi * k / cells) for k in range(cells + 1)]
    steps = lambda i: ([-inner[i] - edge * t for t in reversed(rim)] +
                       [inner[i] + edge * t for t in rim])
    vertices = []
    for a in steps(u):
        for b in steps(v):
            p = [0.0, 0.0, 0.0]
            p[axis], p[u], p[v] = side * half[axis], a, b
            core = [max(-inner[i], min(inner[i], p[i])) for i in range(3)]
            out = [p[i] - core[i] for i in range(3)]
            norm = math.sqrt(sum(c * c for c in out))
            vertices.append([round(centre[i] + core[i] + edge * out[i] / norm, 9) for i in range(3)])
    n = 2 * (cells + 1)
    triangles = []
    for i in range(n - 1):
        for j in range(n - 1):
            a, b, c, d = i * n + j, i * n + j + 1, (i + 1) * n + j, (i + 1) * n + j + 1
            quad = [(a, c, d), (a, d, b)]
            triangles += quad if side > 0 else [(t[0], t[2], t[1]) for t in quad]
    return vertices, triangles


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def perpendicular(axis):
    other = [0.0, 0.0, 1.0] if abs(axis[2]) < 0.9 else [1.0, 0.0, 0.0]
    c = cross(other, axis)
    norm = math.sqrt(sum(x * x for x in c))
    return [x / norm for x in c]


def ring(mesh, centre, axis, radius, width=0.005):
    """A thin coloured band around a tube."""
    start = [c - 0.5 * width * a for c, a in zip(centre, axis)]
    end = [c + 0.5 * width * a for c, a in zip(centre, axis)]
    return mesh.tube(start, end, radius, edge=0.0012)


def meshes():
    x, y, z = [1, 0, 0], [0, 1, 0], [0, 0, 1]
    yield "base_white", Mesh().tube([0, 0, 0.010], [0, 0, 0.171], 0.056, 0.041, 0.010)
    yield "base_grey", (Mesh().tube([0, 0, 0], [0, 0, 0.016], 0.074, 0.070, 0.004)
                        .box([-0.055, 0, 0.045], [0.045, 0.060, 0.060], 0.006))
    yield "base_accent", ring(Mesh(), [0, 0, 0.160], z, 0.0435)

    yield "shoulder_white", (Mesh().tube([0, 0, -0.0700], [0, 0, 0.010], 0.040, 0.0395)
                             .tube([0, -0.036, 0], [0, 0.071, 0], 0.0400, edge=0.010))
    yield "shoulder_grey", (Mesh().tube([0, -0.043, 0], [0, -0.030, 0], 0.034, edge=0.006)
                            .tube([0, 0.066, 0], [0, 0.0735, 0], 0.037, edge=0.002))

    yield "upper_arm_white", (Mesh().tube([0, 0, 0.0745], [0, 0, 0.132], 0.0400, edge=0.010)
                              .tube([0, 0, 0.106], [0.2002, 0, 0.106], 0.0320, 0.0300)
                              .tube([0.2002, 0, 0.052], [0.2002, 0, 0.132], 0.0390, edge=0.010))
    yield "upper_arm_grey", (Mesh().tube([0, 0, 0.126], [0, 0, 0.138], 0.034, edge=0.006)
                             .tube([0.2002, 0, 0.126], [0.2002, 0, 0.138], 0.033, edge=0.006)
                             .tube([0.2002, 0, 0.0465], [0.2002, 0, 0.056], 0.036, edge=0.002))
    yield "upper_arm_accent", ring(Mesh(), [0.100, 0, 0.106], x, 0.0325, 0.008)

    yield "elbow_white", (Mesh().tube([0, 0, -0.0440], [0, 0, 0.036], 0.0390, edge=0.010)
                          .tube([0, 0, 0], [0.087, 0, 0], 0.0330)
                          .tube([0.087, 0.032, 0], [0.087, -0.0345, 0], 0.0390, edge=0.010))
    yield "elbow_grey", (Mesh().tube([0, 0, 0.030], [0, 0, 0.0425], 0.033, edge=0.006)
                         .tube([0.087, 0.026, 0], [0.087, 0.039, 0], 0.033, edge=0.006))

    yield "forearm_white", (Mesh().tube([0, 0, -0.1920], [0, 0, -0.050], 0.0390, 0.0365, 0.012)
                            .box([0, -0.062, -0.050], [0.064, 0.040, 0.110], 0.012)
                            .tube([0, -0.0430, 0], [0, -0.0815, 0], 0.0370, edge=0.008))
    yield "forearm_grey", Mesh().tube([0, -0.076, 0], [0, -0.0860, 0], 0.031, edge=0.005)
    yield "forearm_accent", ring(Mesh(), [0, 0, -0.165], z, 0.0392, 0.008)

    yield "wrist_white", (Mesh().tube([0, 0, -0.034], [0, 0, 0.0415], 0.0380, edge=0.010)
                          .tube([0, -0.020, 0], [0, 0.0375, 0], 0.0370, edge=0.006))
    yield "wrist_grey", Mesh().tube([0, 0, -0.0395], [0, 0, -0.028], 0.032, edge=0.006)

    yield "flange_grey", Mesh().tube([0, 0, -0.0240], [0, 0, 0], 0.0385, 0.0370, 0.004)
    yield "flange_accent", ring(Mesh(), [0, 0, -0.014], z, 0.0390, 0.004)

    yield "gripper_grey", (Mesh().tube([0, 0, 0], [0, 0, 0.012], 0.0360, edge=0.003)
                           .box([0, 0, 0.060], [0.030, 0.088, 0.010], 0.003, 2))
    yield "gripper_white", Mesh().box([0, 0, 0.034], [0.054, 0.084, 0.048], 0.010)
    yield "gripper_accent", Mesh().box([0, 0, 0.034], [0.0552, 0.060, 0.005], 0.001, 2)

    # The left finger; its inner face is y = 0. The right one is the same, turned about z.
    yield "finger_grey", (Mesh().box([0, 0.0095, 0.073], [0.024, 0.019, 0.016], 0.003, 2)
                          .box([0, 0.0080, 0.1075], [0.018, 0.008, 0.065], 0.003, 2))
    yield "finger_accent", Mesh().box([0, 0.0020, 0.120], [0.020, 0.004, 0.030], 0.0015, 2)


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "assets/robots/stalk6/meshes"
    parser = argparse.ArgumentParser(description="Draws the visual meshes of our robots as OBJ.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=default,
                        help="where they are written (default: assets/robots/stalk6/meshes)")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for name, mesh in meshes():
        mesh.write(folder / f"{name}.obj")


if __name__ == "__main__":
    main()
