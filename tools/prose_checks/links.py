"""Links, pictures, anchors, and the folders and files of the tree that a page names."""

import re

from .page import Page

PLACE = re.compile(r"^(?:app|assets|engine|plants|plugins|tests|tools)/[\w./-]*$")


def check(page, root):
    faults = []
    for line, target in page.links:
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        path = (page.path.parent / name) if name else page.path
        if not path.exists():
            faults.append((line, f"{target} is not there"))
        elif anchor and anchor not in (Page(path).anchors if name else page.anchors):
            faults.append((line, f"{target}: no heading of that name"))
    for line, code in page.code:
        if PLACE.match(code) and not re.search(r"[A-Z]{3,}", code.replace("README", "")):
            if not (root / code).exists():
                faults.append((line, f"`{code}` is not in the tree"))
    return faults
