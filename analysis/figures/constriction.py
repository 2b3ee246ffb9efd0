#!/usr/bin/env python3
"""Constriction sizes of a soil, and where eqs 4.7 and 4.8 of the thesis put it between stable and unstable.

From the files that `suffuse-analyse constriction` writes with --distribution and --prediction:

  constriction.py --distribution FILE.csv [--grading CURVE.csv] --output FIGURE.pdf     constriction size distribution
  constriction.py [--prediction FILE.csv ...] [--measured CONTACTS.csv ...] --output FIGURE.pdf    Z and alpha, one of both at least

CURVE.csv is of `suffuse-analyse grading --curve`, CONTACTS.csv of `suffuse-analyse contacts --output` (its last row).
The ending of --output says the format (png, pdf, svg).
"""
import argparse
import pathlib

from time_series import TimeSeries

FRACTIONS = (("surface_area", "surface area", "blue"), ("mass", "mass", "orange"), ("number", "number", "green"))


def draw_distribution(series, grading, options):
    import suffuse_style as style
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(style.width_of(options), 3.6))
    percent = series["percent_finer"]
    # Of what is drawn, and named below it.
    drawn = [key for key, _, _ in FRACTIONS if key in options.fractions and f"dense_by_{key}_m" in series]
    sizes = [size for key in drawn for size in series[f"loose_by_{key}_m"]] + list(series["packing_m"] if "packing_m" in series else [])
    factor, unit = style.length_unit(*sizes, *(grading["diameter_m"] if grading else []))

    def in_unit(column):
        return [factor * size for size in series[column]]

    for key, name, colour in FRACTIONS:
        if key not in drawn:
            continue
        colour = style.COLOURS[colour]
        if key == "surface_area":
            axes.fill_betweenx(percent, in_unit(f"dense_by_{key}_m"), in_unit(f"loose_by_{key}_m"), color=colour, alpha=0.15,
                               linewidth=0, label="three to four grains, by surface area")
        axes.plot(in_unit(f"at_density_by_{key}_m"), percent, color=colour, label=f"at the relative density, by {name}")
    if "packing_m" in series:
        axes.plot(in_unit("packing_m"), percent, color=style.COLOURS["vermilion"], label=style.plain(options.packing_name))
    for path, colour, line in zip(options.others, ("purple", "sky"), ("--", "-.")):
        other = TimeSeries(path)
        other.require("packing_m", "percent_finer")
        axes.plot([factor * size for size in other["packing_m"]], other["percent_finer"], color=style.COLOURS[colour], linestyle=line,
                  label=style.plain(options.other_names.pop(0) if options.other_names else pathlib.Path(path).stem))
    if grading:
        axes.plot([factor * size for size in grading["diameter_m"]], grading["percent_finer"], color="black", label="grains, by mass")
    axes.axhline(35, **style.REFERENCE)
    axes.annotate("35 % ($D_{c35}$)", xy=(1, 35), xycoords=("axes fraction", "data"), xytext=(-2, 2), textcoords="offset points", fontsize=8, ha="right",
                  color=style.REFERENCE["color"])
    axes.set(xscale="log", xlabel=f"constriction or grain diameter ({unit})", ylabel="finer (%)", ylim=(0, 100))
    style.plain_log_ticks(axes.xaxis)
    axes.grid(True, which="both")
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.2))
    style.save(figure, options.output)


