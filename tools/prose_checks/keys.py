"""Every key that a reader asks for stands in the manual.

A rule says which sources ask for the keys of which page. Keys are found by how readers are written:
map.required("radius"), optional_number(map, "bend", ...), {"margin", "m", &s.margin, ...}. What one
function asks for must stand together in the tables of one section.
"""

import re
from dataclasses import dataclass

ASKED = re.compile(
    r"(?:required|optional|has|number|integer|boolean|text|choice|vector|quaternion|numbers|list|"
    r"named|whole)\(\s*(?:\w+,\s*)?\"([a-z_0-9]+)\"[,)]"
)
NAMED = re.compile(r"\{\"([a-z_]+)\",\s*(?:\w+::|&)")  # {"fruit", Anchor::Kind::fruit}
EITHER = re.compile(r"const char\* key = [^;]*\"(\w+)\" : \"(\w+)\"")
PARAMETER = re.compile(r"\{\"(\w+)\",\s*\"[^\"]*\",\s*&s\.")
WORD = re.compile(r"\{\"(\w+)\",\s*\{\"")
NUMBER = re.compile(r"\{\"(\w+)\",\s*\"[^\"]*\",\s*[-\d.e]+,\s*[-\d.e]+,")
DESCRIBED = re.compile(r"\.name = \"(\w+)\"")
EFFECT = re.compile(r"\bd\.name = \"(\w+)\"")
EFFECT_NUMBER = re.compile(r"\{\.name = \"([a-z_0-9]+)\"")
DEVIATION = re.compile(r"\{\"(\w+_std)\", &")
PAIR = re.compile(r"pair_of\(map, \"(\w+)\"")
TEXTS = re.compile(r"texts\(map, \"(\w+)\"")
JSON = re.compile(r"(?:\{|json\[)\"([a-z_0-9]+)\"[,\]]")
QUANTITY = re.compile(r"^\s+\{\"(\w+)\", \"", re.M)
SCRIPT_QUANTITY = re.compile(r"if \(name == \"(\w+)\"\)")
CHANNEL = re.compile(r"(?<=[\" ])((?:tool_[xyz]|energy|stretch|contacts|detached)_\w+)(?=[ \"])")
FRUIT_CHANNEL = re.compile(r"(?<=[\" ])\*(_\w+)(?=[ \"])")
TABLE_COLUMN = re.compile(r"\"(\w+)\"(?=[^{}\n]*\}\},$)", re.M)
COLUMN = re.compile(r"\"((?:time|stretch|bend|force|moment|torsion|angle|tool)_\w+|organ|cause)\"")


@dataclass(frozen=True)
class Rule:
    page: str
    sources: tuple
    patterns: tuple
    fewest: int  # keys that the rule finds at least: one that finds nothing checks nothing
    prefix: str = ""  # of the key on the page
    end: str = r"^}$"  # line that ends a function; "": all keys of the sources are one group
    leave_out: tuple = ()
    within: str = ""  # what a part has to hold: of a file with several lists, the one that is meant


