"""The table of rooms on the page Architecture is what the CMakeLists.txt say: every library of a
folder, and what it links."""

import re

from .files import tables
from .page import CODE

LIBRARY = re.compile(r"^pedicel_library\((\w+)([^)]*)\)", re.M)


def rooms_of(root):
    """Per folder the folders of the libraries that it links."""
    found = {}
    for layer in ("app", "engine", "plugins"):
        for lists in sorted((root / layer).rglob("CMakeLists.txt")):
            for name, text in LIBRARY.findall(lists.read_text(encoding="utf-8")):
                found[name] = (str(lists.parent.relative_to(root)), re.findall(r"\bpedicel_\w+", text))
    return {
        folder: {found[name][0] for name in links if name in found} for folder, links in found.values()
    }


def check(page, rooms):
    faults, told = [], {}
    for head, rows in tables(page):
        if head == "room":
            told |= {CODE.findall(cells[0])[0]: (line, set(CODE.findall(cells[-1]))) for line, cells in rows}
    for room in sorted(rooms.keys() - told.keys()):
        faults.append((1, f"the room `{room}` is missing"))
    for room, (line, links) in told.items():
        if room not in rooms:
            faults.append((line, f"`{room}` is no room"))
        elif links != rooms[room]:
            expected = ", ".join(f"`{link}`" for link in sorted(rooms[room])) or "nothing"
            faults.append((line, f"`{room}` links {expected}"))
    return faults
