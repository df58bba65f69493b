"""A Markdown page as the checks see it: prose, headings, links, tables and console blocks."""

import re

FENCE = re.compile(r"^\s*(```|\$\$)")
HEADING = re.compile(r"^(#{1,6})\s+(.*)$")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")
CODE = re.compile(r"`([^`]+)`")


def anchor_of(heading):
    """The anchor of a heading, as GitHub and MyST make it."""
    text = re.sub(r"[^\w\- ]", "", heading.lower())
    return text.strip().replace(" ", "-")


class Page:
    """One page; lines count from 1."""

    def __init__(self, path, text=None):
        self.path = path
        self.lines = (path.read_text(encoding="utf-8") if text is None else text).splitlines()
        self.anchors, self.links, self.paragraphs = set(), [], []
        self.rows, self.blocks, self.code = [], [], []
        self._read()

    def _read(self):
        block, paragraph, section = None, None, ""
        for number, line in enumerate(self.lines, 1):
            fence = FENCE.match(line)
            if block is not None:
                if fence and fence.group(1) == block[2]:
                    block = None
                else:
                    block[3].append((number, line))
                continue
            if fence:
                block = (number, line.strip()[3:].strip(), fence.group(1), [])
                self.blocks.append(block)
                paragraph = None
                if line.count("$$") == 2:
                    block = None
                continue
            heading = HEADING.match(line)
            if heading:
                self.anchors.add(anchor_of(heading.group(2)))
                if len(heading.group(1)) <= 2:
                    section = heading.group(2)
            self.links += [(number, target) for target in LINK.findall(line)]
            self.code += [(number, code) for code in CODE.findall(line)]
            if line.lstrip().startswith("|"):
                cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]
                self.rows.append((number, section, cells))
            if heading or not line.strip() or line.lstrip().startswith(("|", "<!--")):
                paragraph = None
                continue
            if paragraph is None or ITEM.match(line):
                paragraph = (number, section, [])
                self.paragraphs.append(paragraph)
            paragraph[2].append(ITEM.sub("", line).strip())

    def keys(self):
        """Per section: what stands as code in the first two cells of its table rows."""
        found = {}
        for _, section, cells in self.rows:
            spans = [span for cell in cells[:2] for span in CODE.findall(cell)]
            found.setdefault(section, set()).update(spans)
        return found
