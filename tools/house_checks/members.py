"""What one class is stands in one file: its functions are defined in one .cpp."""

import re
from bisect import bisect
from collections import defaultdict

from .names import SCOPE, types_of
from .source import code_of

ANGLES = re.compile(r"<[^<>\n]*>")
# `Type Class::function(` from the margin on. A result, as in `Eigen::Vector3d function(`, is no class.
DEFINITION = re.compile(r"^[\w:&* \t\[\]]*?\b((?:\w+::)+)(?:~?\w+|operator[^\w\n].*?)\(", re.M)


def spaces_of(code):
    """(start, namespace) of each stretch of code; None: in a body, or where nobody else sees it."""
    scopes, stretches = [], [(0, "")]
    for found in SCOPE.finditer(code):
        if not found["close"]:
            scopes.append(found["space"] or "")
        elif scopes:
            scopes.pop()
        stretches.append((found.end(), "::".join(scopes) if all(scopes) else None))
    return stretches


def class_of(space, scopes, types):
    """The class that a function belongs to: the first of its scopes that is one; empty: none is."""
    around = space.split("::") if space else []
    for count in range(1, len(scopes) + 1):
        for outer in range(len(around), -1, -1):
            name = "::".join([*around[:outer], *scopes[:count]])
            if name in types:
                return name
    return ""


def classes_of(text, types):
    """(line, class) of every function of a class that a .cpp defines."""
    code = code_of(text)
    while (shorter := ANGLES.sub("", code)) != code:
        code = shorter
    stretches = spaces_of(code)
    starts = [start for start, _ in stretches]
    for found in DEFINITION.finditer(code):
        space = stretches[bisect(starts, found.start()) - 1][1]
        if space is not None and (name := class_of(space, found[1].split("::")[:-1], types)):
            yield code.count("\n", 0, found.start()) + 1, name


def check(texts):
    """`texts`: what each file holds."""
    types = {name for text in texts.values() for name in types_of(text)}
    places = defaultdict(dict)
    for path, text in texts.items():
        if path.suffix == ".cpp":
            for line, name in classes_of(text, types):
                places[name].setdefault(path, line)
    return [
        (str(path), line, f"functions of {name} stand in {', '.join(map(str, others))}, too; expected one file")
        for name, found in sorted(places.items())
        for (path, line), others in [(list(found.items())[0], list(found)[1:])]
        if others
    ]
