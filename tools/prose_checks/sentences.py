"""Length of sentences: none above 40 words, a page's median below 20. The top README is 120 lines at most."""

import re
import statistics

LONGEST, MEDIAN, FIRST_PAGE = 40, 20, 120
NOT_PROSE = {"Sources"}
# A full stop ends a sentence where a blank and a capital, a quote or code follow it.
END = re.compile(r"(?<=[.!?])\s+(?=[A-Z0-9\"*`\[(])")


def plain(text):
    """What is read aloud: code and formulas are one word each, and may begin a sentence."""
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]+`", "Code", text)
    return re.sub(r"\$[^$]+\$", "Formula", text)


def sentences(page):
    """(line, number of words) of every sentence; the line is that of its paragraph."""
    found = []
    for line, section, parts in page.paragraphs:
        if section in NOT_PROSE:
            continue
        for sentence in END.split(plain(" ".join(parts))):
            words = [word for word in sentence.split() if re.search(r"\w", word)]
            if words:
                found.append((line, len(words)))
    return found


def check(page):
    counts = sentences(page)
    faults = [
        (line, f"a sentence of {words} words, expected at most {LONGEST}")
        for line, words in counts
        if words > LONGEST
    ]
    if counts:
        median = statistics.median(words for _, words in counts)
        if median >= MEDIAN:
            faults.append((1, f"sentences have a median of {median:g} words, expected below {MEDIAN}"))
    return faults


def check_first_page(page):
    """The top README: whoever meets the program reads it whole."""
    lines = len(page.lines)
    return [(lines, f"{lines} lines, expected at most {FIRST_PAGE}")] if lines > FIRST_PAGE else []
