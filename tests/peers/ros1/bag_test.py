#!/usr/bin/env python3
"""Bags that ROS 1's own library wrote, packed and not, become an experiment.
Usage: bag_test.py PEDICEL WRITER SCENE"""
import csv
import pathlib
import subprocess
import sys
import tempfile


def rows(file):
    with open(file) as text:
        return [{key: float(value) if value else None for key, value in row.items()} for row in csv.DictReader(text)]


def check(program, bag, scene, out):
    said = subprocess.run([program, "import", bag, "--scene", scene, "--out", out],
                          stderr=subprocess.PIPE, text=True, timeout=60)
    assert said.returncode == 0, said.stderr
    assert "cut off" not in said.stderr, said.stderr
    map_text = (out / "map.yaml").read_text()
    assert "/tracker/pose" in map_text and "/camera/image (sensor_msgs/msg/Image)" in map_text, map_text
    trial = out / bag.stem
    joints = rows(trial / "joints.csv")
    assert len(joints) == 51, len(joints)
    for i, row in enumerate(joints):
        assert abs(row["time"] - 0.01 * i) < 1e-6, row
        assert row["joint1"] == -0.001 * i and row["joint2"] == 0.002 * i, row
    wrench = rows(trial / "wrench_wrist.csv")
    assert len(wrench) == 51 and wrench[50]["fz"] == -5.0 and wrench[50]["tx"] == 0.5, wrench[50]
    # The fruit is off from 0.3 s on; a double of seconds since 1970 knows that to 0.2 us.
    fruit = [row for row in rows(trial / "markers.csv") if row["fruit_1.x"] is not None]
    assert len(fruit) in (30, 31) and abs(fruit[29]["fruit_1.x"] - 0.529) < 1e-12, fruit[-1]
    events = (trial / "events.csv").read_text().splitlines()
    assert len(events) == 2 and events[1].split(",")[1:3] == ["detached", "fruit_1"], events


def main(program, writer, scene):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for packing in ("none", "bz2", "lz4"):
            bag = folder / f"{packing}.bag"
            subprocess.run([writer, bag, packing], check=True, timeout=30)
            check(program, bag, scene, folder / packing)
        # Cut off, as a recorder that was killed leaves it.
        whole = (folder / "none.bag").read_bytes()
        (folder / "cut.bag").write_bytes(whole[:len(whole) // 2])
        said = subprocess.run([program, "import", folder / "cut.bag", "--scene", scene, "--out", folder / "cut"],
                              stderr=subprocess.PIPE, text=True, timeout=60)
        assert said.returncode == 0 and "the file is cut off" in said.stderr, said.stderr
        assert 5 < len(rows(folder / "cut/cut/joints.csv")) < 51


if __name__ == "__main__":
    main(*sys.argv[1:])
