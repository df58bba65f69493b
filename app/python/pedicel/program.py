"""The verbs of the program `pedicel`, which lies beside the module."""

import os
import re
import shutil
import signal
import subprocess
from typing import Any, List, Sequence, Tuple

from . import _core
from .errors import Diagnostic, Error, InvalidFile, NoPictures, Unstable, UsageError, WriteError

_LINE = re.compile(r"^(?P<file>.*?)(?::(?P<line>\d+))?(?::(?P<column>\d+))?: "
                   r"(?P<severity>error|warning|notice): (?P<what>.*)$")

#: Exceptions by exit code, as the manual's page on the command line has them.
_ERRORS = {2: UsageError, 3: InvalidFile, 4: Unstable, 6: WriteError, 77: NoPictures}


def diagnostics_of(text: str) -> List[Diagnostic]:
    """The lines FILE:LINE:COLUMN: error: ... of a text."""
    found = []
    for line in text.splitlines():
        match = _LINE.match(line)
        if match and match["file"]:
            found.append(Diagnostic(match["severity"], match["file"], int(match["line"] or 0),
                                    int(match["column"] or 0), match["what"]))
    return found


def path_of_program() -> str:
    """PEDICEL_PROGRAM, else what lies beside this module, else what the path has."""
    here = os.path.dirname(os.path.realpath(_core.__file__))
    places = [os.environ.get("PEDICEL_PROGRAM", ""), os.path.join(here, "..", "..", "pedicel"),
              os.path.join(here, "..", "..", "..", "..", "bin", "pedicel"), shutil.which("pedicel") or ""]
    for place in places:
        if place and os.access(place, os.X_OK) and not os.path.isdir(place):
            return os.path.realpath(place)
    raise Error("the program pedicel is neither beside the module nor on the path; PEDICEL_PROGRAM may name it")


def command(*arguments: Any, good: Sequence[int] = (0,)) -> str:
    """Runs the program with these arguments, and returns what it writes on standard output.

    command("sweep", scene, "--set", "detach.stretch=0.1,0.2", "--out", folder). Exit codes other than
    those of `good` raise the exceptions of this module. Ctrl-C ends it.
    """
    return outputs(arguments, good)[0]


def outputs(arguments: Sequence[Any], good: Sequence[int]) -> Tuple[str, str]:
    """The same, with what it writes on standard error."""
    words = [path_of_program()] + [os.fspath(a) if isinstance(a, os.PathLike) else str(a) for a in arguments]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            out, err = process.communicate()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.wait()
            raise
    if process.returncode in good:
        return out, err
    found = diagnostics_of(err)
    what = "\n".join(str(d) for d in found if d.severity == "error") or err.strip() or (
        f"pedicel {' '.join(words[1:])}: ended with code {process.returncode}")
    kind = _ERRORS.get(process.returncode, Error)
    if what.startswith("error: "):
        what = what[len("error: "):]
    raise kind(what, found)
