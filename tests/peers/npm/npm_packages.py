"""Packages of the npm registry that tests use as another's reader. Nothing of them is in this tree."""
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77


def installed(folder, packages):
    """The folder with these packages in it; ends the test as skipped, with a sentence, where they cannot be had."""
    folder = pathlib.Path(folder)
    if not shutil.which("node") or not shutil.which("npm"):
        print("skipped: node and npm are not installed (tools/packages-ci.txt)")
        sys.exit(SKIPPED)
    stamp = folder / "installed.txt"
    wanted = "\n".join(packages)
    if stamp.exists() and stamp.read_text() == wanted:
        return folder
    folder.mkdir(parents=True, exist_ok=True)
    try:
        done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--prefix", str(folder), *packages],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
        if done.returncode == 0:
            stamp.write_text(wanted)
            return folder
        print(done.stdout[-2000:])
    except subprocess.TimeoutExpired:
        pass
    print("skipped: the npm registry cannot be reached")
    sys.exit(SKIPPED)
