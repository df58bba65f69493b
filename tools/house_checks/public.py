"""The headers that are installed are few, sorted, there, and closed: what one includes comes with it."""

from pathlib import Path

from .source import own_includes

LIST = "tools/cmake/public_headers.txt"
MOST = 150


def headers_of(listed):
    """(line, header) of the list; its comments begin with #."""
    lines = enumerate(listed.splitlines(), 1)
    return [(number, Path(line.strip())) for number, line in lines if line.strip() and not line.startswith("#")]


def check(listed, texts):
    """`listed`: the list; `texts`: what each file of the program holds."""
    headers = headers_of(listed)
    known = {header for _, header in headers}
    faults = []
    if len(headers) > MOST:
        faults.append((LIST, headers[MOST][0], f"{len(headers)} public headers, expected at most {MOST}"))
    for (_, before), (line, header) in zip(headers, headers[1:]):
        if str(header) <= str(before):
            faults.append((LIST, line, f"{header} after {before}; expected each once, in order"))
    for line, header in headers:
        if header not in texts or header.suffix != ".h":
            faults.append((LIST, line, f"{header} is no header of the program"))
            continue
        faults += [
            (LIST, line, f"{header} includes {one}, which is not listed")
            for one in own_includes(texts[header])
            if one not in known
        ]
    return faults