LISTS = r"^inline constexpr (?:PlantKey<\w+>|MaterialKey) "  # each list of keys is a part
READER = (ASKED, NAMED, EITHER)
RULES = [
    Rule("plant_file.md", ("plugins/plant/plant_reader.cpp",), READER, 15),
    Rule("plant_file.md", ("plugins/plant/model/plant_model.h",), (DESCRIBED,), 24, end=LISTS),
    Rule("plant_file.md", ("plugins/skeleton/skeleton_columns.cpp",), (TABLE_COLUMN,), 51, end=""),
    Rule("leaf_template.md", ("plugins/plant/leaf_template.cpp",), READER, 8),
    Rule("leaf_template.md", ("plugins/plant/model/plant_model.h",), (DESCRIBED,), 4, end=LISTS,
         within="&MaterialValues::"),
    Rule("scene_file.md", ("engine/world/scene_reader.cpp", "engine/world/scene_bodies.cpp",
         "engine/world/scene_common.cpp", "engine/world/scene_plants.cpp",
         "engine/world/scene_robot.cpp", "engine/world/scene_views.cpp",
         "engine/world/scene_sensors.cpp", "engine/world/variation.cpp",
         "engine/world/scene_expect.cpp"), READER, 90),
    Rule("experiment.md", ("plugins/discrepancy/files/experiment_reader.cpp",
         "plugins/discrepancy/files/drive_reader.cpp"), READER, 50, end=r"^  }$",
         leave_out=("pixels_", "wrench_")),
    Rule("scene_experiment.md", ("plugins/discrepancy/scene/effects/*.cpp",), (EFFECT,), 17, end=""),
    Rule("logs.md", ("plugins/discrepancy/log_import/log_map.cpp",), READER, 27),
    Rule("import.md", ("plugins/discrepancy/import/picture_camera.cpp",), (*READER, PAIR), 7),
    Rule("cluster.md", ("engine/cluster/cluster_profile.cpp",), (*READER, TEXTS), 12),
    Rule("effects.md", ("plugins/plant/effect_reader.cpp",), READER, 2, end="",
         leave_out=("curve", "at")),
    Rule("effects.md", ("plugins/effects/*.cpp",), (EFFECT, EFFECT_NUMBER), 45, end=""),
    Rule("settings.md", ("engine/world/settings.cpp",), (NUMBER,), 5),
    Rule("settings.md", ("plugins/cosserat/solver/rod_settings.cpp",), (PARAMETER,), 4),
    Rule("settings.md", ("plugins/coupling/coupling_settings.cpp",), (PARAMETER,), 8),
    Rule("settings.md", ("plugins/simulation/plants/rod_options.cpp",), (WORD,), 3, end=""),
    Rule("settings.md", ("plugins/plant/model/plant_model.h",), (DESCRIBED,), 4, prefix="material.",
         end=LISTS, within="&MaterialValues::"),
    Rule("settings.md", ("plugins/plant/model/plant_model.h",), (DESCRIBED,), 5, prefix="detach.",
         end=LISTS, within="&DetachLimits::"),
    Rule("settings.md", ("plugins/plant/model/plant_model.h",), (DESCRIBED,), 2, prefix="sampling.",
         end=LISTS, within="&PlantFile::connect"),
    Rule("quantities.md", ("engine/world/expectation.cpp",), (QUANTITY,), 18),
    Rule("quantities.md", ("app/session/commands/session_commands.cpp",), (SCRIPT_QUANTITY,), 7),
    Rule("quantities.md", ("engine/world/recorder.cpp",), (COLUMN,), 16, end=""),
    Rule("quantities.md", ("plugins/simulation/quantities.cpp",), (CHANNEL,), 9, end=""),
    Rule("quantities.md", ("plugins/simulation/quantities.cpp",), (FRUIT_CHANNEL,), 7, prefix="PLANT/FRUIT", end=""),
    Rule("quantities.md", ("app/report/meta.cpp",), (JSON,), 25, end="", leave_out=("value", "unit")),
]


def sources_of(rule, root):
    """A source may stand for all files of a folder."""
    found = []
    for source in rule.sources:
        found += sorted(str(path.relative_to(root)) for path in root.glob(source)) if "*" in source else [source]
    return found


def groups(rule, root):
    """The keys of each function of the rule's sources."""
    found = []
    for source in sources_of(rule, root):
        text = (root / source).read_text(encoding="utf-8")
        parts = re.split(rule.end, text, flags=re.M) if rule.end else [text]
        for part in parts:
            if not re.search(rule.within, part):
                continue
            keys = set()
            for pattern in rule.patterns:
                for match in pattern.findall(part):
                    keys.update([match] if isinstance(match, str) else match)
            if keys := keys - set(rule.leave_out):
                found.append((source, {rule.prefix + key for key in keys}))
    return found


def check(rule, page, root):
    absent = [source for source in sources_of(rule, root) if not (root / source).exists()]
    if absent:
        return [(1, f"{absent[0]} is not there: tools/prose_checks/keys.py no longer fits it")]
    found = groups(rule, root)
    count = len(set().union(*(keys for _, keys in found))) if found else 0
    if count < rule.fewest:
        return [(1, f"{rule.sources[0]}: {count} keys found, expected {rule.fewest} or more: "
                    "tools/prose_checks/keys.py no longer fits it")]
    sections, everything = page.keys(), set().union(*page.keys().values())
    faults = []
    for source, keys in found:
        # Without an end of functions the keys may stand in tables of several sections.
        if not rule.end:
            missing = keys - everything
        else:
            missing = min((keys - section for section in sections.values()), key=len)
        faults += [(1, f"`{key}` of {source} is missing") for key in sorted(missing)]
    return faults
