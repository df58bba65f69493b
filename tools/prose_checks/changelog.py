"""The change log has the form of keepachangelog.com: versions with dates, newest first, and under each
the headings Added, Changed, Deprecated, Removed, Fixed and Security, at most once."""

import re

VERSION = re.compile(r"^\[(\d+)\.(\d+)\.(\d+)\] - \d{4}-\d\d-\d\d$")
KINDS = ("Added", "Changed", "Deprecated", "Removed", "Fixed", "Security")


def check(page):
    faults, last, kinds = [], None, set()
    for line, text in enumerate(page.lines, 1):
        if text.startswith("## "):
            match = VERSION.match(text[3:])
            version = tuple(map(int, match.groups())) if match else None
            if text != "## [Unreleased]" and not match:
                faults.append((line, "expected [MAJOR.MINOR.PATCH] - YYYY-MM-DD"))
            elif version and last and version >= last:
                faults.append((line, "expected the newest version first"))
            last, kinds = version or last, set()
        elif text.startswith("### "):
            kind = text[4:]
            if kind not in KINDS:
                faults.append((line, f"{kind}: expected one of: {', '.join(KINDS)}"))
            elif kind in kinds:
                faults.append((line, f"{kind} stands twice under its version"))
            kinds.add(kind)
    return faults
