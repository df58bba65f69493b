"""The files and folders that the tables of a folder's README name are in that folder.

A table of files has "file", "folder" or "header" first in its head. `solver` stands for solver.h and
solver.cpp; words in capitals stand for any name.
"""

import re

from .page import CODE

HEADS = ("file", "folder", "header")


def tables(page):
    """(first cell of the head, rows below it) of every table."""
    found, head, rows, last = [], None, [], -1
    for number, _, cells in page.rows:
        if number != last + 1:
            head, rows = cells, []
            found.append((head[0], rows))
        elif not all(re.fullmatch(r":?-+:?", cell) for cell in cells if cell):
            rows.append((number, cells))
        last = number
    return found


def is_there(folder, name):
    if re.search(r"[A-Z]{3,}", name):
        return True
    return (folder / name).exists() or any(folder.glob(name if "*" in name else name + ".*"))


def check(page):
    if page.path.name != "README.md":
        return []
    folder, faults = page.path.parent, []
    for head, rows in tables(page):
        first = head.split()[0].strip(",") if head else ""
        inside = re.search(r"`([\w/]+)`", head)  # "file of `peers/`"
        for number, cells in rows if first in HEADS else []:
            place = folder / inside.group(1) if inside else folder
            faults += [
                (number, f"`{name}` is not in this folder")
                for name in CODE.findall(cells[0])
                if not is_there(place, name)
            ]
    return faults
