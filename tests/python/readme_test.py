"""The README's line that imports the module works after tools/run alone, from the tree's root."""

import os
import re
import subprocess
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "../.."))
BUILT = os.environ["PYTHONPATH"].split(":")[0]


def text(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


class ReadmeTest(unittest.TestCase):
    def test_its_line_says_the_version(self):
        (line,) = re.findall(r"`([^`]*import pedicel;[^`]*)`", text("README.md"))
        self.assertIn("PYTHONPATH=build/release/python ", line)
        line = line.replace("build/release/python", BUILT)
        bare = {"PATH": os.defpath, "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(line, shell=True, cwd=ROOT, env=bare, capture_output=True, text=True, check=False)
        (version,) = re.findall(r"project\(pedicel VERSION (\S+)", text("CMakeLists.txt"))
        self.assertEqual((done.stdout.strip(), done.stderr), (version, ""))

    def test_run_builds_the_module(self):
        self.assertRegex(text("tools/run"), r"(?m)^build_targets release pedicel_python$")


if __name__ == "__main__":
    unittest.main()
