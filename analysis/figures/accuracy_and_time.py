#!/usr/bin/env python3
"""Error against time of the runs of a study, from the study.csv of `suffuse-study`, with the front that no other run beats.

  accuracy_and_time.py study.csv --variables resolution,operator --output FIGURE.png

The first variable gives a point its colour, the second its shape, the third its filling; points of the front have the values that change
along it written beside them. Where each run differs from a base in one variable, the colour is that variable and every point has its
value. Crosses at the upper edge are runs that failed. The ending of --output says the format (png, pdf, svg).
"""
import argparse
import csv
import pathlib
import sys

MARKERS = "osD^vP<>*h"
FILLS = ("full", "none", "left", "bottom", "right", "top")


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def read_runs(options):
    with open(options.study, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    name = pathlib.Path(sys.argv[0]).name
    if not rows:
        sys.exit(f"{name}: {options.study} has no run")
    missing = [column for column in options.variables + ["status", "error", "front", f"{options.time}_s"] if column not in rows[0]]
    if missing:
        sys.exit(f"{name}: {options.study} has no column {', '.join(missing)}; it has {', '.join(rows[0])}")
    return rows


def classes(rows, variable):
    """Values of a variable, in the order of their size where they are numbers."""
    values = list(dict.fromkeys(row[variable] for row in rows))
    return sorted(values, key=number) if all(number(value) is not None for value in values) else values


class Looks:
    """How a run looks by its first three variables: colour, shape, filling."""

    def __init__(self, style, rows, variables):
        self.variables = variables[:3]
        values = [classes(rows, name) for name in self.variables] + [[""]] * (3 - len(self.variables))
        palette = list(style.COLOURS.values())
        if values[0][0] == "base":
            palette = ["black"] + palette
        if len(values[0]) > len(palette):
            palette = [style.plt.get_cmap("viridis")(0.95 * k / (len(values[0]) - 1)) for k in range(len(values[0]))]
        self.maps = [dict(zip(values[0], palette)), {value: MARKERS[k % len(MARKERS)] for k, value in enumerate(values[1])},
                     {value: FILLS[k % len(FILLS)] for k, value in enumerate(values[2])}]

    def of(self, row):
        keys = [row[name] for name in self.variables] + [""] * (3 - len(self.variables))
        colour, marker, fill = (known[key] for known, key in zip(self.maps, keys))
        return {"linestyle": "", "color": colour, "marker": marker, "fillstyle": fill, "markersize": 5, "markeredgewidth": 0.9}

    def legend(self):
        from matplotlib.lines import Line2D
        from suffuse_style import plain

        entries = []
        for name, known, key in zip(self.variables, self.maps, ("color", "marker", "fillstyle")):
            entries.append(Line2D([], [], linestyle="", label=plain(name.replace("_", " "))))
            entries += [Line2D([], [], **({"linestyle": "", "marker": "o", "color": "#606060", "label": f"  {plain(value)}"} | {key: look})) for value, look in known.items()]
        return entries


def label(axes, texts):
    """Writes (row, text) beside the points: right above, right below, left above or left below, where no other label stands; where
    all four are taken a point goes without."""
    import matplotlib.patheffects as effects
    from suffuse_style import plain

    axes.figure.canvas.draw()  # places everything, so that labels have sizes
    taken = []
    for row, text in texts:
        for right, above in ((True, True), (True, False), (False, True), (False, False)):
            note = axes.annotate(plain(text), xy=(row["x"], row["y"]), xytext=(5 if right else -5, 4 if above else -4), textcoords="offset points",
                                 fontsize=6.5, ha="left" if right else "right", va="bottom" if above else "top", annotation_clip=False, zorder=1.5,
                                 path_effects=[effects.withStroke(linewidth=2.5, foreground="white")])
            box = note.get_window_extent()
            if box.x0 >= axes.bbox.x0 and not any(box.overlaps(other) for other in taken):
                taken.append(box)
                break
            note.remove()


def front_labels(front, variables):
    """The values that change along the front."""
    changing = [name for name in variables if len({row[name] for row in front}) > 1] or variables[:1]
    return [(row, ", ".join(row[name] for name in changing)) for row in front]


def one_at_a_time(rows, variables):
    """Whether each run but the finest differs from one base in one variable at most; if so, rows get the column `changed`."""
    runs = [row for row in rows if row["is_reference"] != "1"]
    base = {name: max((row[name] for row in runs), key=[row[name] for row in runs].count) for name in variables}
    for row in rows:
        changes = [name for name in variables if row[name] != base[name]]
        row["changed"], row["changes"] = changes[0] if changes else "base", len(changes)
        row["label"] = row[changes[0]] if changes else "base"
    return len(variables) > 2 and all(row["changes"] <= 1 for row in runs)


def extrapolated(rows, options):
    """Groups of runs that differ in their resolution alone, with the seconds of those that were extrapolated from, and the largest error
    of the extrapolated values with its bar."""
    groups = {}
    for row in rows:
        if row.get("extrapolated_from"):
            groups.setdefault(tuple(row[name] for name in options.variables if name != options.extrapolated), []).append(row)
    found = []
    for group in groups.values():
        row = group[0]
        used = row["extrapolated_from"].split()
        errors = []
        for name in (column[: -len("_extrapolated")] for column in row if column.endswith("_extrapolated")):
            value, reference = number(row[f"{name}_extrapolated"]), number(row[f"{name}_reference"])
            if value is not None and reference:
                errors.append((abs(value / reference - 1), abs(number(row[f"{name}_error_bar"]) / reference)))
        if errors:
            found.append({"row": row, "x": sum(float(one[f"{options.time}_s"]) for one in group if one[options.extrapolated] in used), "error": max(errors)})
    return found


def draw_extrapolated(axes, found, looks, least):
    """A diamond at the time of all runs that it takes, from error less bar to error and bar."""
    for one in found:
        error, bar = one["error"]
        y, low = 100 * max(error, least / 2), 100 * max(error - bar, least / 2)
        colour = looks.of(one["row"])["color"] if len(looks.variables) > 1 else "black"
        axes.errorbar(one["x"], y, yerr=[[max(y - low, 0)], [100 * (error + bar) - y]], color=colour, marker="D", markersize=6, markerfacecolor="white",
                      markeredgewidth=1.1, elinewidth=0.8, capsize=2.5, zorder=1.8)


def draw(rows, options):
    import suffuse_style as style
    from matplotlib.lines import Line2D
    from matplotlib.ticker import LogLocator

    for row in rows:
        row["x"] = float(row[f"{options.time}_s"])
    runs = [row for row in rows if row["status"] == "finished" and row["error"] and row["is_reference"] != "1"]
    failed = [row for row in rows if row["status"] != "finished"]  # those that were not steady too
    if not runs:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: no run of {options.study} has an error")
    least = min((float(row["error"]) for row in runs if float(row["error"]) > 0), default=1e-6)
    for row in runs:  # an error of exactly 0 has no place on a logarithmic axis
        row["y"] = 100 * max(float(row["error"]), least / 2)

    figure, axes = style.plt.subplots(figsize=(style.width_of(options) + 1.3, 3.8))
    singly = one_at_a_time(rows, options.variables)
    if singly:
        runs.sort(key=lambda row: row["changed"] == "base")  # drawn last, as others hardly differ from it
    looks = Looks(style, sorted(runs + failed, key=lambda row: row["changed"] != "base") if singly else rows, ["changed"] if singly else options.variables)
    front = sorted((row for row in runs if row["front"] == "1"), key=lambda row: row["x"])
    axes.step([row["x"] for row in front], [row["y"] for row in front], where="post", color="#606060", linewidth=1.0, zorder=1)
    for row in runs:
        axes.plot(row["x"], row["y"], zorder=2, **looks.of(row))
        if row["front"] == "1":
            axes.plot(row["x"], row["y"], linestyle="", marker="o", markersize=9, fillstyle="none", color="black", markeredgewidth=0.7, zorder=2)
    axes.set(xscale="log", yscale="log", xlabel=f"{options.time} time (s)", ylabel="error (%)", title=style.plain(options.title or pathlib.Path(options.study).parent.name))
    limits = extrapolated(rows, options) if options.extrapolated else []
    draw_extrapolated(axes, limits, looks, least)
    ends = [row["x"] for row in runs + failed + limits]
    low, high = min(ends), max(ends)
    span = max(high / low, 2)  # a single run has none
    axes.set_xlim(low / span**0.05, high * span**0.12)  # room for the labels
    for row in failed:
        axes.plot(row["x"], 1, transform=axes.get_xaxis_transform(), clip_on=False, **(looks.of(row) | {"marker": "x", "fillstyle": "full"}))
    if options.within:
        axes.axhline(100 * options.within, **style.REFERENCE)
        axes.annotate(f"{100 * options.within:g} %", xy=(0, 100 * options.within), xycoords=("axes fraction", "data"), xytext=(2, 2),
                      textcoords="offset points", fontsize=8, color=style.REFERENCE["color"])
    for axis in (axes.xaxis, axes.yaxis):
        style.plain_log_ticks(axis)
        least, most = axis.get_view_interval()
        if most < 10 * least:  # 1, 2 and 5 alone would be too few
            axis.set_major_locator(LogLocator(subs=(1, 1.5, 2, 3, 4, 5, 7), numticks=12))

    entries = looks.legend() + [Line2D([], [], color="#606060", linewidth=1.0, marker="o", markersize=9, fillstyle="none", label="best so far")]
    if limits:
        entries.append(Line2D([], [], linestyle="", marker="D", markersize=6, markerfacecolor="white", color="black", label="extrapolated, time of its runs"))
    if failed:
        entries.append(Line2D([], [], linestyle="", marker="x", color="#606060", label="failed or unsteady" if any(row["status"] == "unsteady" for row in failed) else "failed"))
    axes.legend(handles=entries, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), handletextpad=0.2)
    label(axes, [(row, row["label"]) for row in sorted(runs, key=lambda row: row["y"])] if singly else front_labels(front[::-1], options.variables))
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", help="study.csv")
    parser.add_argument("--variables", required=True, type=lambda text: text.split(","), help="the swept ones, with commas")
    parser.add_argument("--time", choices=("wall", "core"), default="wall", help="which seconds to draw")
    parser.add_argument("--within", type=float, help="an error (share) to draw a line at")
    parser.add_argument("--extrapolated", metavar="VARIABLE", help="the resolution by which values were extrapolated: draws these too")
    parser.add_argument("--title")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    options = parser.parse_args()
    draw(read_runs(options), options)


if __name__ == "__main__":
    main()
