#!/usr/bin/env python3
"""Layer profiles of a column of grains: what changes over the depth, at several instants.

From a monitor's file (`lbm monitor … layers LO HI N`) or any time series that has a column a layer, NAME_1 (top) to NAME_N:

  layers.py FLOW.csv [--quantities porosity_layer effective_stress_ratio] [--times 0 0.05 0.1] [--extent LO HI] --output FIGURE.pdf

Without --quantities all that have layers are drawn; without --times four instants from the first to the last; with --extent (m, bottom
and top of the layers) heights stand at the side, else the layers' numbers.
"""
import argparse
import re
import sys

import follow
from time_series import TimeSeries

NAMES = {"hydraulic_gradient_layer": "local gradient i (−)", "porosity_layer": "porosity n (−)", "pressure_layer_pa": "pressure (Pa)",
         "vertical_stress_pa": "σ′$_{zz}$ (Pa)", "effective_stress_ratio": "σ′$_{zz}$/σ′$_{zz0}$ (−)", "void_ratio": "void ratio e (−)",
         "void_ratio_layer": "void ratio e (−)", "coordination_layer": "coordination number Z (−)", "stable_share_layer": "stable share M$_s$ (−)"}


def layered(series):
    """Quantities and their columns, from the first layer to the last."""
    found = {}
    for column in series.columns:
        match = re.fullmatch(r"(.+)_(\d+)(_pa)?", column)
        if match:
            found.setdefault(match[1] + (match[3] or ""), {})[int(match[2])] = column
    return {name: [columns[k] for k in sorted(columns)] for name, columns in found.items()
            if len(columns) > 1 and sorted(columns) == list(range(1, len(columns) + 1))}


def nearest(series, times):
    return sorted({min(range(len(series["time_s"])), key=lambda k: abs(series["time_s"][k] - time)) for time in times})


def draw(series, quantities, rows, options):
    import suffuse_style as style

    across = min(len(quantities), 2)
    down = -(-len(quantities) // across)
    figure, axes = style.plt.subplots(down, across, figsize=(style.width_of(options), 2.7 * down + 0.4), sharey=True, squeeze=False)
    for panel in axes.flat[len(quantities):]:
        panel.set_visible(False)
    for panel, (name, columns) in zip(axes.flat, quantities.items()):
        count = len(columns)
        places = list(range(1, count + 1))
        if options.extent:
            low, high = options.extent
            places = [1e3 * (high - (k - 0.5) * (high - low) / count) for k in places]
        for which, row in enumerate(rows):
            panel.plot([series[column][row] for column in columns], places, marker=".", label=f"{1e3 * series['time_s'][row]:.4g} ms",
                       color=list(style.COLOURS.values())[which % 6])
        panel.set_xlabel(NAMES.get(name, name.replace("_", " ")))
    for panel in axes[:, 0]:
        panel.set_ylabel("height (mm)" if options.extent else "layer (1: top)")
    if not options.extent:
        axes[0, 0].invert_yaxis()
        axes[0, 0].yaxis.get_major_locator().set_params(integer=True)
    axes[0, 0].legend(loc="lower left", bbox_to_anchor=(0, 1.02), ncols=2, fontsize=8)
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", help="CSV file with a column a layer")
    parser.add_argument("--quantities", nargs="+", help="which to draw: names without the layer's number")
    parser.add_argument("--times", type=float, nargs="+", help="instants, s; the nearest rows are taken")
    parser.add_argument("--extent", type=float, nargs=2, metavar=("LO", "HI"), help="bottom and top of the layers, m")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    follow.add_option(parser)
    options = parser.parse_args()
    follow.draw_once_or_follow(options, [options.series], lambda: show(options))


def show(options):
    series = TimeSeries(options.series, growing=options.follow is not None)
    series.require("time_s")
    found = layered(series)
    if not found:
        sys.exit(f"{options.series}: no quantity has a column a layer (NAME_1, NAME_2, …)")
    unknown = [name for name in options.quantities or [] if name not in found]
    if unknown:
        sys.exit(f"{options.series}: has no layers of {', '.join(unknown)}; it has {', '.join(found)}")
    quantities = {name: found[name] for name in options.quantities or found}
    last = series.last("time_s")
    first = series["time_s"][0]
    times = options.times or [first + (last - first) * k / 3 for k in range(4)]
    draw(series, quantities, nearest(series, times), options)


if __name__ == "__main__":
    main()
