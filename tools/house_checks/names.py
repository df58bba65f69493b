"""One name, one type. Two types of one name in one namespace are no error to a compiler that never
sees both, and the linker then takes the functions of one for the other's."""

import re
from collections import defaultdict

from .source import TYPE, code_of

SCOPE = re.compile(r"\bnamespace\s*(?P<space>[\w:]*)\s*\{|" + TYPE.pattern + r"|(?P<open>\{)|(?P<close>\})")


def types_of(text):
    """Full names of the types that other files can see."""
    scopes = []
    for found in SCOPE.finditer(code_of(text)):
        name = found["type"] or found["enum"]
        if found["close"]:
            if scopes:
                scopes.pop()
        elif found["open"] or name:
            if name and all(scope for scope in scopes):
                yield "::".join([*scopes, name])
            scopes.append("")
        else:
            scopes.append(found["space"])  # empty: anonymous, so that nobody sees what is within


def check(texts):
    """`texts`: what each file holds."""
    places = defaultdict(list)
    for path, text in texts.items():
        for name in set(types_of(text)):
            places[name].append(path)
    return [
        (str(paths[0]), 1, f"{name} stands in {', '.join(map(str, paths[1:]))}, too; expected one type a name")
        for name, paths in sorted(places.items())
        if len(paths) > 1
    ]
