"""Rows of reference tables are what the program's own descriptions say.

`pedicel manual --rows` prints PAGE, the number of cells that say which row it is, and the row.
"""

import re


def cells_of(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def wanted(text):
    """(page, key cells, row) of every line."""
    found = []
    for line in text.splitlines():
        page, keys, row = line.split("\t")
        found.append((page + ".md", tuple(cells_of(row)[: int(keys)]), row))
    return found


def row_of(key, row, lines):
    """Index of the page's row of that key and as many cells; None where there is none."""
    width = len(cells_of(row))
    for index, line in enumerate(lines):
        if line.startswith("|"):
            cells = cells_of(line)
            if len(cells) == width and tuple(cells[: len(key)]) == key:
                return index
    return None


def check(name, page, text):
    """(line, fault) of rows of the page that are missing or say something else."""
    faults = []
    for wanted_page, key, row in wanted(text):
        if wanted_page != name:
            continue
        index = row_of(key, row, page.lines)
        if index is None:
            faults.append((1, f"the row {' '.join(key)} is missing: {row}"))
        elif page.lines[index] != row:
            faults.append((index + 1, f"expected the row as the program describes it: {row}"))
    return faults


def update(name, lines, text):
    """The page's lines with its rows as the program describes them."""
    lines = list(lines)
    for wanted_page, key, row in wanted(text):
        if wanted_page == name and (index := row_of(key, row, lines)) is not None:
            lines[index] = row
    return lines
