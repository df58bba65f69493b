"""A scene effect is one file: no other one knows it by name, and somebody tells the symptoms that it names."""

import re

from .source import NOT_CODE

EFFECTS = "plugins/discrepancy/scene/effects"
SYMPTOMS = "plugins/discrepancy/scene_procedure"
# Names that are something else there: a column of the state, and a number of the robot.
OTHERS = {("plugins/simulation/quantities.cpp", "tool_pose"), ("engine/robot/robot.cpp", "contact_friction")}
SPEAKS_FOR = re.compile(r"speaks_for = \{.*?\};", re.S)
SIGN = re.compile(r'\{"(\w+)", \d')


def literals_of(text):
    """(line, literal) of every string; comments and lines of the preprocessor have none."""
    for found in NOT_CODE.finditer(text):
        if found.group()[0] in '"R':
            yield text.count("\n", 0, found.start()) + 1, found.group()


def names_in(literal, names):
    """Effects that a literal names: alone, or within a text where it can be no plain word."""
    for name in names:
        if literal == f'"{name}"' or ("_" in name and re.search(rf"\b{name}\b", literal)):
            yield name


def check(texts):
    """`texts`: what each file holds."""
    own = {path.stem: path for path in texts if str(path.parent) == EFFECTS and path.suffix == ".cpp"}
    faults, told = [], set()
    for path, text in texts.items():
        for line, literal in literals_of(text):
            if str(path.parent) == SYMPTOMS:
                told.add(literal.strip('"'))
            faults += [
                (str(path), line, f"names the effect {name}; expected a field of its definition")
                for name in names_in(literal, own)
                if path != own[name] and (str(path), name) not in OTHERS
            ]
    for name, path in own.items():
        for found in SPEAKS_FOR.finditer(texts[path]):
            faults += [
                (str(path), texts[path].count("\n", 0, found.start()) + 1, f"the symptom {symptom} is told nowhere")
                for symptom in SIGN.findall(found.group())
                if symptom not in told
            ]
    return faults
