"""Rooms do not use each other in a circle. Static libraries may, for all that CMake says."""


def circle_of(rooms):
    """A circle of rooms, the first one again at its end; empty: there is none. `rooms`: what each uses."""
    done = set()

    def from_here(room, way):
        if room in way:
            return way[way.index(room) :] + [room]
        if room in done:
            return []
        for used in sorted(rooms.get(room, ())):
            if used != room and (found := from_here(used, way + [room])):
                return found
        done.add(room)
        return []

    for room in sorted(rooms):
        if found := from_here(room, []):
            return found
    return []


def check(rooms):
    """`rooms`: the Room of each folder."""
    circle = circle_of({folder: room.links | room.passes_on for folder, room in rooms.items()})
    return [(f"{circle[0]}/CMakeLists.txt", 1, "rooms in a circle: " + " -> ".join(circle))] if circle else []
