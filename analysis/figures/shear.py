#!/usr/bin/env python3
"""Shearing: stress ratio, volumetric strain, coordination numbers, alpha and sliding contacts against axial strain.

Draws what the columns of one or several time series give (those of 02_constant_p_shear or 08_triaxial); several
series are drawn over each other and named by their folders or by --labels. Dilation is drawn upwards, as the thesis
does; in the files compression is positive.

  shear.py SERIES.csv [SERIES.csv ...] --output FIGURE.png [--labels NAME ...] [--follow]
"""
import argparse
import pathlib

import follow
from time_series import TimeSeries

# (columns, label of the axis, how to draw them)
PANELS = [
    (("stress_ratio",), "stress ratio\nq/p′ (−)"),
    (("dilation",), "volumetric strain\n(%, dilation +)"),
    (("coordination_number", "coordination_coarse_coarse", "coordination_fine_coarse"), "coordination\nnumbers (−)"),
    (("alpha_pair_halves", "alpha_contact_point"), "stress reduction\nfactor α (−)"),
    (("sliding_share",), "sliding contacts\n(share)"),
]
NAMES = {"coordination_number": "Z", "coordination_coarse_coarse": "coarse–coarse", "coordination_fine_coarse": "fines",
         "alpha_pair_halves": "pair halves (Appendix F)", "alpha_contact_point": "contact point (eq 4.2)"}


def values(series, column):
    """A column, or one derived from others; None if the series has not what it needs."""
    if column == "stress_ratio":
        return [q / p for q, p in zip(series["deviatoric_stress_pa"], series["mean_stress_pa"])]
    if column == "dilation":
        return [-100 * strain for strain in series["volumetric_strain"]] if "volumetric_strain" in series else None
    return series[column] if column in series else None


def draw(runs, labels, output):
    import suffuse_style as style

    panels = [(columns, label) for columns, label in PANELS if any(values(run, column) for run in runs for column in columns)]
    figure, axes = style.stacked_panels(len(panels))
    lines = ("-", "--", ":", "-.")
    colours = list(style.COLOURS.values())
    for panel, (columns, label) in zip(axes, panels):
        drawn = [column for column in columns if any(values(run, column) for run in runs)]
        for which, run in enumerate(runs):
            strain = [100 * e for e in run["axial_strain"]]
            for k, column in enumerate(drawn):
                data = values(run, column)
                if data:
                    panel.plot(strain, data, color=colours[which % len(colours)], linestyle=lines[k % len(lines)],
                               label=NAMES.get(column) if which == 0 and len(drawn) > 1 else None)
        panel.set_ylabel(label)
        if len(drawn) > 1:
            panel.legend(fontsize=7)
    if len(runs) > 1:
        for which, name in enumerate(labels):
            axes[0].plot([], [], color=colours[which % len(colours)], label=style.plain(name))
        axes[0].legend(fontsize=7)
    axes[-1].set_xlabel("axial strain (%)")
    figure.align_ylabels(axes)
    style.save(figure, output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", nargs="+", help="CSV files of runs")
    parser.add_argument("--labels", nargs="+", help="one name a series")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    follow.add_option(parser)
    options = parser.parse_args()
    labels = options.labels or [pathlib.Path(path).resolve().parent.name for path in options.series]
    if len(labels) != len(options.series):
        parser.error(f"{len(labels)} labels for {len(options.series)} series")

    def show():
        runs = [TimeSeries(path, growing=options.follow is not None) for path in options.series]
        for run in runs:
            run.require("axial_strain", "mean_stress_pa", "deviatoric_stress_pa")
        draw(runs, labels, options.output)

    follow.draw_once_or_follow(options, options.series, show)


if __name__ == "__main__":
    main()
