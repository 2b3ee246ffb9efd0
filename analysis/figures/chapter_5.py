#!/usr/bin/env python3
"""Figures 5.3 to 5.12 of the thesis from a campaign: what shear at constant mean stress does to samples of more and more fines.

  chapter_5.py CAMPAIGN --output FOLDER

CAMPAIGN is the directory of a campaign (input_scripts/campaigns) with results.csv and samples/. Samples are named as in Table
5.1, A(20%), or by their case; those of one letter share panels. Dashed: values that the thesis prints. Dilation is drawn
upwards, as the thesis does; in the files compression is positive. Figure 5.12 needs samples/CASE/shear/rose_first.csv and
rose_last.csv (suffuse-analyse rose) and is left out without them.
"""
import argparse
import csv
import pathlib
import re
import sys

from time_series import TimeSeries

Q_PEAK_KPA = {"A": 237, "B": 254}  # section 5.3.4: the highest q_peak of each gap ratio
GROUPS = {"A": "A, gap ratio 2", "B": "B, gap ratio 3"}


class Sample:
    def __init__(self, folder, quantities, thesis):
        text = (folder / "sample.toml").read_text()
        name = re.search(r'table_5_1 = "([AB]\(\d+%\))"', text)
        self.case, self.name = folder.name, name.group(1) if name else folder.name
        self.group = self.name[0] if name else ""
        self.quantities, self.thesis = quantities, thesis
        self.roses = [folder / "shear" / f"rose_{state}.csv" for state in ("first", "last")]
        self.series = TimeSeries(folder / "shear" / "shear.csv")
        self.strain = [100 * strain for strain in self.series["axial_strain"]]

    @property
    def fines(self):
        return 100 * self.quantities["fines_solid_share"]


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def samples_of(campaign):
    quantities, thesis = {}, {}
    with open(campaign / "results.csv", newline="") as file:
        for row in csv.DictReader(file):
            quantities.setdefault(row["case"], {})[row["quantity"]] = number(row["measured"])
            if row["source"] == "table-5-1":
                name = "initial_void_ratio" if row["quantity"] == "void_ratio" else row["quantity"]
                thesis.setdefault(row["case"], {})[name] = number(row["thesis"])
    folders = sorted(path.parents[1] for path in campaign.glob("samples/*/shear/shear.csv") if (path.parents[1] / "sample.toml").is_file())
    found = [Sample(folder, quantities.get(folder.name, {}), thesis.get(folder.name, {})) for folder in folders]
    if not found:
        sys.exit(f"chapter_5: {campaign}: no sample has been sheared")
    names = [sample.name for sample in found]
    for sample in found:
        if names.count(sample.name) > 1:  # several samples of one soil
            sample.name = sample.case
        if "fines_solid_share" not in sample.quantities:
            sys.exit(f"chapter_5: {campaign}/results.csv: nothing of {sample.name} at rest; make it again, it is older than the sample")
    return sorted(found, key=lambda sample: (sample.group, sample.fines, sample.name))


def groups_of(samples):
    groups = {}
    for sample in samples:
        groups.setdefault(sample.group, []).append(sample)
    return groups


def curves(samples, path, x, y, labels, mark=None):
    """A panel a group, a curve a sample."""
    import suffuse_style as style
    from matplotlib import pyplot

    groups = groups_of(samples)
    figure, panels = pyplot.subplots(1, len(groups), sharey=True, squeeze=False, figsize=(style.COLUMN_WIDTH, 3.0))
    colours = pyplot.get_cmap("viridis")
    for panel, (group, members) in zip(panels[0], groups.items()):
        for k, sample in enumerate(members):
            colour = colours(k / max(1, len(members) - 1) * 0.9)
            panel.plot(x(sample), y(sample), color=colour, linewidth=1.0, label=style.plain(sample.name))
            if mark:
                panel.plot(x(sample)[0], y(sample)[0], "o", color=colour, markersize=4)
                panel.plot(x(sample)[-1], y(sample)[-1], "s", color=colour, markersize=4)
        panel.set(xlabel=labels[0], title=GROUPS.get(group, group))
        if mark:
            mark(panel)
        panel.legend(fontsize=6)
    panels[0][0].set_ylabel(labels[1])
    style.save(figure, path)


def against_fines(samples, path, panels_of, limits=()):
    """Panels of (quantity's name in the results, label, factor): a line a group, dashed what the thesis prints."""
    import suffuse_style as style
    from matplotlib import pyplot

    figure, panels = pyplot.subplots(1, len(panels_of), squeeze=False, figsize=(style.COLUMN_WIDTH, 2.8))
    for panel, (name, label, factor) in zip(panels[0], panels_of):
        for (group, members), colour in zip(groups_of(samples).items(), style.COLOURS.values()):
            for values, look in (("quantities", {"marker": "o"}), ("thesis", {"marker": "o", "fillstyle": "none", "linestyle": "--"})):
                points = [(s.fines, factor * getattr(s, values)[name]) for s in members if getattr(s, values).get(name) is not None]
                if points:
                    panel.plot(*zip(*points), color=colour, markersize=4, linewidth=1.0, **look,
                               label=GROUPS.get(group, group) + (", thesis" if values == "thesis" else ""))
        panel.set(xlabel="fines (% of the solids)", ylabel=label)
        panel.ticklabel_format(useOffset=False)
        panel.legend(fontsize=6)
        for which, value in limits:
            if which == name:
                style.reference_line(panel, value, "thesis")
    style.save(figure, path)


