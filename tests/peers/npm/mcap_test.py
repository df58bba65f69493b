#!/usr/bin/env python3
"""Foxglove's reader of MCAP and of ROS 2's messages reads the log of a run.
Usage: mcap_test.py PEDICEL SCENE NPM_FOLDER"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

from npm_packages import installed

PACKAGES = ["@mcap/core@2.2.2", "@foxglove/rosmsg@5.0.5", "@foxglove/rosmsg2-serialization@3.1.0", "fzstd@0.1.1"]


def main(program, scene, npm):
    folder = installed(npm, PACKAGES)
    here = pathlib.Path(__file__).parent
    with tempfile.TemporaryDirectory() as out:
        log = pathlib.Path(out) / "run.mcap"
        subprocess.run([program, scene, "--headless", "--duration", "4", "--no-pictures", "--no-sweep", "--quiet",
                        "--out", f"{out}/run", "--log", log], timeout=120)
        # Node looks for packages beside the script.
        shutil.copy(here / "read_mcap.mjs", folder / "read_mcap.mjs")
        read = subprocess.run(["node", folder / "read_mcap.mjs", log], stdout=subprocess.PIPE, text=True, check=True,
                              timeout=120)
    found = json.loads(read.stdout)
    topics = found["topics"]
    assert found["profile"] == "ros2"
    assert found["whole"]
    assert found["statistics"] == found["streamed"] == sum(t["messages"] for t in topics.values())
    types = {"/clock": "rosgraph_msgs/msg/Clock", "/joint_states": "sensor_msgs/msg/JointState",
             "/joint_commands": "sensor_msgs/msg/JointState", "/tf": "tf2_msgs/msg/TFMessage",
             "/tf_static": "tf2_msgs/msg/TFMessage", "/robot_description": "std_msgs/msg/String",
             "/wrist/wrench": "geometry_msgs/msg/WrenchStamped",
             "/organ_forces": "control_msgs/msg/DynamicJointState", "/events": "std_msgs/msg/String",
             "/plant": "visualization_msgs/msg/MarkerArray", "/bodies": "visualization_msgs/msg/MarkerArray"}
    assert {name: topic["type"] for name, topic in topics.items()} == types, topics.keys()
    assert topics["/clock"]["last"] == {"clock": {"sec": 4, "nanosec": 0}}
    state = topics["/joint_states"]["last"]
    assert state["name"][0] == "joint1" and len(state["position"]) == len(state["effort"]) == 7
    assert topics["/robot_description"]["last"]["data"].endswith("</robot>\n")
    wrench = topics["/wrist/wrench"]["last"]
    assert wrench["header"]["frame_id"] == "flange"
    # The hand weighs 4.8 N, and hangs from the wrist.
    assert abs(math.hypot(*wrench["wrench"]["force"].values()) - 4.8) < 0.8, wrench
    event = json.loads(topics["/events"]["last"]["data"])
    assert event["event"] == "detached" and event["what"] == "truss/fruit_5", event
    frames = [t["child_frame_id"] for t in topics["/tf"]["last"]["transforms"]]
    assert "truss/fruit_5" in frames and "flange" in frames, frames
    markers = topics["/plant"]["last"]["markers"]
    assert markers[0]["ns"] == "truss/stems" and len(markers[0]["points"]) % 2 == 0
    assert not topics["/plant"]["last"]["markers"][0]["mesh_use_embedded_materials"]


if __name__ == "__main__":
    main(*sys.argv[1:])
