#!/usr/bin/env python3
"""Rose diagrams of contacts and forces, and the spherical histogram, from the CSV files of `suffuse-analyse rose`.

  rose.py ROSE.csv [--plane xz] --output FIGURE.png        contacts, normal and tangential forces by their direction, with the fits
  rose.py --sphere SPHERE.csv --output FIGURE.png          contacts and normal forces over the upper half of the sphere, in a projection
                                                           that keeps areas (Lambert), against an even distribution
"""
import argparse
import math

from time_series import TimeSeries

ROSES = [("contact_density", "_per_rad", "contacts, E (1/rad)"), ("normal_force_density", "_per_rad", "normal forces (1/rad)"),
         ("mean_tangential_force", "_over_f0", "mean tangential force / $f_0$ (−)")]


def fine_fit(series, name, unit):
    """The fit between bin centres: a Fourier series through the values at the centres, which is the fit itself."""
    import numpy as np

    values = np.array(series[f"{name}_fit{unit}"])
    low = np.array(series["angle_low_rad"])
    centres = low + math.pi / len(values)
    spectrum = [(k, 2 / len(values) * np.sum(values * np.cos(k * centres)), 2 / len(values) * np.sum(values * np.sin(k * centres)))
                for k in range(1, (len(values) + 1) // 2)]
    angle = np.linspace(0, 2 * math.pi, 721)
    return angle, values.mean() + sum(c * np.cos(k * angle) + s * np.sin(k * angle) for k, c, s in spectrum)


def draw_rose(path, plane, options):
    import suffuse_style as style

    series = TimeSeries(path)
    series.require("angle_low_rad", "angle_high_rad", *(f"{name}{unit}" for name, unit, _ in ROSES))
    roses = ROSES[:options.panels]
    if options.width:  # narrow: one above the other
        shape, size = (len(roses), 1), (options.width, 0.85 * options.width * len(roses))
    else:
        shape, size = (1, len(roses)), (2.8 * len(roses), 3.3)
    figure, axes = style.plt.subplots(*shape, figsize=size, subplot_kw={"projection": "polar"}, squeeze=False)
    low, high = series["angle_low_rad"], series["angle_high_rad"]
    for panel, (name, unit, title) in zip(axes.flat, roses):
        values = series[f"{name}{unit}"]
        panel.set_title(title, pad=12)
        panel.tick_params(labelsize=8 if options.width else 6.5)
        panel.set_xticks([k * math.pi / 4 for k in range(8)])
        panel.set_xticklabels([plane[0], "45°", plane[1], "135°", "180°", "", "270°", ""])
        largest = max(abs(v) for v in values)
        if unit == "_over_f0" and largest < style.NOISE:
            panel.set_yticks([])
            panel.annotate(f"none: at most {largest:.1g} $f_0$,\nno friction is at work", xy=(0.5, 0.5), xycoords="axes fraction", ha="center", va="center", fontsize=8)
            continue
        signed = min(values) < 0
        bars = panel.bar(low, [abs(v) for v in values], width=[b - a for a, b in zip(low, high)], align="edge", linewidth=0.4, edgecolor="white")
        for bar, value in zip(bars, values):
            bar.set_facecolor(style.COLOURS["sky" if value >= 0 else "orange"])
        angle, fit = fine_fit(series, name, unit)
        panel.plot(angle, abs(fit), color=style.COLOURS["vermilion"], linewidth=1.3)
        panel.set_axisbelow(False)
        panel.yaxis.set_major_locator(style.plt.MaxNLocator(3))
        panel.set_rlabel_position(22.5)
        if signed:
            panel.annotate("blue: anticlockwise, orange: clockwise", xy=(0.5, -0.2), xycoords="axes fraction", ha="center", fontsize=6.5)
    style.save(figure, options.output)


def lambert(cos_polar, azimuth):
    """Upper half of the sphere on a disc of radius 1, areas kept."""
    radius = math.sqrt(1 - cos_polar)
    return radius * math.cos(azimuth), radius * math.sin(azimuth)


def outline(low, high, first, last):
    """A cell's outline, its curved sides in steps."""
    steps = 12
    angles = [first + (last - first) * k / steps for k in range(steps + 1)]
    return [lambert(high, a) for a in angles] + [lambert(low, a) for a in reversed(angles)]


def draw_sphere(path, output):
    import suffuse_style as style
    from matplotlib.collections import PolyCollection

    series = TimeSeries(path)
    series.require("cos_polar_low", "cos_polar_high", "azimuth_low_rad", "azimuth_high_rad", "contact_density_per_sr", "normal_force_density_per_sr")
    cells = [k for k, high in enumerate(series["cos_polar_high"]) if high > 1e-9]
    shapes = [outline(max(0.0, series["cos_polar_low"][k]), series["cos_polar_high"][k], series["azimuth_low_rad"][k], series["azimuth_high_rad"][k])
              for k in cells]
    figure, axes = style.plt.subplots(1, 2, figsize=(7.2, 3.6))
    for panel, name, title in zip(axes, ("contact_density_per_sr", "normal_force_density_per_sr"), ("contacts", "normal forces")):
        relative = [4 * math.pi * series[name][k] for k in cells]
        spread = max(0.05, max(abs(v - 1) for v in relative))
        patches = PolyCollection(shapes, array=relative, cmap="cividis", edgecolor="face", linewidth=0.2)
        patches.set_clim(max(0.0, 1 - spread), 1 + spread)
        panel.add_collection(patches)
        panel.set_xlim(-1.15, 1.15)
        panel.set_ylim(-1.15, 1.15)
        panel.set_aspect("equal")
        panel.axis("off")
        panel.set_title(f"{title}: density over even, 4πE (−)")
        for text, x, y in (("x", 1.08, 0), ("y", 0, 1.08), ("z", 0, 0)):
            panel.text(x, y, text, ha="center", va="center", fontsize=8, color="white" if text == "z" else "black")
        figure.colorbar(patches, ax=panel, shrink=0.75)
    style.save(figure, output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rose", nargs="?", help="CSV file of suffuse-analyse rose --output")
    parser.add_argument("--sphere", help="CSV file of suffuse-analyse rose --sphere")
    parser.add_argument("--plane", default="xz", choices=("xy", "xz", "yz"), help="names of the axes")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--panels", type=int, choices=(1, 2, 3), default=3, help="how many of contacts, normal and tangential forces")
    parser.add_argument("--width", type=float, help="of the rose's figure, inches; its panels then stand one above the other")
    options = parser.parse_args()
    if bool(options.rose) == bool(options.sphere):
        parser.error("give either the CSV file of a rose, or --sphere and that of a spherical histogram")
    if options.sphere:
        draw_sphere(options.sphere, options.output)
    else:
        draw_rose(options.rose, options.plane, options)


if __name__ == "__main__":
    main()
