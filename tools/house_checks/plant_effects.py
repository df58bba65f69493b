"""An effect of plants and measurements is one file: no other one knows it by name, but the laws of
joints, where a term of the kernels says whose it is.

A name that is a key of files as well (a modulus, a wind, a sensor's latency) is left alone, but in
the diagnosis, which asks for the numbers of the material by what they do.
"""

import re

EFFECTS = "plugins/effects"
LAWS = "plugins/cosserat/laws"
FOLDERS = ("app/", "plugins/")
KEYS = {"youngs_modulus", "density", "damping_time", "wind", "latency"}
DIAGNOSIS = "plugins/discrepancy/"
# The diagnosis of scenes reads files that have these keys.
OTHERS = {("plugins/discrepancy/files/experiment_lists.cpp", "wind")}
STRING = re.compile(r"//[^\n]*|\"((?:[^\"\\\n]|\\.)*)\"")


def strings_of(text):
    """(line, text) of every string; comments have none."""
    for found in STRING.finditer(text):
        if found.group(1) is not None:
            yield text.count("\n", 0, found.start()) + 1, found.group(1)


def effects_of(texts):
    return {path.stem for path in texts if str(path.parent) == EFFECTS and path.suffix == ".cpp"}


def check(texts):
    """`texts`: what each file holds."""
    own = effects_of(texts)

    def is_meant(path, said):
        if str(path).startswith(DIAGNOSIS):
            return said in own and (str(path), said) not in OTHERS
        return said in own - KEYS

    return [
        (str(path), line, f"names the effect {said}; expected a field of its definition")
        for path, text in texts.items()
        if str(path).startswith(FOLDERS) and str(path.parent) not in (EFFECTS, LAWS)
        for line, said in strings_of(text)
        if is_meant(path, said)
    ]
