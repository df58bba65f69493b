"""Writes the manual's page python_reference.md from what the package says of itself.

Usage: PYTHONPATH=build/release/python /usr/bin/python3 app/python/make_page.py [FILE]
"""

import dataclasses
import inspect
import os
import re
import sys

HEAD = """# Python, call by call

Everything that `import pedicel` offers, as the docstrings of the module say it.
`help(pedicel.Simulation)` says the same in Python; [Python](python.md) shows how it is used.
This page is made by `app/python/make_page.py`, and a test compares the two.
"""

FIELD = re.compile(r"^(\([a-z0-9, ]*\)), ([^:]+): (.*)$", re.S)


def line(text):
    """One line of a table's cell or of prose."""
    return re.sub(r"\s+", " ", text.strip()).replace("|", "\\|")


def prose(text):
    """Paragraphs, a sentence a line as on the manual's other pages."""
    parts = [line(part) for part in re.split(r"\n\s*\n", text.strip()) if part.strip()]
    return "\n\n".join(re.sub(r"(?<=[.!?]) (?=[A-Z`\"])", "\n", part) for part in parts)


def split_arguments(text):
    """At the commas outside of brackets and quotes."""
    parts, depth, quote, start = [], 0, "", 0
    for i, c in enumerate(text):
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        elif c in "([{":
            depth += 1
        elif c in ")]}":
            depth -= 1
        elif c == "," and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    return [part for part in parts + [text[start:].strip()] if part]


def argument(text):
    """`count: int = 1` as `count=1`."""
    match = re.match(r"^(\*{0,2}\w+|\*)(?::.*?)?(?:\s*=\s*(.*))?$", text, re.S)
    name, default = match[1], match[2]
    name = "**settings" if name == "**kwargs" else name
    # The default may stand behind a type that has an equals sign of its own; the last one counts.
    return name if default is None else f"{name}={default}"


def compiled(name, member):
    """(call, what it does) of a method that pybind11 made."""
    first, _, rest = (inspect.getdoc(member) or "").partition("\n")
    inside = re.match(rf"{re.escape(name)}\((.*)\)(?: -> .*)?$", first)
    arguments = [argument(part) for part in split_arguments(inside[1])] if inside else []
    if arguments and arguments[0] == "self":
        arguments = arguments[1:]
    return f"{name}({', '.join(arguments)})", rest if inside else first


def written(name, function):
    """The same of a function that is written in Python."""
    parameters = [p.replace(annotation=inspect.Parameter.empty)
                  for p in inspect.signature(function).parameters.values() if p.name != "self"]
    signature = inspect.Signature(parameters)
    return f"{name}{signature}", inspect.getdoc(function) or ""


def table(head, rows):
    if not rows:
        return ""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def members(cls):
    """(arrays of the state, other values, calls) as rows."""
    arrays, values, calls = [], [], []
    for name, member in vars(cls).items():
        if name.startswith("_"):
            continue
        if isinstance(member, property):
            doc = inspect.getdoc(member) or ""
            field = FIELD.match(doc)
            if field and "worlds" not in field[1]:
                arrays.append((f"`{name}`", line(field[1]), line(field[2]), line(field[3])))
            elif not field or name in ("failed", "times"):
                values.append((f"`{name}`", line(doc)))
        else:
            call, says = compiled(name, member.__func__ if isinstance(member, staticmethod) else member)
            calls.append((f"`{call}`", line(says)))
    return arrays, values, calls


def of_class(cls, more=""):
    text = f"\n## {cls.__name__}\n\n{prose(inspect.getdoc(cls) or '')}\n"
    init = vars(cls).get("__init__")
    call = compiled("__init__", init)[0] if init is not None else ""
    if init is not None and "Initialize self" not in (inspect.getdoc(init) or ""):
        text += f"\n```python\n{cls.__name__}{call[len('__init__'):]}\n```\n"
        says = compiled("__init__", init)[1]
        if says.strip():
            text += f"\n{prose(says)}\n"
    arrays, values, calls = members(cls)
    for part in (more, table(("array", "shape", "unit", "what it is"), arrays),
                 table(("value", "what it is"), values), table(("call", "what it does"), calls)):
        if part:
            text += "\n" + part
    return text


def of_dataclass(cls):
    """Its fields with the comments that stand behind them."""
    source = inspect.getsource(cls)
    rows = []
    for field in dataclasses.fields(cls):
        comment = re.search(rf"^    {field.name}: .*?#: (.*)$", source, re.M)
        kind = re.sub(r"typing\.|pedicel\.\w+\.", "", str(field.type) if not isinstance(field.type, type)
                      else field.type.__name__)
        rows.append((f"`{field.name}`", f"`{kind}`", line(comment[1]) if comment else ""))
    return (f"\n## {cls.__name__}\n\n{prose(inspect.getdoc(cls))}\n\n"
            + table(("value", "type", "what it is"), rows))


def page():
    import pedicel
    from pedicel import _core, envs
    from pedicel.envs.env import PedicelEnv

    text = HEAD
    text += of_class(_core.Simulation, "It has everything of [`Run`](#run).\n")
    text += of_class(_core.Run)
    text += of_class(_core.Worlds, "It has every array of [`Run`](#run), with an axis of worlds in front.\n")
    for cls in (_core.Plant, _core.Variation, _core.CameraPicture, _core.Keypoint, _core.Thing, _core.Reach,
                _core.Parameter, _core.Event):
        text += of_class(cls)
    rows = [written(name, getattr(pedicel, name))
            for name in ("diagnose", "fit", "observe", "validate", "command", "asset")]
    text += "\n## Measured data, and the program\n\n" + table(
        ("call", "what it does"), [(f"`{call}`", line(says)) for call, says in rows])
    for name in ("Verdict", "Cause", "Estimate", "Fit", "FittedParameter", "Observed", "Validation"):
        text += of_dataclass(getattr(pedicel, name))
    errors = [getattr(pedicel, name) for name in ("Error", "InvalidFile", "UsageError", "Unstable", "WriteError",
                                                  "NoPictures", "Diagnostic")]
    text += "\n## Errors\n\n" + table(("exception", "what it says"), [
        (f"`{cls.__name__}`", line(inspect.getdoc(cls))) for cls in errors])
    text += "\n## Environments\n\n" + table(("call", "what it does"), [
        (f"`envs.{call}`", line(says)) for call, says in (written(n, getattr(envs, n)) for n in ("make", "make_vec"))])
    for cls in (PedicelEnv, envs.PedicelVectorEnv, envs.HarvestTask, envs.RevealTask, envs.ProbeTask):
        text += f"\n### {cls.__name__}\n\n{prose(inspect.getdoc(cls))}\n"
    return text


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path = [p for p in sys.path if os.path.abspath(p or ".") != here]
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "../../assets/manual/python_reference.md")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page())
