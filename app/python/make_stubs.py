"""Writes _core.pyi from what the module says of itself: signatures and docstrings."""

import inspect
import re
import sys

HEAD = '''"""Made by make_stubs.py from the docstrings of the module."""

import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy
import numpy.typing
'''

#: Types as pybind11 writes them, and as they are for who calls.
TYPES = [
    (r"pedicel\._core\.", ""),
    (r"numpy\.ndarray\[[^\]]*\]", "numpy.ndarray"),
    (r"\bos\.PathLike\b", "Union[str, os.PathLike[str]]"),
    (r"\bobject\b", "Any"),
    (r"\bdict\b(?!\[)", "Dict[Any, Any]"),
    (r"\btuple\b(?!\[)", "Tuple[Any, ...]"),
    (r"<[^>]*>", "..."),
]

#: Properties whose value is no array: pybind11 does not say.
SCALARS = {bool: "bool", int: "int", float: "float", str: "str"}


def plain(text):
    for pattern, by in TYPES:
        text = re.sub(pattern, by, text)
    return text


def docstring(text, indent):
    text = text.strip()
    if not text:
        return f"{indent}...\n"
    lines = text.splitlines()
    body = ("\n" + indent).join(lines)
    end = "\n" + indent if len(lines) > 1 else ""
    quote = '"' if body.endswith('"') else ""
    return f'{indent}"""{body}{" " if quote else ""}{end}"""\n'


def arguments(text):
    """Arrays come in as whatever numpy can read."""
    return re.sub(r": numpy\.ndarray", ": numpy.typing.ArrayLike", text).replace(
        "Optional[numpy.ndarray]", "Optional[numpy.typing.ArrayLike]")


def function(name, member, indent, static=False):
    doc = inspect.getdoc(member) or ""
    first, _, rest = doc.partition("\n")
    match = re.match(rf"{re.escape(name)}\((.*)\)(?: -> (.*))?$", first)
    if not match and name == "__init__":
        return ""  # made by the module only
    if not match:
        return f"{indent}def {name}(self, *args: Any, **kwargs: Any) -> Any: ...\n"
    inside = re.sub(r"^self: [^,)]*", "self", arguments(plain(match[1])))
    inside = re.sub(r"\*\*kwargs$", "**settings: Any", inside)
    result = plain(match[2] or "None")
    if static:
        head = f"{indent}@staticmethod\n"
    else:
        head = ""
    return f"{head}{indent}def {name}({inside}) -> {result}:\n" + docstring(rest, indent + "    ")


def type_of(getter, doc):
    found = re.search(r"-> (.*)", getter.__doc__ or "") if getter else None
    if found:
        return plain(found[1].strip())
    return "Any"


def property_of(name, member):
    doc = inspect.getdoc(member) or ""
    kind = type_of(member.fget, doc)
    if kind == "Any" and doc.startswith("("):
        kind = "numpy.ndarray"
    text = f"    @property\n    def {name}(self) -> {kind}:\n" + docstring(doc, "        ")
    if member.fset:
        text += f"    @{name}.setter\n    def {name}(self, value: {kind}) -> None: ...\n"
    return text


def class_of(cls):
    base = cls.__mro__[1].__name__
    text = f"\nclass {cls.__name__}" + (f"({base})" if base != "pybind11_object" else "") + ":\n"
    text += docstring(inspect.getdoc(cls) or "", "    ")
    for name, member in cls.__dict__.items():
        if name.startswith("__") and name not in ("__init__", "__len__", "__getitem__"):
            continue
        if isinstance(member, property):
            text += property_of(name, member)
        elif isinstance(member, staticmethod):
            text += function(name, member.__func__, "    ", True)
        elif callable(member) or inspect.ismethoddescriptor(member):
            text += function(name, member, "    ")
    return text


def stubs(module):
    text = HEAD + "\nversion: str\ngit_hash: str\n"
    members = [m for m in vars(module).values() if inspect.isclass(m)]
    for cls in sorted(members, key=lambda c: len(c.__mro__)):
        text += class_of(cls)
    for name, member in vars(module).items():
        if inspect.isbuiltin(member):
            text += "\n" + function(name, member, "")
    return text


if __name__ == "__main__":
    del sys.path[0]  # this folder has the package without its compiled part
    import pedicel._core as core

    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(stubs(core))
