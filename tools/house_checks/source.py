"""C++ files as the checks of the house read them."""

import re
from pathlib import Path

LAYERS = ("app", "engine", "plugins")
NOT_CODE = re.compile(r'/\*.*?\*/|//[^\n]*|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
TYPE = re.compile(
    r"\b(?:class|struct)\s+(?:alignas\([^)]*\)\s*)?(?P<type>\w+)(?:\s+final)?(?:\s*:(?!:)[^;{}()]*)?\s*\{"
    r"|\benum\s+(?:class\s+)?(?P<enum>\w+)(?:\s*:(?!:)[^;{}()]*)?\s*\{"
)


def files(root):
    """Headers and sources of the program, as paths within the tree."""
    return sorted(
        path.relative_to(root)
        for layer in LAYERS
        for path in (Path(root) / layer).rglob("*")
        if path.suffix in (".h", ".cpp")
    )


def code_of(text):
    """The text without comments and lines of the preprocessor, and with empty strings; its lines keep
    their numbers."""
    def blank(found):
        return (" " if found.group().lstrip()[0] in "/#" else "\"\"") + "\n" * found.group().count("\n")

    return NOT_CODE.sub(blank, text)


def body_of(code, start):
    """What stands between the brace that ends before `start` and its partner; braces within as {}."""
    text, depth = [], 1
    for at in range(start, len(code)):
        letter = code[at]
        if letter == "}":
            depth -= 1
            if depth == 0:
                break
            if depth == 1:
                text.append("{}")
        elif letter == "{":
            depth += 1
        elif depth == 1:
            text.append(letter)
    return "".join(text)
