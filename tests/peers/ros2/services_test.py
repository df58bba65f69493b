#!/usr/bin/env python3
"""A client of Fast DDS with ROS 2's naming calls services and actions of a run.
Usage: services_test.py PEDICEL CLIENT SCENE"""
import os
import signal
import subprocess
import sys


def main(program, client, scene):
    domain = str(100 + os.getpid() % 100)
    server = subprocess.Popen([program, scene, "--ros", "--domain", domain], stderr=subprocess.PIPE, text=True)
    try:
        called = subprocess.run([client, domain], stdout=subprocess.PIPE, text=True, timeout=100)
    finally:
        server.send_signal(signal.SIGINT)
        said = server.communicate(timeout=30)[1]
    print(called.stdout, said)
    assert called.returncode == 0, "not all is as it should be"
    assert server.returncode == 130, f"exit code {server.returncode}"
    assert "3 messages refused" in said, said


if __name__ == "__main__":
    main(*sys.argv[1:])
