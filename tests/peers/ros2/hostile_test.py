#!/usr/bin/env python3
"""A client sends a node of ROS 2 all that it should refuse; the node refuses, counts, answers and goes on.
Usage: hostile_test.py PEDICEL CLIENT SCENE"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile


def memory(pid):
    """The most that a process has held, MB."""
    return int(re.search(r"VmHWM:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text()).group(1)) / 1024


def main(program, client, scene):
    domain = str(100 + os.getpid() % 100)
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "pipe")
        os.mkfifo(pipe)
        server = subprocess.Popen([program, scene, "--ros", "--domain", domain, "--no-pictures"], stderr=subprocess.PIPE,
                                  text=True)
        try:
            sent = subprocess.run([client, domain, pipe], stdout=subprocess.PIPE, text=True, timeout=240)
            held = memory(server.pid)
        finally:
            server.send_signal(signal.SIGINT)
            said = server.communicate(timeout=60)[1]
    print(sent.stdout, said, f"{held:.0f} MB")
    assert sent.returncode == 0, "not all is as it should be"
    assert server.returncode == 130, f"exit code {server.returncode}"
    malformed = int(re.search(r"^malformed (\d+)", sent.stdout, re.M).group(1))
    refused = int(re.search(r"(\d+) messages refused", said).group(1))
    assert refused == malformed, f"{refused} refused of {malformed}"
    assert held < 1000, f"{held} MB"


if __name__ == "__main__":
    main(*sys.argv[1:])
