#!/usr/bin/env python3
"""Usage: speed_tools_test.py BUILD    The tools that measure Pedicel beside MuJoCo fill their tables."""
import ctypes.util
import pathlib
import re
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[3] / "tools"


def rows(tool, *options):
    """{first cells: numbers} of the table that it prints, and the lines below it."""
    done = subprocess.run([TOOLS / tool, "--build", sys.argv[1], "--rounds", "1", *options], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"FAILED: {tool}: exit code {done.returncode}: {done.stderr}")
    lines = done.stdout.splitlines()[2:]
    table = [line.strip("| ").split(" | ") for line in lines if line.startswith("|")]
    below = " ".join(line for line in lines if not line.startswith("|"))
    return {" ".join(cells[:-2]): [float(cell) for cell in cells[-2:]] for cells in table}, below


def check(tool, found, *programs):
    for program in programs:
        measured = [numbers for row, numbers in found.items() if re.search(program, row)]
        if not measured or min(min(numbers) for numbers in measured) <= 0.0:
            sys.exit(f"FAILED: {tool}: no figure of {program}: {found}")


if not ctypes.util.find_library("mujoco"):
    print("skipped: libmujoco-dev is not installed (tools/packages-ci.txt)")
    sys.exit(77)
table, below = rows("arm_speed", "--seconds", "0.05")
check("arm_speed", table, "Bullet", "stem", "Python", "MuJoCo, arm alone", "ball joints")
if len(re.findall(r"[+-]\d+\.\d % \(", below)) != 2:
    sys.exit(f"FAILED: arm_speed: not two costs of Python: {below}")
check("row_speed", rows("row_speed", "--seconds", "0.05", "--plants", "1")[0], "Pedicel, 1 thread", "MuJoCo")
print("passed")
