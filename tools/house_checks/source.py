"""C++ files as the checks of the house read them."""

import re
from pathlib import Path

LAYERS = ("app", "engine", "plugins")
NOT_CODE = re.compile(r'/\*.*?\*/|//[^\n]*|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
TYPE = re.compile(
    r"\b(?:class|struct)\s+(?:alignas\([^)]*\)\s*)?(?P<type>\w+)(?:\s+final)?(?:\s*:(?!:)[^;{}()]*)?\s*\{"
    r"|\benum\s+(?:class\s+)?(?P<enum>\w+)(?:\s*:(?!:)[^;{}()]*)?\s*\{"
)
INCLUDE = re.compile(r'[ \t]*#[ \t]*include[ \t]*(?:"(?P<quoted>[^"\n]+)"|<(?P<angled>[^>\n]+)>)')


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


def includes_of(text):
    """(line, what is included, whether in quotes) of every include; comments have none."""
    for found in NOT_CODE.finditer(text):
        if included := INCLUDE.match(found.group()):
            name = included["quoted"] or included["angled"]
            yield text.count("\n", 0, found.start()) + 1, name, bool(included["quoted"])


def own_includes(text):
    """Files of the program that a file includes."""
    return [Path(name) for _, name, _ in includes_of(text) if name.partition("/")[0] in LAYERS]
