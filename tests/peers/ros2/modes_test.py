#!/usr/bin/env python3
"""How time goes in a node of ROS 2 (paced, as fast as it can, held), its namespace, and where its traffic goes, as a peer of
Eclipse Cyclone DDS and the kernel see them. Usage: modes_test.py PEDICEL PEER SCENE"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

from ros2_test import LOOPBACK

SECONDS = 4
STEPS = 240  # Hz, of the scene


def udp_addresses(pid):
    """Of the process's sockets of UDP, over IPv4 and IPv6: where each is bound."""
    inodes = set()
    for one in pathlib.Path(f"/proc/{pid}/fd").iterdir():
        try:
            found = re.match(r"socket:\[(\d+)\]", os.readlink(one))
        except OSError:
            continue
        if found:
            inodes.add(found.group(1))
    addresses = []
    for table in ("udp", "udp6", "tcp", "tcp6"):
        file = pathlib.Path(f"/proc/{pid}/net/{table}")
        for line in file.read_text().splitlines()[1:] if file.exists() else []:
            fields = line.split()
            if fields[9] in inodes:
                host, port = fields[1].split(":")
                octets = ".".join(str(int(host[i:i + 2], 16)) for i in (6, 4, 2, 0)) if len(host) == 8 else host
                addresses.append((table, octets, int(port, 16)))
    return addresses


def multicast_interfaces():
    """Interfaces on which somebody of this machine has joined the group that DDS announces itself to."""
    joined, name = set(), ""
    for line in pathlib.Path("/proc/self/net/igmp").read_text().splitlines()[1:]:
        if not line.startswith("\t"):
            name = line.split()[1]
        elif line.split()[0] == "0100FFEF":
            joined.add(name)
    return joined


def waits(pid):
    """How often the simulation's thread lay down by itself while a peer listens."""
    count = lambda: int(re.search(r"^voluntary_ctxt_switches:\s+(\d+)",
                                  pathlib.Path(f"/proc/{pid}/task/{pid}/status").read_text(), re.M).group(1))
    before = count()
    time.sleep(0.7 * SECONDS)
    return count() - before


def heard(program, peer, scene, *options, look=None):
    """What a peer hears of a node in some seconds: its last /clock (None: none), what it finds, seconds of wall time."""
    domain = str(100 + os.getpid() % 100)
    server = subprocess.Popen([program, scene, "--ros", "--domain", domain, "--no-pictures", *options],
                              stderr=subprocess.PIPE, text=True)
    try:
        assert "this machine only" in server.stderr.readline()
        start = time.monotonic()
        listener = subprocess.Popen([peer, domain, str(SECONDS), "joint1", "0.3"], stdout=subprocess.PIPE, text=True,
                                    env=os.environ | {"CYCLONEDDS_URI": LOOPBACK})
        if look:
            look(server.pid)
        out = listener.communicate(timeout=60)[0]
        wall = time.monotonic() - start
    finally:
        server.send_signal(signal.SIGINT)
        said = server.communicate(timeout=30)[1]
    assert server.returncode == 130, (server.returncode, said)
    clock = re.search(r"^/clock (\d+) ?([\d.]*)", out, re.M)
    return (float(clock.group(2)) if int(clock.group(1)) else None), out, wall, said


def stays_here(pid, joined_before):
    # The kernel hands out what comes to an address, and sends from it: only the loopback's own, and the group's socket.
    addresses = udp_addresses(pid)
    assert addresses, "it has sockets"
    others = [one for one in addresses if one[1] not in ("127.0.0.1", "239.255.0.1")
              and not (one[1] == "0.0.0.0" and one[2] % 250 == 7400 % 250)]
    assert not others, others
    # The kernel says which interfaces joined, not whose sockets did: what others had joined before is not ours.
    assert multicast_interfaces() <= joined_before | {"lo"}, multicast_interfaces()


def main(*files):
    sleeps = []
    joined_before = multicast_interfaces()
    clock, _, wall, _ = heard(*files, look=lambda pid: stays_here(pid, joined_before))
    # How well it keeps its pace is measured by tools/ros_hour: a machine that has other work does not.
    assert 0.1 * wall < clock < 1.02 * wall + 0.1, f"paced: {clock} s in {wall} s"
    clock, _, wall, _ = heard(*files, "--pace", "0.5")
    assert 0.05 * wall < clock < 0.51 * wall + 0.1, f"half as fast: {clock} s in {wall} s"
    # How fast that is depends on the machine; it never lies down between two steps.
    clock, _, wall, _ = heard(*files, "--pace", "0", look=lambda pid: sleeps.append(waits(pid)))
    assert sleeps[0] < 0.02 * STEPS * clock, f"{sleeps[0]} waits in {clock} s, as fast as it can"
    clock, out, _, said = heard(*files, "--paused", "--namespace", "/left")
    assert clock is None and "0.000 s simulated" in said, (clock, said)
    found = {line.split(" ")[1] for line in out.splitlines() if line.startswith(("writer ", "reader "))}
    assert {"rt/clock", "rt/tf", "rt/tf_static", "rt/left/joint_states", "rt/left/joint_trajectory", "rt/left/plant",
            "rq/left/step_simulationRequest", "rr/left/step_simulationReply",
            "rq/left/arm_controller/follow_joint_trajectory/_action/send_goalRequest"} <= found, sorted(found)
    assert not [name for name in found if "/left/" not in name and name not in ("rt/clock", "rt/tf", "rt/tf_static")], found


if __name__ == "__main__":
    main(*sys.argv[1:])
