"""The table: bench.csv, bench.json, bench.md."""

import csv
import io
import json

COLUMNS = ["peer", "scheme", "dt, s", "forest, 1 thread", "forest, 2 threads", "tree, 1 thread",
           "tree, 2 threads", "tip error, 20 / 40 elements", "first frequency",
           "numerical damping", "forest's droop", "peak memory"]


def factor(value):
    """Two digits that count; never an exponent."""
    return "" if value is None else f"{value:.0f}" if value >= 10 else f"{value:#.2g}"


def percent(value, digits=2):
    if value is None:
        return "none"
    if abs(value) >= 0.1:
        digits = 0
    shown = f"{100 * value:+.{digits}f}"
    return ("0" + shown[2:] if float(shown) == 0 else shown) + " %"


def seconds(dt):
    return f"1/{1 / dt:.0f}" if dt >= 1e-3 else f"{dt:.0e}".replace("e-0", "e-")


def droop(figures):
    if figures["forest_droop"] is None:
        return ""
    millimetres = 1e3 * figures["forest_droop"]
    if abs(figures["forest_droop_error"]) > 1.0:
        return f"{millimetres:.0f} mm"
    return f"{millimetres:.2f} mm ({percent(figures['forest_droop_error'], 1)})"


def cells(figures):
    head = [figures["peer"], figures["scheme"], seconds(figures["dt"])]
    if not figures["installed"]:
        return head + ["not installed: left out"] + [""] * (len(COLUMNS) - 4)
    return head + [
        factor(figures["rtf_forest_1"]), factor(figures["rtf_forest_2"]),
        factor(figures["rtf_tree_1"]), factor(figures["rtf_tree_2"]),
        f"{percent(figures['tip_error_20'])} / {percent(figures['tip_error_40'])}",
        percent(figures["frequency_error"]),
        percent(figures["damping_ratio"]),
        droop(figures),
        f"{figures['peak_megabytes']:.0f} MB" if figures["peak_megabytes"] else "",
    ]


def notes(rows, machine):
    lines = [
        f"Real-time factor = simulated s / wall s, median of {machine['rounds']} interleaved runs. "
        f"{machine['cpu']}, {machine['cores']} cores, load average at the start {machine['load']} "
        f"(above 0.5: other programs took part of the machine); {machine['versions']}.",
        "Work: forest, 38 plants of 59 elements; tree, one plant of 2,242 elements, 92 deep; "
        "cantilever, 0.4 m, against the heavy elastica's tip drop (0.227248 m) and 1.10599 Hz; "
        "droop: mean over the forest's 228 ends, -4.62 mm (-4.65 mm where rods also stretch, as "
        "Pedicel's do).",
        "Frequency and damping at the row's step; \"none\": it does not oscillate. With two "
        "threads a peer has half of the plants in a world of their own each, so one tree stays "
        "with one. Empty: not within "
        f"{machine['cap']} s of wall time, or not stable.",
        "One iteration with self-contact: where branches strike each other they end up twice as "
        "far off as the time step puts them (`assets/manual/measurements_solver.md`).",
    ]
    for row in rows:
        if row.gave_up:
            lines.append(f"{row.scheme.label}: no figure for {' and '.join(sorted(row.gave_up))} "
                         f"within {machine['cap']} s.")
        if row.scheme.dt_40 and row.installed:
            lines.append(f"{row.scheme.label}: 40 elements at {seconds(row.scheme.dt_40)} s; "
                         f"{seconds(row.scheme.dt)} s is unstable there.")
    return lines


def markdown(rows, machine):
    lines = ["| " + " | ".join(COLUMNS) + " |", "|---" * len(COLUMNS) + "|"]
    lines += ["| " + " | ".join(cells(row.figures())) + " |" for row in rows]
    return "\n".join(lines + [""] + ["- " + note for note in notes(rows, machine)]) + "\n"


def comma_separated(rows):
    out = io.StringIO()
    records = [row.figures() for row in rows]
    writer = csv.DictWriter(out, fieldnames=records[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(records)
    return out.getvalue()


def as_json(rows, machine):
    records = [row.figures() for row in rows]
    return json.dumps({"machine": machine, "rows": records}, indent=2) + "\n"
