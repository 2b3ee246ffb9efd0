#!/usr/bin/env python3
"""Gradings: the cumulative curves, and Kenney and Lau's shape curves (H against F) with their line.

From the files that `suffuse-analyse grading PSD --curve CURVE.csv --shape SHAPE.csv` writes:

  grading.py CURVE.csv [CURVE.csv ...] [--shape SHAPE.csv ...] --output FIGURE.pdf [--names A B ...]
  grading.py --shape SHAPE.csv [SHAPE.csv ...] --output FIGURE.pdf

A panel for the curves, one for the shapes; the ending of --output says the format (png, pdf, svg).
"""
import argparse
import pathlib

from time_series import TimeSeries


def draw_curve(axes, series, name):
    axes.plot([1e3 * diameter for diameter in series["diameter_m"]], series["percent_finer"], label=name)


def draw_shape(axes, series, name):
    """The part that the criterion looks at in full, the rest thin."""
    searched = series["searched_to_percent"][0]
    finer, interval = series["finer_percent"], series["interval_percent"]
    line, = axes.plot(finer, interval, linewidth=0.6)
    inside = [(f, h) for f, h in zip(finer, interval) if f <= searched + 1e-6]
    axes.plot([f for f, _ in inside], [h for _, h in inside], color=line.get_color(), linewidth=2, label=name)


def draw(curves, shapes, names, options):
    import suffuse_style as style
    from matplotlib import pyplot

    panels = bool(curves) + bool(shapes)
    figure, axes = pyplot.subplots(panels, 1, figsize=(style.width_of(options), 3.0 * panels), squeeze=False)
    names = [style.plain(name) for name in names]
    for series, name in zip(curves, names):
        draw_curve(axes[0, 0], series, name)
    if curves:
        axes[0, 0].set(xscale="log", xlabel="grain diameter d (mm)", ylabel="finer by mass (%)", ylim=(0, 100))
        style.plain_log_ticks(axes[0, 0].xaxis)
        axes[0, 0].grid(True, which="both")
    if len(curves) > 1:
        axes[0, 0].legend()
    if shapes:
        panel = axes[-1, 0]
        for series, name in zip(shapes, names):
            draw_shape(panel, series, name)
        limit = shapes[0]["limit_ratio"][0]
        widest = max(series["searched_to_percent"][0] for series in shapes)
        panel.plot([0, 100 / (1 + limit)], [0, 100 * limit / (1 + limit)], **style.REFERENCE)
        panel.annotate("H = F" if limit == 1 else f"H = {limit:g} F", xy=(widest * 1.15, widest * 1.15 * limit), textcoords="offset points", xytext=(4, -9),
                       fontsize=8, color=style.REFERENCE["color"])
        panel.axvline(widest, color=style.REFERENCE["color"], linewidth=0.6, linestyle=":")
        panel.annotate("searched", xy=(widest, 1), xycoords=("data", "axes fraction"), xytext=(-3, -3), textcoords="offset points",
                       ha="right", va="top", fontsize=8, color=style.REFERENCE["color"])
        panel.set(xlabel="F, finer than d (% of the mass)", ylabel="H, between d and 4d (%)", xlim=(0, 60), ylim=(0, 100))
        if len(shapes) > 1:
            panel.legend()
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("curves", nargs="*", help="CSV files of cumulative curves")
    parser.add_argument("--shape", nargs="+", default=[], help="CSV files of shape curves, in the order of the curves")
    parser.add_argument("--names", nargs="+", help="what the soils are called; their files' names if not given")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    options = parser.parse_args()
    if not options.curves and not options.shape:
        parser.error("nothing to draw: give curves, --shape, or both")
    names = options.names or [pathlib.Path(path).stem for path in options.curves or options.shape]
    if any(len(files) not in (0, len(names)) for files in (options.curves, options.shape)):
        parser.error("as many --names and --shape files as curves, please")
    curves = [TimeSeries(path) for path in options.curves]
    for series in curves:
        series.require("diameter_m", "percent_finer")
    shapes = [TimeSeries(path) for path in options.shape]
    for series in shapes:
        series.require("finer_percent", "interval_percent", "searched_to_percent", "limit_ratio")
    draw(curves, shapes, names, options)


if __name__ == "__main__":
    main()
