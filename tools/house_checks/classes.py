"""A class has 30 functions at most: one that has more is several."""

import re

from .source import TYPE, body_of, code_of

MOST = 30
# Between functions and members: the end of a declaration, or of a body that is no initialiser.
PARTS = re.compile(r";|\{\}(?!\s*[,{)(])")
LABEL = re.compile(r"^\s*(?:(?:public|private|protected)\s*:\s*)+")
NO_FUNCTION = ("using ", "friend ", "static_assert", "struct ", "class ", "enum ", "union ", "typedef ")


def is_function(part):
    part = LABEL.sub("", part).strip()
    # What is deleted is said so that nobody calls it.
    if not part or part.startswith(NO_FUNCTION) or part.endswith("= delete"):
        return False
    # Angle brackets hold parentheses of their own: std::function<void(int)>.
    while (shorter := re.sub(r"<[^<>]*>", "", part)) != part:
        part = shorter
    head, bracket, _ = part.partition("(")
    return bool(bracket) and ("=" not in head or "operator" in head)


def functions_of(code):
    """(line, name, number of functions) of every class."""
    for found in TYPE.finditer(code):
        if found["type"]:
            parts = PARTS.split(body_of(code, found.end()))
            yield code.count("\n", 0, found.start()) + 1, found["type"], sum(map(is_function, parts))


def check(text):
    return [
        (line, f"{name} has {count} functions, expected at most {MOST}")
        for line, name, count in functions_of(code_of(text))
        if count > MOST
    ]