def roses(samples, path):
    """A row a sample: the density of the contacts' directions in the plane of x and z, at rest and at the end."""
    import suffuse_style as style
    from matplotlib import pyplot

    have = [sample for sample in samples if all(rose.is_file() for rose in sample.roses)]
    if not have:
        return
    figure, panels = pyplot.subplots(len(have), 2, figsize=(4.2, 2.1 * len(have)), subplot_kw={"projection": "polar"}, squeeze=False)
    for row, sample in zip(panels, have):
        for panel, rose, state in zip(row, sample.roses, ("at rest", "at the end")):
            bins = TimeSeries(rose)
            low, high = bins["angle_low_rad"], bins["angle_high_rad"]
            panel.bar(low, bins["contact_density_per_rad"], width=[b - a for a, b in zip(low, high)], align="edge", color=style.COLOURS["sky"],
                      edgecolor="white", linewidth=0.3)
            panel.set_title(f"{style.plain(sample.name)} {state}", fontsize=8)
            panel.set_xticks([0, 1.5708, 3.14159, 4.71239])
            panel.set_xticklabels(["x", "z", "", ""])
            panel.yaxis.set_major_locator(pyplot.MaxNLocator(2))
            panel.tick_params(labelsize=6)
    style.save(figure, path)


def draw(samples, folder):
    strain, with_strain = (lambda s: s.strain), "axial strain (%)"
    column = lambda name, factor=1: (lambda s: [factor * value for value in s.series[name]])  # noqa: E731
    q, alpha = column("deviatoric_stress_pa", 1e-3), column("alpha_pair_halves")
    ratio = lambda s: [q / p for q, p in zip(s.series["deviatoric_stress_pa"], s.series["mean_stress_pa"])]  # noqa: E731

    def cases(panel):
        panel.axhline(0.5, color="#606060", linewidth=0.6, linestyle=":")
        panel.axvline(1.0, color="#606060", linewidth=0.6, linestyle=":")
        for text, x, y in (("I", -5, -5), ("IV", -5, 5), ("II", 5, -5), ("III", 5, 5)):  # about their corner, clear of the legend
            panel.annotate(text, (1.0, 0.5), (x, y), textcoords="offset points", fontsize=8, color="#606060",
                           ha="left" if x > 0 else "right", va="bottom" if y > 0 else "top")

    against_fines(samples, folder / "figure_5_3.png", [("unconnected_fines_share", "unconnected fines (%)", 100)])
    curves(samples, folder / "figure_5_4.png", strain, q, (with_strain, "deviatoric stress q (kPa)"))
    curves(samples, folder / "figure_5_5.png", strain, column("volumetric_strain", -100), (with_strain, "volumetric strain (%, dilation +)"))
    against_fines(samples, folder / "figure_5_6.png", [("initial_void_ratio", "void ratio e0", 1), ("peak_deviatoric_stress_pa", "q_peak (kPa)", 1e-3)],
                  [("peak_deviatoric_stress_pa", Q_PEAK_KPA[group]) for group in groups_of(samples) if group in Q_PEAK_KPA])
    curves(samples, folder / "figure_5_7.png", strain, column("coordination_number"), (with_strain, "coordination number Z"))
    against_fines(samples, folder / "figure_5_7c.png", [("coordination_drop", "decrease of Z (%)", 100)], [("coordination_drop", 80)])
    curves(samples, folder / "figure_5_8a.png", strain, alpha, (with_strain, "alpha"))
    curves(samples, folder / "figure_5_8b.png", ratio, alpha, ("stress ratio q/p'", "alpha"))
    curves(samples, folder / "figure_5_9.png", column("coordination_fine_coarse"), alpha, ("Z of the fines (eq 5.8)", "alpha"), cases)
    curves(samples, folder / "figure_5_10.png", q, column("coordination_coarse_coarse"), ("deviatoric stress q (kPa)", "Z coarse-coarse"))
    curves(samples, folder / "figure_5_11.png", strain, column("sliding_share", 100), (with_strain, "sliding contacts (%)"))
    roses(samples, folder / "figure_5_12.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaign", type=pathlib.Path, help="directory of a campaign")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder of the figures")
    options = parser.parse_args()
    draw(samples_of(options.campaign), options.output)


if __name__ == "__main__":
    main()
