#!/usr/bin/env python3
"""Distribution of contact forces: probability densities of f_N and f_T over their means, on a logarithmic axis.

From the file that `suffuse-analyse contacts --force-pdf` writes. Its last snapshot is drawn, or those of --steps, over each other.

  forces.py FORCES.csv [--steps 1000 2000 ...] --output FIGURE.pdf
"""
import argparse
import sys

from time_series import TimeSeries

KINDS = (("density_normal", "normal forces", "-"), ("density_tangential", "tangential forces", "--"))


def of_step(series, step, column):
    """Middles of the bins and densities, without the empty bins, which a logarithmic axis has no place for."""
    points = [((low + high) / 2, density) for at, low, high, density in zip(series["step"], series["force_over_mean_low"],
                                                                           series["force_over_mean_high"], series[column])
              if at == step and density > 0]
    return [x for x, _ in points], [y for _, y in points]


def beyond(series, step, column):
    """Share of the forces that are larger than the last bin's: what the densities lack of one."""
    held = sum((high - low) * density for at, low, high, density in zip(series["step"], series["force_over_mean_low"], series["force_over_mean_high"],
                                                                      series[column]) if at == step)
    return 1 - held if held > 0 else 0.0


def tangential_over_normal(series, step):
    at = series["step"].index(step)
    if "mean_tangential_force_n" not in series or not series["mean_normal_force_n"][at] > 0:
        return None
    return series["mean_tangential_force_n"][at] / series["mean_normal_force_n"][at]


def draw(series, steps, options):
    import suffuse_style as style
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(style.width_of(options), 3.2))
    colours = list(style.COLOURS.values())
    for which, step in enumerate(steps):
        for kind, (column, name, line) in enumerate(KINDS):
            label = name if len(steps) == 1 else f"{name}, step {step:g}"
            share = tangential_over_normal(series, step)
            if column == "density_tangential" and share is not None and share < style.NOISE:
                axes.plot([], [], linestyle="", label=f"no {label}: their mean is {share:.1g} $f_0$,\nno friction is at work")
                continue
            if beyond(series, step, column) > 0.002:
                label += f"\n({100 * beyond(series, step, column):.2g} % are larger)"
            colour = colours[kind] if len(steps) == 1 else colours[which % len(colours)]
            axes.plot(*of_step(series, step, column), color=colour, linestyle=line, label=label)
    axes.axvline(1, **style.REFERENCE)
    axes.annotate("mean", xy=(1, 1), xycoords=("data", "axes fraction"), xytext=(3, -2), textcoords="offset points", va="top",
                  fontsize=8, color=style.REFERENCE["color"])
    axes.set(yscale="log", xlabel="force over its mean, $f/\\langle f\\rangle$ (−)", ylabel="probability density (−)", xlim=(0, None))
    axes.legend()
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("forces", help="CSV file of the force distribution")
    parser.add_argument("--steps", type=float, nargs="+", help="snapshots; the last one if not given")
    parser.add_argument("--width", type=float, help="of the figure, inches")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    options = parser.parse_args()
    series = TimeSeries(options.forces)
    series.require("step", "force_over_mean_low", "force_over_mean_high", *(column for column, _, _ in KINDS))
    steps = options.steps or [series.last("step")]
    missing = [f"{step:g}" for step in steps if step not in series["step"]]
    if missing:
        sys.exit(f"{options.forces}: has no step {', '.join(missing)}; its last one is {series.last('step'):g}")
    draw(series, steps, options)


if __name__ == "__main__":
    main()
