#!/usr/bin/env python3
"""Error against time of the runs of a study, from the study.csv of `suffuse-study`, with the front that no other run beats.

  accuracy_and_time.py study.csv --variables resolution,operator --output FIGURE.png

The first variable gives a point its colour, the second its shape; points of the front have the values that change along it
written beside them. Crosses at the upper edge are runs that failed. The ending of --output says the format (png, pdf, svg).
"""
import argparse
import csv
import pathlib
import sys

MARKERS = "osD^vP<>*h"


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


def colours(style, values):
    if len(values) <= len(style.COLOURS):
        return dict(zip(values, style.COLOURS.values()))
    shades = style.matplotlib.colormaps["viridis"] if hasattr(style.matplotlib, "colormaps") else style.plt.get_cmap("viridis")
    return {value: shades(0.95 * k / (len(values) - 1)) for k, value in enumerate(values)}


def label_front(axes, front, options):
    """Beside each point of the front the values that change along it."""
    import matplotlib.patheffects as effects

    changing = [name for name in options.variables if len({row[name] for row in front}) > 1] or options.variables[:1]
    for row in front:
        axes.annotate(", ".join(row[name] for name in changing), xy=(row["x"], row["y"]), xytext=(5, 4), textcoords="offset points", fontsize=6.5,
                      ha="left", va="bottom", annotation_clip=False, zorder=3, path_effects=[effects.withStroke(linewidth=2.5, foreground="white")])


def draw(rows, options):
    import suffuse_style as style
    from matplotlib.lines import Line2D

    for row in rows:
        row["x"] = float(row[f"{options.time}_s"])
    runs = [row for row in rows if row["status"] == "finished" and row["error"] and row["is_reference"] != "1"]
    failed = [row for row in rows if row["status"] != "finished"]
    if not runs:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: no run of {options.study} has an error")
    least = min((float(row["error"]) for row in runs if float(row["error"]) > 0), default=1e-6)
    for row in runs:  # an error of exactly 0 has no place on a logarithmic axis
        row["y"] = 100 * max(float(row["error"]), least / 2)

    figure, axes = style.plt.subplots(figsize=(style.width_of(options) + 1.3, 3.8))
    by_colour = options.variables[0]
    by_marker = options.variables[1] if len(options.variables) > 1 else None
    colour_of = colours(style, classes(rows, by_colour))
    marker_of = {value: MARKERS[k % len(MARKERS)] for k, value in enumerate(classes(rows, by_marker))} if by_marker else {}
    front = sorted((row for row in runs if row["front"] == "1"), key=lambda row: row["x"])
    axes.step([row["x"] for row in front], [row["y"] for row in front], where="post", color="#606060", linewidth=1.0, zorder=1)
    for row in runs:
        axes.plot(row["x"], row["y"], linestyle="", marker=marker_of.get(row[by_marker], "o") if by_marker else "o", markersize=5,
                  color=colour_of[row[by_colour]], markeredgecolor="black" if row["front"] == "1" else "none", markeredgewidth=0.8, zorder=2)
    axes.set(xscale="log", yscale="log", xlabel=f"{options.time} time (s)", ylabel="error (%)", title=options.title or pathlib.Path(options.study).parent.name)
    low, high = axes.get_xlim()
    axes.set_xlim(low, high * (high / low) ** 0.12)  # room for the labels
    for row in failed:
        axes.plot(row["x"], 1, linestyle="", marker="x", color=colour_of[row[by_colour]], transform=axes.get_xaxis_transform(), clip_on=False)
    label_front(axes, front, options)
    if options.within:
        axes.axhline(100 * options.within, **style.REFERENCE)
        axes.annotate(f"{100 * options.within:g} %", xy=(0, 100 * options.within), xycoords=("axes fraction", "data"), xytext=(2, 2),
                      textcoords="offset points", fontsize=8, color=style.REFERENCE["color"])
    style.plain_log_ticks(axes.xaxis)
    style.plain_log_ticks(axes.yaxis)

    def title_entry(text):
        return Line2D([], [], linestyle="", label=text.replace("_", " "))

    entries = [title_entry(by_colour)] + [Line2D([], [], linestyle="", marker="o", color=colour, label=f"  {value}") for value, colour in colour_of.items()]
    if by_marker:
        entries += [title_entry(by_marker)] + [Line2D([], [], linestyle="", marker=marker, color="#606060", label=f"  {value}") for value, marker in marker_of.items()]
    entries.append(Line2D([], [], color="#606060", linewidth=1.0, label="best so far"))
    if failed:
        entries.append(Line2D([], [], linestyle="", marker="x", color="#606060", label="failed"))
    axes.legend(handles=entries, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5), handletextpad=0.2)
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", help="study.csv")
    parser.add_argument("--variables", required=True, type=lambda text: text.split(","), help="the swept ones, with commas")
    parser.add_argument("--time", choices=("wall", "core"), default="wall", help="which seconds to draw")
    parser.add_argument("--within", type=float, help="an error (share) to draw a line at")
    parser.add_argument("--title")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    options = parser.parse_args()
    draw(read_runs(options), options)


if __name__ == "__main__":
    main()
