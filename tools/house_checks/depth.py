"""Headers include each other in short chains: a change of the last one compiles all before it anew."""

from pathlib import Path

from .source import own_includes

MOST = 20


def chains_of(texts):
    """Per file the longest chain of own headers that it includes, the nearest one first. A header that
    includes itself ends a chain there."""
    longest = {}

    def from_here(path, way):
        if path not in longest:
            chains = [
                [one, *from_here(one, [*way, one])]
                for one in own_includes(texts[path])
                if one in texts and one not in way
            ]
            longest[path] = max(chains, key=len, default=[])
        return longest[path]

    for path in sorted(texts):
        from_here(path, [path])
    return longest


def check(texts):
    """`texts`: what each file holds. Of longer chains the part that is one too long is named, once."""
    faults = []
    for path, below in sorted(chains_of(texts).items()):
        if Path(path).suffix == ".h" and len(below) == MOST:
            chain = " -> ".join(map(str, [path, *below]))
            faults.append((str(path), 1, f"a chain of {MOST + 1} headers, expected at most {MOST}: {chain}"))
    return faults
