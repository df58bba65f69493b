"""A file includes headers of its own room, and of rooms that it links: all rooms have one include
root, so a compiler takes any. Nothing goes up: engine knows neither plugins nor app, plugins no app."""

from pathlib import Path

from .source import LAYERS, includes_of

UPWARDS = ("engine", "plugins", "app")
# Highway's own headers are in quotes, as it wants them.
QUOTED_BY_OTHERS = ("hwy/",)


def room_of(path, rooms):
    """The nearest folder above a file that makes something; None: none does."""
    return next((str(folder) for folder in Path(path).parents if str(folder) in rooms), None)


def is_above(path, other):
    return UPWARDS.index(Path(path).parts[0]) > UPWARDS.index(Path(other).parts[0])


def reach_of(room, rooms):
    """Rooms whose headers the files of a room may include."""
    reached, open_rooms = {room}, list(rooms[room].links)
    while open_rooms:
        one = open_rooms.pop()
        if one not in reached:
            reached.add(one)
            open_rooms += rooms[one].passes_on
    return reached


def fault_of(path, name, quoted, texts, rooms, reach):
    """What is wrong with an include; empty: nothing."""
    if Path(name).parts[0] not in LAYERS:
        if not quoted or name.startswith(QUOTED_BY_OTHERS):
            return ""
        return f'includes "{name}"; expected its place in the tree from app, engine or plugins on'
    if Path(name) not in texts:
        return f"includes {name}, which is not there"
    if Path(name).suffix != ".h":
        return f"includes {name}; expected a header"
    if is_above(name, path):
        return f"includes {name}; expected nothing above {path.parts[0]}"
    own, other = room_of(path, rooms), room_of(name, rooms)
    if other in reach[own]:
        return ""
    return (f"includes {name}, which is a header of the room {other} that {own} does not link; "
            "expected a header of a room that it links")


def check(texts, rooms):
    """`texts`: what each file holds; `rooms`: the Room of each folder."""
    faults = [
        (f"{folder}/CMakeLists.txt", 1, f"links {linked}; expected nothing above {Path(folder).parts[0]}")
        for folder, room in sorted(rooms.items())
        for linked in sorted(room.links | room.passes_on)
        if is_above(linked, folder)
    ]
    reach = {room: reach_of(room, rooms) for room in rooms}
    for path, text in texts.items():
        if room_of(path, rooms) is None:
            faults.append((str(path), 1, "stands in no room; expected a CMakeLists.txt above it that makes one"))
            continue
        for line, name, quoted in includes_of(text):
            if said := fault_of(path, name, quoted, texts, rooms, reach):
                faults.append((str(path), line, said))
    return faults
