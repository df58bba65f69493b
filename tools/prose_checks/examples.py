"""Files that a page shows are read by the program: plants and leaf templates that begin with `format:`.

One that a console block of the same page shows with an error must be refused.
"""

import re
import tempfile
from pathlib import Path

ENDINGS = {"pedicel-plant": ".plant.yaml", "pedicel-leaf": ".leaf.yaml"}


def check(page, program):
    faults = []
    refused = " ".join(line for _, language, _, lines in page.blocks if language == "console"
                       for _, line in lines if ": error: " in line)
    for number, language, _, lines in page.blocks:
        kind = re.match(r"format: (\S+)", lines[0][1]) if language == "yaml" and lines else None
        if not kind or kind.group(1) not in ENDINGS:
            continue
        text = "\n".join(line for _, line in lines) + "\n"
        name = re.search(r"^name: (.*)$", text, re.M).group(1)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / ("example" + ENDINGS[kind.group(1)])
            file.write_text(text, encoding="utf-8")
            result = program.run("validate", str(file))
        good = not re.search(rf"\b{re.escape(name)}\.(?:plant|leaf)\.yaml:\d", refused)
        if good != (result.returncode == 0):
            faults.append((number, f"this file is {'refused' if good else 'good'}: "
                                   + (result.stderr or result.stdout).strip().splitlines()[0]))
    return faults
