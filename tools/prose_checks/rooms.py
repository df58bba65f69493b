"""The rooms as the CMakeLists.txt say them, and what each links. The table of rooms on the page
Architecture is the same."""

import re
from dataclasses import dataclass, field

from .files import tables
from .page import CODE

LAYERS = ("app", "engine", "plugins")
COMMENT = re.compile(r"#[^\n]*")
LIBRARIES = ("pedicel_library", "pedicel_headers")
MAKERS = (*LIBRARIES, "pybind11_add_module", "add_executable")
CALL = re.compile(rf"^[ \t]*({'|'.join(MAKERS)}|target_link_libraries)\(\s*(\w+)([^)]*)\)", re.M)


@dataclass
class Room:
    library: bool = False  # or a program, or a module
    links: set = field(default_factory=set)  # folders of the rooms whose headers it may include
    passes_on: set = field(default_factory=set)  # those of whose headers who links it may include, too


def links_of(command, words):
    """(target, whether the room itself links it, whether it passes it on) of each word of a call."""
    # What a call that makes something names before its first keyword are options and files.
    kind = "PUBLIC" if command == "target_link_libraries" else ""
    for word in words:
        if word in ("SOURCES", "PUBLIC", "PRIVATE", "INTERFACE"):
            kind = word
        elif kind in ("PUBLIC", "PRIVATE", "INTERFACE"):
            yield word, kind != "INTERFACE", kind != "PRIVATE"


def all_rooms(root):
    """Per folder its Room, with programs and modules. What is linked under a condition counts, too."""
    calls, places, headers_alone = [], {}, set()
    for layer in LAYERS:
        for lists in sorted((root / layer).rglob("CMakeLists.txt")):
            folder = str(lists.parent.relative_to(root))
            for command, target, rest in CALL.findall(COMMENT.sub("", lists.read_text(encoding="utf-8"))):
                calls.append((folder, command, target, rest.split()))
                if command in MAKERS:
                    places[target] = folder
                if command == "pedicel_headers":
                    headers_alone.add(target)
    rooms = {folder: Room() for folder in places.values()}
    for folder, command, target, words in calls:
        room = rooms[places.get(target, folder)]
        room.library |= command in LIBRARIES
        for linked, itself, passed in links_of(command, words):
            if linked in places:
                if itself or target in headers_alone:
                    room.links.add(places[linked])
                if passed:
                    room.passes_on.add(places[linked])
    return rooms


def rooms_of(root):
    """Per folder of a library the folders of those that it links."""
    return {folder: room.links | room.passes_on for folder, room in all_rooms(root).items() if room.library}


def check_readmes(rooms, root):
    """Every room has a README."""
    return [
        (1, f"the room `{room}` has no README.md")
        for room in sorted(rooms)
        if not (root / room / "README.md").exists()
    ]


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
