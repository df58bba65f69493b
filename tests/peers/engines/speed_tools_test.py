#!/usr/bin/env python3
"""Usage: speed_tools_test.py BUILD    The tools that measure Pedicel beside MuJoCo fill their tables."""
import ctypes.util
import pathlib
import re
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[3] / "tools"


def rows(tool, *options):
    """{first cells: numbers} of the table that it prints."""
    done = subprocess.run([TOOLS / tool, "--build", sys.argv[1], "--rounds", "1", *options], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"FAILED: {tool}: exit code {done.returncode}: {done.stderr}")
    lines = [line.strip("| ").split(" | ") for line in done.stdout.splitlines()[2:]]
    return {" ".join(cells[:-2]): [float(cell) for cell in cells[-2:]] for cells in lines}


def check(tool, found, *programs):
    for program in programs:
        measured = [numbers for row, numbers in found.items() if re.search(program, row)]
        if not measured or min(min(numbers) for numbers in measured) <= 0.0:
            sys.exit(f"FAILED: {tool}: no figure of {program}: {found}")


if not ctypes.util.find_library("mujoco"):
    print("skipped: libmujoco-dev is not installed (tools/packages-ci.txt)")
    sys.exit(77)
check("arm_speed", rows("arm_speed", "--seconds", "0.05"), "Bullet", "stem", "Python", "MuJoCo, arm alone", "ball joints")
check("row_speed", rows("row_speed", "--seconds", "0.05", "--plants", "1"), "Pedicel, 1 thread", "MuJoCo")
print("passed")
