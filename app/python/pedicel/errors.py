"""Exceptions of the module."""

from typing import List, NamedTuple, Optional


class Diagnostic(NamedTuple):
    """What is wrong with a file, or worth knowing of it, and where."""

    severity: str  #: error, warning or notice
    file: str
    line: int  #: from 1; 0: the file as a whole
    column: int  #: from 1; 0: the line as a whole
    what: str  #: what is wrong, and what was expected

    def __str__(self) -> str:
        place = [self.file] + [str(n) for n in (self.line, self.column) if n]
        return ":".join(place) + f": {self.severity}: {self.what}"


class Error(Exception):
    """Base of all errors. `file`, `line` and `column` say where the first fault is, if it has a place."""

    def __init__(self, what: str, diagnostics: Optional[List[Diagnostic]] = None):
        super().__init__(what)
        self.diagnostics: List[Diagnostic] = diagnostics or []
        first = next((d for d in self.diagnostics if d.severity == "error"), None)
        self.file: Optional[str] = first.file if first else None
        self.line: Optional[int] = first.line or None if first else None
        self.column: Optional[int] = first.column or None if first else None


class InvalidFile(Error, ValueError):
    """A file cannot be used: `diagnostics` has every fault that was found."""


class UsageError(Error, ValueError):
    """A call that is impossible; the sentence says what was expected."""


class Unstable(Error):
    """A simulation can go no further; the sentence says what, when and what helps."""


class WriteError(Error):
    """A file cannot be written."""


class NoPictures(Error):
    """There is no OpenGL off screen (Debian: libosmesa6)."""
