"""h5py and h5dump read the log of a run. Usage: h5_test.py PEDICEL SCENE"""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    print("python3-h5py is not there; skipped")
    sys.exit(77)

CAMERA = "  - {name: top view, eye: [1.2, -0.9, 0.8], target: [0.6, 0, 0.4], size: [48, 32], rate: 20, sensors: [rgb, depth, points]}\n"


def with_camera(scene, folder):
    """The scene with a camera more, beside the files that it names."""
    text = scene.read_text().replace("cameras:\n", "cameras:\n" + CAMERA, 1)
    assert CAMERA in text
    assets = scene.parent.parent
    shutil.copytree(assets.parent / "plants", folder / "plants")
    shutil.copytree(assets / "robots", folder / "assets/robots")
    (folder / "assets/scenes").mkdir()
    (folder / "assets/scenes/run.scene.yaml").write_text(text)
    return folder / "assets/scenes/run.scene.yaml"


def main(program, scene):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        log, out = folder / "run.h5", folder / "out"
        run = subprocess.run([program, with_camera(pathlib.Path(scene), folder), "--headless", "--no-video", "--no-sweep",
                              "--quiet", "--steps", "240", "--log", log, "--out", out],
                             stderr=subprocess.PIPE, text=True, timeout=90)
        if "built without HDF5" in run.stderr:
            print(run.stderr, "skipped")
            sys.exit(77)
        assert run.returncode in (0, 5), run.stderr
        table = list(csv.DictReader(open(out / "log.csv")))
        with h5py.File(log) as data:
            names = [str(one) for one in data["joint_states"].attrs["names"]]
            assert "joint1" in names, names
            states = data["joint_states"]
            # The log has joints at each step, from 0 s on; the table begins with the first step.
            steps = list(states["time"])
            assert len(steps) == len(states["position"]) > 2 * len(table), (len(steps), len(table))
            for row in table[1:]:
                step = min(range(len(steps)), key=lambda i: abs(steps[i] - float(row["time_s"])))
                assert abs(float(row["time_s"]) - steps[step]) < 1e-9
                assert abs(float(row["joint_joint1_rad"]) - states["position"][step][names.index("joint1")]) < 1e-7, row
            assert data["tf/truss/fruit_1"].attrs["parent"] == "world"
            assert data["tf/truss/fruit_1/position"].shape == (len(table), 3)
            assert data["wrist/wrench/force"].shape[1] == 3 and abs(data["wrist/wrench/force"][-1]).max() > 0.1
            assert [str(one) for one in data["joint_commands"].attrs["names"]] == names
            assert data["joint_commands/position"].shape == data["joint_states/effort"].shape == (len(steps), len(names))
            turns = data["tf/truss/fruit_1/orientation"]
            assert turns.shape == (len(table), 4) and abs((turns[-1] ** 2).sum() - 1) < 1e-9
            held = data["organ_forces/truss/fruit_5"]
            assert held["values"].shape[1] == len(held.attrs["names"]) in (5, 6), list(held.attrs["names"])
            assert data["robot_description/text"][0].decode().lstrip().startswith("<")
            if "top_view" in data:
                image, depth = data["top_view/image/data"], data["top_view/depth_image/data"]
                assert image.shape[1:] == (32, 48, 3) and depth.shape[1:] == (32, 48) and len(image) == len(depth) >= 3
                assert image[0].std() > 5 and 0.5 < depth[0].min() < 2, "something is seen"
                k = data["top_view/camera_info/k"][0]
                assert k[0][2] == 24 and k[1][2] == 16, k
            else:
                print("no pictures can be taken here; the camera is left out")
        if shutil.which("h5dump"):
            said = subprocess.run(["h5dump", "-d", "/joint_states/time", log], stdout=subprocess.PIPE, text=True, timeout=30)
            assert said.returncode == 0 and "H5T_IEEE_F64LE" in said.stdout, said.stdout[:500]


if __name__ == "__main__":
    main(*sys.argv[1:])
