"""A folder has 25 .cpp files at most. Registries of one kind, a file each, may have more."""

from collections import Counter

MOST = 25
REGISTRIES = ("plugins/effects", "plugins/discrepancy/scene/effects")


def check(paths):
    """Paths of the files of the program."""
    counts = Counter(str(path.parent) for path in paths if path.suffix == ".cpp")
    return [
        (folder, 1, f"{count} .cpp files, expected at most {MOST}")
        for folder, count in sorted(counts.items())
        if count > MOST and folder not in REGISTRIES
    ]
