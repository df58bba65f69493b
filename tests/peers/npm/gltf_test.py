#!/usr/bin/env python3
"""The Khronos validator finds nothing wrong with the moving scene of a run.
Usage: gltf_test.py PEDICEL SCENE NPM_FOLDER"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

from npm_packages import installed


def main(program, scene, npm):
    folder = installed(npm, ["gltf-validator@2.0.0-dev.3.10"])
    here = pathlib.Path(__file__).parent
    with tempfile.TemporaryDirectory() as out:
        film = pathlib.Path(out) / "run.glb"
        subprocess.run([program, scene, "--headless", "--duration", "4", "--no-pictures", "--no-sweep", "--quiet",
                        "--out", f"{out}/run", "--gltf", film], timeout=120)
        shutil.copy(here / "validate_gltf.mjs", folder / "validate_gltf.mjs")
        read = subprocess.run(["node", folder / "validate_gltf.mjs", film], stdout=subprocess.PIPE, text=True,
                              check=True, timeout=120)
        data = film.read_bytes()
    report = json.loads(read.stdout)
    issues = report["issues"]
    assert issues["numErrors"] == issues["numWarnings"] == 0, issues
    assert report["info"]["animationCount"] == 1 and report["info"]["hasSkins"], report["info"]
    # What moves is in it: the fruit that comes off is a node on the plant, and another one afterwards.
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    names = [node.get("name") for node in document["nodes"]]
    assert names.count("truss/fruit_5") == 2, names
    assert "flange" in names and "tray" in names
    scaled = [c for c in document["animations"][0]["channels"] if c["target"]["path"] == "scale"]
    assert {names[c["target"]["node"]] for c in scaled} >= {"truss/fruit_5"}, "what comes off goes"
    frames = document["accessors"][document["animations"][0]["samplers"][0]["input"]]
    assert frames["count"] == 121 and abs(frames["max"][0] - 4) < 0.01, frames


if __name__ == "__main__":
    main(*sys.argv[1:])
