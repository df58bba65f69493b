"""The glossary has one meaning a word, and pages do not use the old words of its last table."""

import re

from .files import tables
from .sentences import plain

# Plain English or words of other fields as well, so a page may have them.
EVERYDAY = {
    "give", "is pulled", "leads", "parting", "quiet", "slack",
}  # fmt: skip


def words_of(cell):
    """The words that a cell defines; what stands in brackets tells them apart."""
    return [word.strip() for word in cell.split(",")]


def check_glossary(page):
    faults, known = [], {}
    for head, rows in tables(page):
        for line, cells in rows if head == "word" else []:
            for word in words_of(cells[0]):
                if word in known:
                    faults.append((line, f"{word} has a meaning in line {known[word]}"))
                known.setdefault(word, line)
    return faults


def old_words(glossary):
    return [
        word
        for head, rows in tables(glossary)
        if head == "there"
        for _, cells in rows
        for word in words_of(cells[0])
        if word not in EVERYDAY
    ]


def check(page, old):
    """Old words in sentences and tables; names in code are left alone."""
    pattern = re.compile(r"\b(?:" + "|".join(map(re.escape, old)) + r")\b", re.I)
    texts = [(line, parts) for line, _, parts in page.paragraphs] + [(line, row) for line, _, row in page.rows]
    return [
        (line, f'"{match.group(0)}" is an old word: see the glossary')
        for line, parts in texts
        for match in pattern.finditer(plain(" ".join(parts)))
    ]
