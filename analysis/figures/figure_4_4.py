#!/usr/bin/env python3
"""Figures 4.4, 4.5 and 4.6 of the thesis: coordination number and alpha of samples against the constriction ratio
Dc35/d85, or with --against against Kezdi's or Kenney and Lau's ratio.

  figure_4_4.py RESULTS.csv --output FIGURE.pdf [--against kezdi_ratio|kenney_lau_ratio]

From the results of a campaign (input_scripts/campaigns). Filled: measured; open: printed in Table 4.1; lines: the thesis's
fits, eqs 4.7 and 4.8, and its limits.
"""
import argparse
import csv
import math

FITS = {"coordination_number": lambda x: 5 / (1 + math.exp(10 * x - 6.2)),
        "alpha_pair_halves": lambda x: 0.16 + 1.2 / (1 + math.exp(14 * x - 9.5))}
LIMITS = {"coordination_number": 1.0, "alpha_pair_halves": 0.5}
AGAINST = {"constriction_ratio": ("constriction ratio Dc35/d85", 0.73), "kezdi_ratio": ("Kezdi's ratio (D15/d85)max", 4.0),
           "kenney_lau_ratio": ("Kenney and Lau's ratio (H/F)min", 1.0)}  # and from where soils are unstable
TITLES = {"coordination_number": "coordination number Z", "alpha_pair_halves": "alpha"}


def points_of(path):
    """By sample: quantity to (measured, thesis); of Table 4.1."""
    samples = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row["source"] == "table-4-1":
                # Table 4.1's alpha of soils with 25 % of fines or more is that of the finest.
                name = "alpha_pair_halves" if row["quantity"] == "alpha_finest_fraction" else row["quantity"]
                samples.setdefault(row["case"], {})[name] = tuple(float(row[which]) if row[which] else None for which in ("measured", "thesis"))
    return samples


def draw(samples, options):
    import suffuse_style as style
    from matplotlib import pyplot

    title, limit = AGAINST[options.against]
    figure, panels = pyplot.subplots(2, 1, sharex=True, figsize=(style.width_of(options), 5.2))
    ratios = [k / 100 for k in range(10, 180)]
    for panel, (quantity, fit) in zip(panels, FITS.items()):
        if options.against == "constriction_ratio":
            panel.plot(ratios, [fit(ratio) for ratio in ratios], **style.REFERENCE)
        panel.axhline(LIMITS[quantity], color=style.REFERENCE["color"], linewidth=0.6, linestyle=":")
        panel.axvline(limit, color=style.REFERENCE["color"], linewidth=0.6, linestyle=":")
        for which, (label, face) in enumerate((("measured", "C0"), ("Table 4.1", "none"))):
            pairs = [(values[options.against][which], values[quantity][which]) for values in samples.values()
                     if options.against in values and quantity in values]
            pairs = [pair for pair in pairs if None not in pair]
            panel.scatter([x for x, _ in pairs], [y for _, y in pairs], facecolors=face, edgecolors="C0", s=18, label=label)
        panel.set(ylabel=TITLES[quantity])
    panels[0].legend()
    panels[1].set(xlabel=title)
    panels[1].set_xlim(left=0)
    style.save(figure, options.output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", help="results.csv of a campaign")
    parser.add_argument("--output", required=True, help="figure to write; its ending says the format")
    parser.add_argument("--against", choices=AGAINST, default="constriction_ratio", help="Figure 4.4, 4.5 or 4.6")
    parser.add_argument("--width", type=float, help="inches")
    options = parser.parse_args()
    draw(points_of(options.results), options)


if __name__ == "__main__":
    main()
