#!/usr/bin/env python3
"""A subscriber and publisher of Eclipse Cyclone DDS, which shares no code with the program, hears all
topics of a run and leads a joint. Usage: ros2_test.py PEDICEL PEER SCENE"""
import os
import re
import signal
import subprocess
import sys

LOOPBACK = ('<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="false"/>'
            '</Interfaces></General><Discovery><Peers><Peer address="127.0.0.1"/></Peers>'
            '<ParticipantIndex>auto</ParticipantIndex></Discovery></Domain></CycloneDDS>')


def main(program, peer, scene):
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
    assert topics["sent"][0] == 1, "the trajectory was not sent"
    joint = float(re.search(r"joint1=(-?[\d.]+)", topics["/joint_states"][1]).group(1))
    assert abs(joint - 0.3) < 0.01, f"joint1 is at {joint}, expected 0.3"


if __name__ == "__main__":
    main(*sys.argv[1:])
