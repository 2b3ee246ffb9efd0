#!/usr/bin/env python3
"""Isotropic compression: mean effective stress, porosity and coordination number of a run, from its time series.

Needs the columns time_s, mean_stress_pa and void_ratio; draws coordination_number and inertial_number where they are.
Porosity is e/(1+e). Compression is positive.

  compression.py SERIES.csv --output FIGURE.png --target 200e3     the figure
  compression.py SERIES.csv --output FIGURE.png --follow           the figure, again and again while the run goes on
  compression.py SERIES.csv --table --target 200e3                 the last state, as a table on the screen
"""
import argparse

import follow
from time_series import TimeSeries


def porosity(void_ratio):
    return void_ratio / (1.0 + void_ratio)


def draw(series, target_pa, output):
    import suffuse_style as style

    panels = ["stress", "porosity"]
    panels += [name for name in ("coordination_number", "inertial_number") if name in series]
    figure, axes = style.stacked_panels(len(panels))
    time_ms = [1e3 * time for time in series["time_s"]]
    for name, panel in zip(panels, axes):
        if name == "stress":
            panel.plot(time_ms, [1e-3 * stress for stress in series["mean_stress_pa"]])
            panel.set_ylabel("mean effective\nstress p′ (kPa)")
            if target_pa is not None:
                style.reference_line(panel, 1e-3 * target_pa, f"target {1e-3 * target_pa:g} kPa")
                panel.margins(y=0.18)  # room for the name of the target above its line
        elif name == "porosity":
            panel.plot(time_ms, [porosity(void_ratio) for void_ratio in series["void_ratio"]])
            panel.set_ylabel("porosity n (−)")
        elif name == "coordination_number":
            panel.plot(time_ms, series["coordination_number"])
            panel.set_ylabel("coordination\nnumber Z (−)")
        else:
            panel.semilogy(time_ms, series["inertial_number"])
            panel.set_ylim(bottom=max(panel.get_ylim()[0], 1e-6))  # below it the sample rests; how well is no matter
            panel.set_ylabel("inertial\nnumber I (−)")
    axes[-1].set_xlabel("time of the simulation (ms)")
    figure.align_ylabels(axes)
    style.save(figure, output)


def table(series, target_pa):
    mean_stress = series.last("mean_stress_pa")
    rows = [("time of the simulation", f"{1e3 * series.last('time_s'):.4g}", "ms"),
            ("mean effective stress p'", f"{1e-3 * mean_stress:.2f}", "kPa")]
    if target_pa is not None:
        rows.append(("its distance to the target", f"{100 * (mean_stress / target_pa - 1):+.2f}", f"% of {1e-3 * target_pa:g} kPa"))
    rows += [("void ratio e", f"{series.last('void_ratio'):.4f}", ""),
             ("porosity n", f"{porosity(series.last('void_ratio')):.4f}", "")]
    if "coordination_number" in series:
        rows.append(("coordination number Z", f"{series.last('coordination_number'):.3f}", ""))
    width = max(len(name) for name, _, _ in rows)
    return "\n".join(f"  {name:<{width}}  {value:>10} {unit}".rstrip() for name, value, unit in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", help="CSV file of the run")
    parser.add_argument("--output", help="figure to write; its ending says the format")
    parser.add_argument("--target", type=float, help="target of the mean effective stress, Pa")
    parser.add_argument("--table", action="store_true", help="print the last state")
    follow.add_option(parser)
    options = parser.parse_args()
    if not options.output and not options.table:
        parser.error("nothing to do: give --output FIGURE, --table, or both")

    def show():
        series = TimeSeries(options.series, growing=options.follow is not None)
        series.require("time_s", "mean_stress_pa", "void_ratio")
        if options.output:
            draw(series, options.target, options.output)
        if options.table:
            print(table(series, options.target))

    follow.draw_once_or_follow(options, [options.series], show)


if __name__ == "__main__":
    main()
