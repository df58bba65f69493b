#!/usr/bin/env python3
"""A subscriber and publisher of Eclipse Cyclone DDS, which shares no code with the program, hears all
topics of a run and leads a joint. Usage: ros2_test.py PEDICEL PEER SCENE"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

LOOPBACK = ('<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="false"/>'
            '</Interfaces></General><Discovery><Peers><Peer address="127.0.0.1"/></Peers>'
            '<ParticipantIndex>auto</ParticipantIndex></Discovery></Domain></CycloneDDS>')
CAMERA = ("  - {name: top view, eye: [1.2, -0.9, 0.8], target: [0.6, 0, 0.4], size: [48, 32], rate: 4, "
          "sensors: [rgb, depth, points]}\n")


def with_camera(scene, folder):
    """The scene with a camera more, beside the files that it names."""
    assets = scene.parent.parent
    shutil.copytree(assets.parent / "plants", folder / "plants")
    shutil.copytree(assets / "robots", folder / "assets/robots")
    (folder / "assets/scenes").mkdir()
    file = folder / "assets/scenes/run.scene.yaml"
    file.write_text(scene.read_text().replace("cameras:\n", "cameras:\n" + CAMERA, 1))
    return file


def check_camera(topics):
    if topics["/top_view/camera_info"][0] == 0:
        return print("no pictures can be taken here; the camera is left out")
    for name in ("image", "depth_image", "camera_info", "points"):
        assert topics["/top_view/" + name][0] >= 5, name
    assert topics["/top_view/image"][1] == f"top_view_optical_frame 48x32 rgb8 {48 * 32 * 3}"
    assert topics["/top_view/depth_image"][1] == f"top_view_optical_frame 48x32 32FC1 {48 * 32 * 4}"
    assert topics["/top_view/camera_info"][1] == "48x32 24.0 16.0 plumb_bob"
    assert topics["/top_view/points"][1] == f"48x32 4 {48 * 32 * 16}"


def main(program, peer, scene):
    with tempfile.TemporaryDirectory() as folder:
        check(program, peer, with_camera(pathlib.Path(scene), pathlib.Path(folder)))


def check(program, peer, scene):
    domain = str(100 + os.getpid() % 100)
    server = subprocess.Popen([program, scene, "--ros", "--domain", domain],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        heard = subprocess.run([peer, domain, "5", "joint1", "0.3"], env=os.environ | {"CYCLONEDDS_URI": LOOPBACK},
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
    finally:
        server.send_signal(signal.SIGINT)
        said = server.communicate(timeout=30)[1]
    print(heard.stdout, heard.stderr, said)
    assert heard.returncode == 0, "the peer failed"
    assert server.returncode == 130, f"exit code {server.returncode}"
    assert "0 messages refused" in said, said
    topics = {}
    for line in heard.stdout.splitlines():
        name, count, *rest = line.split(" ", 2)
        topics[name] = (int(count), rest[0] if rest else "")
    least = {"/clock": 100, "/joint_states": 100, "/joint_commands": 100, "/tf": 100, "/tf_static": 1,
             "/robot_description": 1, "/wrist/wrench": 200, "/organ_forces": 100, "/plant": 10, "/bodies": 10}
    for name, count in least.items():
        assert topics[name][0] >= count, f"{name}: {topics[name][0]} messages, expected {count}"
    assert topics["/tf_static"][0] == topics["/robot_description"][0] == 1, "latched topics come once"
    assert "<robot name=" in topics["/robot_description"][1] or "<?xml" in topics["/robot_description"][1]
    assert "flange" in topics["/wrist/wrench"][1]
    assert re.search(r"truss/fruit_1\b", topics["/tf"][1]), topics["/tf"]
    assert "truss/stems" in topics["/plant"][1]
    check_camera(topics)
    assert topics["sent"][0] == 1, "the trajectory was not sent"
    joint = float(re.search(r"joint1=(-?[\d.]+)", topics["/joint_states"][1]).group(1))
    assert abs(joint - 0.3) < 0.01, f"joint1 is at {joint}, expected 0.3"


if __name__ == "__main__":
    main(*sys.argv[1:])
