"""The chart: accuracy against speed, both axes logarithmic, every scheme labelled."""

import math
from html import escape

WIDTH, HEIGHT = 960, 600  # px
LEFT, RIGHT, TOP, BOTTOM = 80, 30, 70, 90
FONT = 13  # px
OURS, THEIRS, INK, FAINT = "#1b7837", "#37517e", "#222222", "#d8d8d8"


class Axis:
    """A logarithmic axis over whole decades, from px `start` to px `end`."""

    def __init__(self, values, start, end):
        self.low = math.floor(math.log10(min(values)))
        self.high = math.ceil(math.log10(max(values)))
        self.start, self.end = start, end

    def place(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def decades(self):
        return [10.0**k for k in range(self.low, self.high + 1)]


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def around(x, y, r=8):
    return (x - r, y - r, x + r, y + r)


def label_box(text, x, y, taken):
    """The free place for a label that is nearest to a mark: rings of growing radius about it."""
    width, height = 0.58 * FONT * len(text), FONT + 4
    frame = (LEFT + 3, TOP + 3, WIDTH - RIGHT - 3, HEIGHT - BOTTOM - 3)
    for radius in range(12, 400, 6):
        for angle in (0, 180, 90, 270, 45, 315, 135, 225, 20, 340, 160, 200):
            dx, dy = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            cx = x + radius * dx + 0.5 * width * dx
            cy = y + radius * dy
            box = (cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2)
            inside = (box[0] >= frame[0] and box[1] >= frame[1] and box[2] <= frame[2]
                      and box[3] <= frame[3])
            if inside and not any(overlap(box, other) for other in taken):
                return box
    raise ValueError(f"no free place for the label {text!r}")


def move_apart(rows):
    """Rows (left, right, y) that would lie on each other are moved up by 12 px; their new y."""
    placed = []
    for left, right, y in rows:
        while any(left < r + 24 and l < right + 24 and abs(y - other) < 11.9
                  for l, r, other in placed):
            y -= 12
        placed.append((left, right, y))
    return [y for *_, y in placed]


def text(x, y, words, anchor="middle", colour=INK, size=FONT, more=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" '
            f'font-size="{size}" {more}>{escape(words)}</text>')


def line(x1, y1, x2, y2, colour, more=""):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'{more}/>')


def mark(kind, x, y, colour):
    if kind == "tree":
        points = f"{x:.1f},{y - 6:.1f} {x - 5.5:.1f},{y + 4:.1f} {x + 5.5:.1f},{y + 4:.1f}"
        return f'<polygon points="{points}" fill="white" stroke="{colour}" stroke-width="1.6"/>'
    fill = colour if kind == "forest_1" else "white"
    return (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{fill}" stroke="{colour}" '
            'stroke-width="1.6"/>')


def axes(across, up):
    parts = []
    for value in across.decades():
        x = across.place(value)
        parts += [line(x, TOP, x, HEIGHT - BOTTOM, FAINT),
                  text(x, HEIGHT - BOTTOM + 20, f"{value:g}")]
    for value in up.decades():
        y = up.place(value)
        parts += [line(LEFT, y, WIDTH - RIGHT, y, FAINT),
                  text(LEFT - 10, y + 4, f"{value:g}", "end")]
    if across.low <= 0 <= across.high:
        x = across.place(1.0)
        parts.append(line(x, TOP, x, HEIGHT - BOTTOM, INK, 'stroke-dasharray="5 4"'))
        parts.append(text(x, TOP - 6, "real time", size=12))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - BOTTOM + 42,
                      "real-time factor (simulated s / wall s), 2,242 elements"))
    parts.append(text(24, middle, "largest error, %", more=f'transform="rotate(-90 24 {middle})"'))
    return parts


def legend():
    parts, x, y = [], LEFT + 10, HEIGHT - 16
    for kind, words, width in (("forest_1", "forest, one thread", 150),
                               ("forest_2", "forest, two threads", 160),
                               ("tree", "tree, one thread", 140)):
        parts += [mark(kind, x, y - 4, INK), text(x + 12, y, words, "start")]
        x += width
    return parts + [text(x, y, "lower right is better; marks that would coincide are moved up",
                         "start")]


def svg(rows, machine):
    """Rows without a speed or an error are left out. The error is the largest of the tip drop's,
    the first frequency's and the damping's, with 20 elements."""
    kinds = {"forest_1": ("forest", 1), "forest_2": ("forest", 2), "tree": ("tree", 1)}
    points = []  # (row, {kind: speed}, error in %)
    for row in rows:
        speeds = {kind: row.speed(*which) for kind, which in kinds.items()}
        error = row.worst_error()
        if speeds["forest_1"] and error:
            points.append((row, {k: v for k, v in speeds.items() if v}, 100 * error))
    if not points:
        return None
    across = Axis([v for _, speeds, _ in points for v in speeds.values()], LEFT, WIDTH - RIGHT)
    up = Axis([error for *_, error in points], HEIGHT - BOTTOM, TOP)

    parts = axes(across, up)
    taken = [around(across.place(1.0), y) for y in range(TOP, HEIGHT - BOTTOM, 8)]  # "real time"
    xs_of = [{kind: across.place(v) for kind, v in speeds.items()} for _, speeds, _ in points]
    ys = move_apart([(min(xs.values()), max(xs.values()), up.place(error))
                     for xs, (*_, error) in zip(xs_of, points)])
    for (row, *_), xs, y in zip(points, xs_of, ys):
        colour = OURS if row.scheme.peer == "Pedicel" else THEIRS
        parts.append(line(min(xs.values()), y, max(xs.values()), y, colour,
                          'stroke-opacity="0.35"'))
        parts += [mark(kind, x, y, colour) for kind, x in xs.items()]
        taken += [around(x, y) for x in xs.values()]
        taken.append((min(xs.values()), y - 2, max(xs.values()), y + 2))
    for (row, *_), xs, y in zip(points, xs_of, ys):
        colour = OURS if row.scheme.peer == "Pedicel" else THEIRS
        x = xs["forest_1"]
        box = label_box(row.scheme.label, x, y, taken)
        taken.append(box)
        nearest = (min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3]))
        if math.hypot(nearest[0] - x, nearest[1] - y) > 14:
            parts.append(line(x, y, *nearest, colour, 'stroke-width="0.7"'))
        parts.append(text((box[0] + box[2]) / 2, box[3] - 5, row.scheme.label, colour=colour))
    head = [text(LEFT, 24, "Rods: how right, how fast", "start", size=18),
            text(LEFT, 44, "largest of three errors with 20 elements (tip drop, first frequency, "
                 f"numerical damping); {machine['cpu']}, {machine['cores']} cores", "start",
                 size=12)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
            f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif">\n'
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n'
            + "\n".join(head + parts + legend()) + "\n</svg>\n")
