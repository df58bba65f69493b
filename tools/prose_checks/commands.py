"""Command lines in console blocks, and whether the pages list every option and command."""

import re
import shlex

from .page import CODE
from .program import VERBS


def console_lines(page):
    for _, language, _, lines in page.blocks:
        if language == "console":
            yield from ((number, line[2:]) for number, line in lines if line.startswith("$ "))


def check_pedicel(words, program):
    """What is wrong with a command line of the program; nothing where it parses."""
    verb = words[0] if words and words[0] in VERBS else ""
    known, rest, given = program.options[verb], words[1:] if verb else words, []
    while rest:
        word = rest.pop(0)
        if not word.startswith("-"):
            given.append(word)
            continue
        name = word.split("=")[0]
        if name not in known:
            return f"{name} is no option of pedicel {verb}".rstrip()
        if known[name] and "=" not in word and not rest:
            return f"{name} lacks its value"
        if known[name] and "=" not in word:
            rest.pop(0)
    least = {"": 0, "bench": 0, "manual": 0, "fit": 2}.get(verb, 1)
    return "" if len(given) >= least else f"pedicel {verb} lacks what it works on"


def check_lines(page, program, root):
    faults = []
    for line, text in console_lines(page):
        words = shlex.split(text)
        if words[0] == "pedicel" and (fault := check_pedicel(words[1:], program)):
            faults.append((line, fault))
        if words[0].startswith("tools/") and not (root / words[0]).exists():
            faults.append((line, f"{words[0]} is not in the tree"))
    return faults


def told(page):
    """(line, command, what the page says that it prints) of every command that is shown with its output."""
    for _, language, _, lines in page.blocks:
        if language != "console":
            continue
        for at, (number, line) in enumerate(lines):
            if not line.startswith("$ "):
                continue
            said = []
            for _, text in lines[at + 1 :]:
                if text.startswith("$ "):
                    break
                said.append(text.rstrip())
            if said:
                yield number, line[2:], said


def check_same(pages):
    """(page, line, fault): one command prints one thing, on whatever page it stands."""
    first, faults = {}, []
    for page in pages:
        for line, command, said in told(page):
            place, known = first.setdefault(command, (f"{page.path.name}:{line}", said))
            if known != said:
                faults.append((page, line, f"`{command}` prints something else in {place}"))
    return faults


def check_options(page, program):
    """Every long option of every verb stands in a table of the page."""
    listed = {span for spans in page.keys().values() for span in spans}
    return [
        (1, f"{option} of pedicel {verb} is missing".replace("  ", " "))
        for verb, options in program.options.items()
        for option in options
        if option.startswith("--") and option not in listed
    ]


def check_script_commands(page, program):
    """Every command has a row, and the row every argument."""
    rows = {}
    for _, _, cells in page.rows:
        for verb in CODE.findall(cells[0]):
            rows[verb] = set(CODE.findall(cells[1])) if len(cells) > 1 else set()
    faults = []
    for verb, arguments in program.commands():
        if verb not in rows:
            faults.append((1, f"command `{verb}` is missing"))
            continue
        missing = [name for name in arguments if name not in rows[verb]]
        faults += [(1, f"argument `{name}` of command `{verb}` is missing") for name in missing]
    return faults


def check_exit_codes(page, program):
    """The exit codes that --help tells have a row each."""
    text = program.run("--help").stdout
    told = re.search(r"Exit codes: (.*)", text).group(1)
    codes = set(re.findall(r"(?:^|, )(\d+) [a-z]", told))
    listed = {cells[0].split()[0] for _, section, cells in page.rows if section == "Exit codes"}
    return [(1, f"exit code {code} is missing") for code in sorted(codes - listed, key=int)]
