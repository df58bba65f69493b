"""Nothing of the tree leans on what a clone does not have: pages elsewhere, files beside the checkout."""

import re

# Pages that only the makers have seen, and sections or rules of them.
PAGES = re.compile(r"\b(?:formats|design|house|conventions)\.md\b|\bsection \d+ of the formats\b|\bhabit \d+\b")
FILE = re.compile(r"\b(?:file|mesh|leaf_template): *([^\s,}#]+)")


def check_pages(texts):
    """`texts`: what each file holds."""
    return [
        (str(path), text.count("\n", 0, found.start()) + 1, f'"{found.group()}" is not in the repository')
        for path, text in texts.items()
        for found in PAGES.finditer(text)
    ]


def check_scenes(texts, root):
    """Every file that a scene names lies in the tree."""
    root, faults = root.resolve(), []
    for path, text in texts.items():
        for found in FILE.finditer(text):
            named = (root / path).parent / found.group(1).strip("\"'")
            line = text.count("\n", 0, found.start()) + 1
            if not named.resolve().is_relative_to(root):
                faults.append((str(path), line, f"{found.group(1)} lies outside the repository"))
            elif not named.exists():
                faults.append((str(path), line, f"{found.group(1)} is not there"))
    return faults