def draw_prediction(predictions, names, measured, options):
    import suffuse_style as style
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(style.width_of(options), 3.6))
    for series, name in zip(predictions, names):
        line, = axes.plot(series["coordination_number"], series["stress_reduction"], marker=".", markersize=3, label=f"{style.plain(name)}, predicted")
        ends = [(series["coordination_number"][i], series["stress_reduction"][i]) for i in (0, -1)]
        if max(abs(a - b) for a, b in zip(*ends)) < 0.3:  # no room for a name at either end
            continue
        for index, text in ((0, "loosest"), (-1, "densest")):
            axes.annotate(text, xy=(series["coordination_number"][index], series["stress_reduction"][index]), xytext=(4, -9),
                          textcoords="offset points", fontsize=7, color=line.get_color())
    for path, series in measured:
        axes.plot(series.last("coordination_number"), series.last("alpha_pair_halves"), linestyle="", marker="D", markersize=5,
                  label=f"{style.plain(pathlib.Path(path).stem)}, measured")
    axes.axvline(1, **style.REFERENCE)
    axes.axhline(0.5, **style.REFERENCE)
    axes.annotate("Z = 1", xy=(1, 1), xycoords=("data", "axes fraction"), xytext=(3, -8), textcoords="offset points", fontsize=8,
                  color=style.REFERENCE["color"])
    axes.annotate("α = 0.5", xy=(1, 0.5), xycoords=("axes fraction", "data"), xytext=(-2, 3), textcoords="offset points", fontsize=8,
                  ha="right", color=style.REFERENCE["color"])
    # unstable: light by "Z <= 1 or alpha <= 0.5", dark by both
    axes.axvspan(0, 1, color="#808080", alpha=0.10, linewidth=0)
    axes.axhspan(0, 0.5, color="#808080", alpha=0.10, linewidth=0)
    axes.fill_between([0, 1], 0, 0.5, color="#808080", alpha=0.15, linewidth=0)
    axes.annotate("unstable", xy=(0.5, 0.97), xycoords=("data", "axes fraction"), rotation=90, ha="center", va="top", fontsize=8,
                  color=style.REFERENCE["color"])
    highest = [max([limit] + [value for _, series in measured for value in [series.last(column)]])
               for limit, column in ((6, "coordination_number"), (1.85, "alpha_pair_halves"))]
    axes.set(xlabel="coordination number Z (−)", ylabel="stress reduction factor α (−)", xlim=(0, 1.08 * highest[0]), ylim=(0, 1.08 * highest[1]))
    axes.legend(fontsize=7, loc="lower right")
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--distribution", help="CSV file of constriction sizes")
    parser.add_argument("--grading", help="CSV file of the grading's curve, to draw beside them")
    parser.add_argument("--packing-name", default="of the packing, by number", help="what the packing's own constrictions are called")
    parser.add_argument("--others", nargs="+", default=[], help="distributions of other packings, two at most")
    parser.add_argument("--other-names", nargs="+", default=[], help="what they are called")
    parser.add_argument("--fractions", nargs="+", default=[key for key, _, _ in FRACTIONS], choices=[key for key, _, _ in FRACTIONS],
                        help="which probabilities of the classes to draw")
    parser.add_argument("--prediction", nargs="+", default=[], help="CSV files of Z and alpha over the relative density")
    parser.add_argument("--measured", nargs="+", default=[], help="CSV files of measured contacts")
    parser.add_argument("--names", nargs="+", help="what the soils are called; their files' names if not given")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    options = parser.parse_args()
    if bool(options.distribution) == bool(options.prediction or options.measured):
        parser.error("one figure a time: give --distribution, or --prediction and --measured")
    if options.distribution:
        series = TimeSeries(options.distribution)
        series.require("percent_finer")
        draw_distribution(series, TimeSeries(options.grading) if options.grading else None, options)
        return
    names = options.names or [pathlib.Path(path).stem for path in options.prediction]
    if len(names) != len(options.prediction):
        parser.error("as many --names as predictions, please")
    predictions = [TimeSeries(path) for path in options.prediction]
    for series in predictions:
        series.require("coordination_number", "stress_reduction")
    measured = [(path, TimeSeries(path)) for path in options.measured]
    for _, series in measured:
        series.require("coordination_number", "alpha_pair_halves")
    draw_prediction(predictions, names, measured, options)


if __name__ == "__main__":
    main()
