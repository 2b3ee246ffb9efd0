#!/usr/bin/env python3
"""Suffusion: what water washes out of a column under stress, where it clogs, and how the column answers.

From the monitor file of a run of input_scripts/09_suffusion, and its result file for the critical gradients beside it:

  suffusion.py FLOW.csv [--results suffusion_result.csv] [--against gradient|time] --output suffusion.png [--follow]
  suffusion.py --grains bed_grains.h5 --split DIAMETER [--times SECONDS ...] --output grains.png

The first draws the share of the fines that have left, the velocity, the gradient of each layer over the mean, fines content and Z of the
layers, and the stresses of both platens with the settlement. The second draws the grains seen from the side at the given instants (first and
last): coarse ones grey, fines coloured.
"""
import argparse
import csv
import sys

import follow
from time_series import TimeSeries, numbered

MARKS = (("skempton_brogan", "Skempton and Brogan", "green"), ("li_fannin", "Li and Fannin", "vermilion"),
         ("heave_under_the_stress", "heave", "purple"))


def results_of(path):
    if path is None:
        return {}
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}
    except (OSError, KeyError, ValueError) as problem:
        sys.exit(f"{path}: is no result file of the scene ({problem})")


def draw_layers(panel, abscissa, columns, label):
    import suffuse_style as style

    for number, (values, colour) in enumerate(zip(columns, style.shades(len(columns))), start=1):
        panel.plot(abscissa, values, color=colour, label=f"layer {number}" + (" (top)" if number == 1 else ""))
    panel.set_ylabel(label)


def draw_record(series, results, options):
    import suffuse_style as style

    by_time = options.against == "time"
    abscissa = series["time_s"] if by_time else series["applied_gradient"]
    figure, axes = style.stacked_panels(6, panel_height=1.45, width=style.width_of(options))
    axes[0].plot(abscissa, [100 * share for share in series["eroded_fines_share"]], color=style.COLOURS["blue"])
    axes[0].set_ylabel("fines that\nhave left (%)")
    axes[1].plot(abscissa, [1e3 * v for v in series["superficial_velocity_z_m_per_s"]], color=style.COLOURS["blue"])
    axes[1].set_ylabel("velocity\n(mm/s)")
    gradients = numbered(series, "hydraulic_gradient_layer_")
    means = [sum(row) / len(row) for row in zip(*gradients)]
    floor = 0.05 * max(abs(mean) for mean in means)
    over = [[g / mean if abs(mean) > floor else float("nan") for g, mean in zip(layer, means)] for layer in gradients]
    draw_layers(axes[2], abscissa, over, "gradient of layer\nover mean (−)")
    axes[2].legend(fontsize=7, ncols=4, loc="lower left", bbox_to_anchor=(0, 1))
    draw_layers(axes[3], abscissa, [[100 * v for v in layer] for layer in numbered(series, "fines_share_layer_")], "fines\ncontent (%)")
    draw_layers(axes[4], abscissa, numbered(series, "coordination_layer_"), "Z (−)")
    axes[5].plot(abscissa, series["platen_stress_pa"], color=style.COLOURS["sky"], label="upper platen")
    axes[5].plot(abscissa, series["base_stress_pa"], color=style.COLOURS["blue"], label="lower platen")
    axes[5].set_ylabel("stress (Pa)")
    settlement = axes[5].twinx()
    settlement.plot(abscissa, [1e6 * s for s in series["settlement_m"]], color=style.COLOURS["orange"], linestyle="--")
    settlement.set_ylabel("settlement (µm, dashed)")
    settlement.grid(False)
    axes[5].legend(fontsize=7, loc="lower left")
    for panel in axes if not by_time else ():
        for quantity, label, colour in MARKS:
            if quantity in results and results[quantity] <= max(abscissa):
                panel.axvline(results[quantity], color=style.COLOURS[colour], linestyle=":", linewidth=1.2,
                              label=f"{label}, i = {results[quantity]:.2f}" if panel is axes[0] else None)
    if not by_time and results:
        axes[0].legend(fontsize=7, loc="upper left")
    axes[-1].set_xlabel("time of the water (s)" if by_time else "applied gradient i (−)")
    figure.align_ylabels(axes)
    style.save(figure, options.output)


def draw_grains(options):
    import suffuse_style as style

    try:
        import h5py
    except ImportError:
        sys.exit("suffusion.py: this Python has no h5py; install it (apt-get install python3-h5py) or use Debian's Python, /usr/bin/python3")
    with h5py.File(options.grains, "r") as file:
        states = sorted((group for name, group in file.items() if name.startswith("step_")), key=lambda group: int(group.name.split("_")[-1]))
        if not states:
            sys.exit(f"{options.grains}: has no states; is it the grains' file of `lbm output ... grains`?")
        times = [float(group.attrs["time_s"]) for group in states]
        wanted = options.times or [times[0], times[-1]]
        chosen = [min(range(len(times)), key=lambda k: abs(times[k] - time)) for time in wanted]
        figure, axes = style.plt.subplots(1, len(chosen), figsize=(style.width_of(options), 1.35 * style.width_of(options) / len(chosen) + 0.6), sharey=True, squeeze=False)
        for panel, which in zip(axes[0], chosen):
            position, radius = states[which]["grains/position"][:], states[which]["grains/radius"][:]
            draw_side(panel, position, radius, options.split)
            panel.set_title(f"{times[which]:.3g} s")
            panel.set_xlabel("x (mm)")
        axes[0][0].set_ylabel("z (mm)")
    style.save(figure, options.output)


def draw_side(panel, position, radius, split):
    """From the front, y towards the eye: those behind first."""
    import suffuse_style as style

    for k in sorted(range(len(radius)), key=lambda k: -position[k][1]):
        fine = 2 * radius[k] < split
        panel.add_patch(style.plt.Circle((1e3 * position[k][0], 1e3 * position[k][2]), 1e3 * radius[k], linewidth=0.3, edgecolor="#404040",
                                         facecolor=style.COLOURS["vermilion"] if fine else "#d8d8d8"))
    panel.set_aspect("equal")
    panel.autoscale_view()
    panel.grid(False)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", nargs="?", help="flow.csv of a run")
    parser.add_argument("--results", help="suffusion_result.csv of the run")
    parser.add_argument("--against", choices=("gradient", "time"), default="gradient", help="abscissa; time for held or cyclic gradients")
    parser.add_argument("--grains", help="bed_grains.h5 of a run, instead of the record")
    parser.add_argument("--split", type=float, help="with --grains: diameter below which grains are fines, m")
    parser.add_argument("--times", type=float, nargs="+", help="with --grains: instants, s")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    follow.add_option(parser)
    options = parser.parse_args()
    if (options.series is None) == (options.grains is None):
        parser.error("give flow.csv, or --grains bed_grains.h5")
    if options.grains is not None:
        if options.split is None:
            parser.error("--grains needs --split")
        if options.follow is not None:
            parser.error("--follow draws flow.csv, not --grains")
        draw_grains(options)
        return

    def show():
        series = TimeSeries(options.series, growing=options.follow is not None)
        series.require("time_s", "applied_gradient", "eroded_fines_share", "superficial_velocity_z_m_per_s", "hydraulic_gradient_layer_1", "settlement_m")
        draw_record(series, results_of(options.results), options)

    follow.draw_once_or_follow(options, [options.series], show)


if __name__ == "__main__":
    main()
