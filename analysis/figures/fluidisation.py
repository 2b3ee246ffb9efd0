#!/usr/bin/env python3
"""Upward flow through a bed: gradient and velocity, stresses of the layers, height of the bed; and a slice of grains and flow.

From the monitor file of a run, and what `suffuse-analyse fluidisation FLOW.csv --grading PSD.csv --csv RESULTS.csv` found in it:

  fluidisation.py FLOW.csv --results RESULTS.csv --output fluidisation.png fluidisation.pdf [--follow]
  fluidisation.py --fields bed.h5 --output slice.png slice.pdf [--time SECONDS] [--position METRES]
  fluidisation.py --measures MEASURES.csv --distributions SHARES.csv --output contacts.png

The last draws what `suffuse-analyse fluidisation --dumps ... --measures ... --distributions ...` wrote: contacts of the layers
against the gradient, and distributions of contacts, of S_i and of normal forces at the first and the last snapshot (--step for another one).
Several files after --output: the same figure in several formats. The slice is vertical, through the middle of y unless --position
says where; grains are those of bed_grains.h5 beside the fields, cut by it. Pressure is that above the hydrostatic one.
"""
import argparse
import csv
import pathlib
import sys

import follow
from time_series import TimeSeries, numbered


def results_of(path):
    """Quantity to value, of the rows of the whole bed."""
    if path is None:
        return {}
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {row["quantity"]: float(row["value"]) for row in rows if row["layer"] == "" and row["value"]}
    except (OSError, KeyError, ValueError) as problem:
        sys.exit(f"{path}: is no file of `suffuse-analyse fluidisation --csv` ({problem})")


def mark_critical(panel, results):
    import suffuse_style as style

    marks = (("critical gradient, Terzaghi", "Terzaghi", style.REFERENCE),
             ("critical gradient, stress vanishes", "stress vanishes", {"color": style.COLOURS["green"], "linestyle": "-.", "linewidth": 1.1}),
             ("critical gradient, bed begins to move", "bed begins to move", {"color": style.COLOURS["vermilion"], "linestyle": ":", "linewidth": 1.5}))
    for quantity, label, look in marks:
        if quantity in results:
            panel.axvline(results[quantity], label=f"{label}, i = {results[quantity]:.3f}", **look)


def draw_velocity(panel, gradient, velocity, results):
    import suffuse_style as style

    panel.plot(gradient, [1e3 * v for v in velocity], color=style.COLOURS["blue"], label="measured")
    end = max(gradient)
    lines = (("conductivity, measured", "k = {:.3g} mm/s", {"color": style.COLOURS["blue"], "linestyle": ":"}),
             ("conductivity, Carman and Kozeny (180)", "Carman and Kozeny", {"color": style.COLOURS["orange"], "linestyle": "--"}),
             ("conductivity, Ergun's viscous term (150)", "Ergun", {"color": style.COLOURS["purple"], "linestyle": "-."}))
    for quantity, label, look in lines:
        if quantity in results:
            panel.plot([0, end], [0, 1e3 * results[quantity] * end], label=label.format(1e3 * results[quantity]), linewidth=1.1, **look)
    mark_critical(panel, results)
    top = 1.05e3 * max(velocity)
    if "conductivity, measured" in results:  # of the bed that has gone only the beginning, so that the bed at rest is seen
        top = min(top, 1.8e3 * results["conductivity, measured"] * end)
    panel.set(ylabel="superficial\nvelocity (mm/s)", ylim=(0, top))
    panel.legend(fontsize=7, loc="upper left")


def draw_record(series, results, output, width):
    import suffuse_style as style

    layers = numbered(series, "hydraulic_gradient_layer_")
    axis = next((a for a in "xyz" if f"centre_of_grains_{a}_m" in series), "z")
    velocity = f"superficial_velocity_{axis}_m_per_s"
    series.require("hydraulic_gradient_layer_1", velocity)
    ratios = [[s / column[0] for s in column] if column[0] != 0 else None for column in numbered(series, "vertical_stress_pa_")]
    if not any(ratios):
        ratios = numbered(series, "effective_stress_ratio_")
    stresses = {number: ratio for number, ratio in enumerate(ratios, start=1) if ratio is not None}  # none of a layer without stress at first
    gradient = [sum(values) / len(layers) for values in zip(*layers)]
    # After the bed has begun to move its own gradient hardly rises: driving gradient where there is one.
    driving = series["applied_gradient"] if "applied_gradient" in series else gradient
    rises = [name for name in (f"centre_of_grains_{axis}_m", "bed_height_m") if name in series]
    figure, axes = style.stacked_panels(1 + bool(stresses) + bool(rises), panel_height=2.1, width=width or style.COLUMN_WIDTH)
    draw_velocity(axes[0], gradient, series[velocity], results)
    remaining = list(axes[1:])
    if stresses:
        panel = remaining.pop(0)
        for (number, ratio), colour in zip(stresses.items(), style.shades(len(stresses))):
            panel.plot(layers[number - 1] if len(layers) == len(ratios) else gradient, ratio, color=colour, label=f"layer {number}" + (" (top)" if number == 1 else ""))
        mark_critical(panel, {key: value for key, value in results.items() if "Terzaghi" in key})
        panel.set(ylabel="vertical effective stress\nσ′/σ′₀ (−)", ylim=(min(0, *(min(r) for r in stresses.values())), max(1.1, *(r[0] for r in stresses.values()))))
        panel.legend(fontsize=7, ncol=2)
    if rises:
        panel = remaining.pop(0)
        for name, look in zip(rises, ("-", ":")):
            label = "bed's height" if name == "bed_height_m" else "grains' centre"
            panel.plot(driving, [1e6 * (value - series[name][0]) for value in series[name]], linestyle=look, color=style.COLOURS["blue"], label=label)
        mark_critical(panel, results)
        panel.set_ylabel("rise (µm)")
        panel.legend(fontsize=7, loc="upper left")
        panel.set_xlabel("hydraulic gradient i (−):\nover the bed, each layer's own, driving (rise)" if driving is not gradient else "hydraulic gradient i (−)")
    else:
        axes[-1].set_xlabel("hydraulic gradient i (−)")
    figure.align_ylabels(axes)
    for path in output:
        style.save(figure, path)


def rows_of(path, *needed):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            table = list(csv.DictReader(file))
    except OSError as problem:
        sys.exit(f"{path}: {problem.strerror}")
    if not table or any(name not in table[0] for name in needed):
        sys.exit(f"{path}: is no such file of `suffuse-analyse fluidisation`; it needs {', '.join(needed)}")
    return table


MEASURES = (("constraint_ratio", "constraint ratio R (−)"), ("coordination_number", "coordination number Z (−)"), ("stable_share", "M_s (−)"),
            ("broken_contacts_net", "contacts lost, net (−)"), ("broken_contacts_gross", "contacts lost, gross (−)"), ("sliding_share", "sliding contacts S_c (−)"),
            ("strong_share", "strong contacts (−)"), ("strong_stress_share", "stress on strong ones (−)"), ("coordination_d85", "Z of d ≥ d85 (−)"),
            ("effective_stress_ratio", "σ′/σ′₀ (−)"))


def draw_measures(figure, rows):
    """Small panels against the layer's gradient, a line a layer."""
    import suffuse_style as style

    names = sorted({row["layer"] for row in rows if row["layer"] != "all"}, key=int)
    axes = figure.subplots(len(MEASURES) // 2, 2, sharex=True).ravel()
    for panel, (column, label) in zip(axes, MEASURES):
        for name, colour in zip(names, style.shades(len(names))):
            points = [(float(row["layer_gradient"]), float(row[column])) for row in rows if row["layer"] == name and row[column]]
            panel.plot(*zip(*points), color=colour, marker=".", markersize=3, linewidth=1, label=f"layer {name}") if points else None
        if column == "constraint_ratio":
            panel.axhline(1, **style.REFERENCE)
        panel.set_ylabel(label, fontsize=8)
    axes[0].legend(fontsize=6)
    for panel in axes[-2:]:
        panel.set_xlabel("layer's gradient i (−)")


def draw_plot_of_three(panel, rows):
    """R against i and σ′/σ′₀, as in thesis Fig. 6.12(a)."""
    import suffuse_style as style
    from matplotlib import ticker

    names = sorted({row["layer"] for row in rows if row["layer"] != "all"}, key=int)
    for name, colour in zip(names, style.shades(len(names))):
        points = [tuple(float(row[c]) for c in ("layer_gradient", "effective_stress_ratio", "constraint_ratio"))
                  for row in rows if row["layer"] == name and row["effective_stress_ratio"]]
        if points:
            panel.plot(*zip(*points), color=colour, marker=".", markersize=3, linewidth=1)
    panel.set_xlabel("i (−)")
    panel.set_ylabel("σ′/σ′₀ (−)")
    panel.set_zlabel("R (−)")
    panel.tick_params(labelsize=7)
    panel.set_box_aspect(None, zoom=0.72)  # room for the names of the axes
    for axis in (panel.xaxis, panel.yaxis, panel.zaxis):
        axis.set_major_locator(ticker.MaxNLocator(4))


def names_of(rows):
    """Of the top layer and the lowest."""
    names = sorted({row["layer"] for row in rows if row["layer"] != "all"}, key=int)
    return names[:1] + names[1:][-1:]


def draw_forces(panel, rows, names, look):
    """Probability density of normal forces, as in thesis Fig. 6.4."""
    import suffuse_style as style

    for name, colour in zip(names, ("orange", "blue")):
        own = [row for row in rows if row["layer"] == name and row["distribution"] == "normal_force_over_mean_at_rest" and row["high"]]
        points = [((float(row["low"]) + float(row["high"])) / 2, float(row["share"]) / (float(row["high"]) - float(row["low"]))) for row in own if float(row["share"]) > 0]
        if points:
            panel.plot(*zip(*points), linestyle=look, color=style.COLOURS[colour], marker=".", markersize=3, label=f"layer {name}, i = {float(own[0]['bed_gradient']):.2f}")


def draw_distributions(panels, rows, step):
    """The first snapshot and another one: contacts of grains by size and S_i of the whole bed, normal forces of its top and lowest layer."""
    import suffuse_style as style

    steps = sorted({float(row["step"]) for row in rows})
    later = steps[-1] if step is None else min(steps, key=lambda s: abs(s - step))
    classes = (("contacts_of_all_grains", "all grains", "blue"), ("contacts_of_d50_and_larger", "d ≥ d50", "orange"), ("contacts_of_d85_and_larger", "d ≥ d85", "green"))
    for at, look in ((steps[0], "-"), (later, ":"))[: 1 if later == steps[0] else 2]:
        own = [row for row in rows if float(row["step"]) == at and row["layer"] == "all"]
        gradient = float(own[0]["bed_gradient"])
        for name, label, colour in classes:
            points = [(float(row["low"]), float(row["share"])) for row in own if row["distribution"] == name]
            panels[0].plot(*zip(*points), linestyle=look, color=style.COLOURS[colour], label=f"{label}, i = {gradient:.2f}")
        points = [(float(row["low"]), float(row["share"])) for row in own if row["distribution"] == "slipping_index"]
        points.append((points[-1][0] + 0.1, points[-1][1]))  # the sliding ones, drawn as wide as the other bins
        panels[1].step(*zip(*points), where="post", linestyle=look, color=style.COLOURS["blue"], label=f"i = {gradient:.2f}")
        draw_forces(panels[2], [row for row in rows if float(row["step"]) == at], names_of(rows), look)
    panels[2].set(xlabel="normal force over the layer's mean at rest f_N/f_0 (−)", ylabel="probability density (−)", yscale="log")
    panels[0].set(xlabel="contacts of a grain Z (−; 12: and more)", ylabel="share of grains (−)")
    panels[1].set(xlabel="slipping index S_i (−; beyond 1: sliding)", ylabel="share of contacts (−)", yscale="log")
    for panel in panels:
        panel.legend(fontsize=6)


def draw_contacts(measures, distributions, step, output):
    import suffuse_style as style
    from matplotlib import pyplot

    figure = pyplot.figure(figsize=(2 * style.COLUMN_WIDTH, 9))
    left, right = figure.subfigures(1, 2)
    draw_measures(left, rows_of(measures, "layer", "layer_gradient", "effective_stress_ratio", "constraint_ratio"))
    draw_plot_of_three(right.add_subplot(5, 1, (1, 2), projection="3d"), rows_of(measures, "layer"))
    if distributions:
        panels = [right.add_subplot(5, 1, row) for row in (3, 4, 5)]
        draw_distributions(panels, rows_of(distributions, "step", "layer", "distribution", "low", "share"), step)
    for path in output:
        figure.savefig(path)


def snapshot_of(file, time):
    """The group of a snapshot: the last, or that closest to a time."""
    groups = [file[name] for name in file if name.startswith("step_")]
    if not groups:
        sys.exit(f"{file.filename}: has no snapshots; is it a file of `lbm output`?")
    groups.sort(key=lambda group: float(group.attrs["time_s"]))
    return groups[-1] if time is None else min(groups, key=lambda group: abs(float(group.attrs["time_s"]) - time))


def open_file(path):
    try:
        import h5py
    except ImportError:
        sys.exit(f"fluidisation.py: this Python ({sys.executable}) has no h5py; install it (apt-get install python3-h5py)")
    try:
        return h5py.File(path, "r")
    except OSError as problem:
        sys.exit(f"{path}: {problem}; give FILE.h5 of `lbm output`")


def mesh_of(fields, name):
    """Origin and spacing (x, y, z), m, from the .xdmf beside the fields."""
    import xml.etree.ElementTree as xml

    description = pathlib.Path(fields).with_suffix(".xdmf")
    try:
        for grid in xml.parse(description).iter("Grid"):
            if grid.get("Name") == name:
                items = grid.find("Geometry").findall("DataItem")
                return [[float(word) for word in reversed(item.text.split())] for item in items]
    except (OSError, xml.ParseError, AttributeError) as problem:
        sys.exit(f"{description}: {problem}; it is written beside the fields and must stay there")
    sys.exit(f"{description}: has no {name}; is it of the same run?")


def cut_grains(path, time, at, width):
    """Circles (x, z, radius) where the plane y = `at` cuts the grains, images across periodic sides too."""
    path = pathlib.Path(path)
    beside = path.with_name(path.stem + "_grains.h5")
    if not beside.exists():
        return []
    with open_file(beside) as file:
        grains = snapshot_of(file, time)["grains"]
        position, radius = grains["position"][()], grains["radius"][()]
    circles = []
    for (x, y, z), r in zip(position, radius):
        for shift_y in (0, -width[1], width[1]):
            height = y + shift_y - at
            if abs(height) < r:
                circles += [(x + shift, z, (r * r - height * height) ** 0.5) for shift in (0, -width[0], width[0])]
    return circles


def draw_slice(fields, time, position, output):
    import suffuse_style as style
    from matplotlib import collections, patches, pyplot

    with open_file(fields) as file:
        snapshot = snapshot_of(file, time)
        missing = [name for name in ("velocity", "pressure") if name not in snapshot]
        if missing:
            sys.exit(f"{fields}: has no {', '.join(missing)}; add it to `lbm output`")
        now = float(snapshot.attrs["time_s"])
        origin, spacing = mesh_of(fields, snapshot.name.strip("/"))
        cells = snapshot["pressure"].shape  # z, y, x
        width = [cells[2] * spacing[0], cells[1] * spacing[1]]
        at = origin[1] + width[1] / 2 if position is None else position
        row = int((at - origin[1]) / spacing[1])
        if not 0 <= row < cells[1]:
            sys.exit(f"--position {position}: must be between {origin[1]:g} and {origin[1] + width[1]:g} m")
        speed = (snapshot["velocity"][:, row, :, :].astype(float) ** 2).sum(axis=2) ** 0.5
        pressure = snapshot["pressure"][:, row, :].astype(float)
    circles = cut_grains(fields, now, at, width)
    top = origin[2] + cells[0] * spacing[2]
    if circles:  # the water above the bed is of little interest
        top = min(top, 1.25 * max(z + r for _, z, r in circles))
    box = [1e3 * origin[0], 1e3 * (origin[0] + width[0]), 1e3 * origin[2], 1e3 * (origin[2] + cells[0] * spacing[2])]
    figure, axes = pyplot.subplots(1, 2, sharey=True, figsize=(style.COLUMN_WIDTH + 0.6, 0.8 + 1.75 * (top - origin[2]) / width[0]))
    for panel, values, label, colours in ((axes[0], 1e3 * speed, "speed of the water (mm/s)", "viridis"), (axes[1], pressure, "pressure in excess of\nthe hydrostatic (Pa)", "cividis")):
        picture = panel.imshow(values, origin="lower", extent=box, cmap=colours, interpolation="nearest")
        look = {"facecolor": "#f2f2f2", "edgecolor": "#202020", "linewidth": 0.5}
        panel.add_collection(collections.PatchCollection([patches.Circle((1e3 * x, 1e3 * z), 1e3 * r) for x, z, r in circles], **look))
        panel.set(xlim=box[:2], ylim=(box[2], 1e3 * top), xlabel="x (mm)", aspect="equal")
        panel.grid(False)
        figure.colorbar(picture, ax=panel, label=label, shrink=0.8)
    axes[0].set_ylabel("z (mm)")
    figure.suptitle(f"y = {1e3 * at:.3g} mm, {now:.3g} s", fontsize=9)
    for path in output:
        figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", nargs="?", help="monitor file of the run, CSV")
    parser.add_argument("--results", help="CSV file of `suffuse-analyse fluidisation`: formulas and critical gradients")
    parser.add_argument("--fields", help="FILE.h5 of `lbm output`: draws a slice of grains and flow instead")
    parser.add_argument("--measures", help="draws contacts of the layers instead: file of `fluidisation --measures`")
    parser.add_argument("--distributions", help="with --measures: file of `fluidisation --distributions`")
    parser.add_argument("--step", type=float, help="of the second distribution; the last if not given")
    parser.add_argument("--time", type=float, help="of the slice, s: the nearest snapshot; the last if not given")
    parser.add_argument("--position", type=float, help="of the slice, y in m")
    parser.add_argument("--width", type=float, help="of the record's figure, inches")
    parser.add_argument("--output", required=True, nargs="+", help="files to write; their endings say the format")
    follow.add_option(parser)
    options = parser.parse_args()
    if sum(given is not None for given in (options.series, options.fields, options.measures)) != 1:
        parser.error("give one of: the monitor file, --fields FILE.h5, --measures FILE.csv")
    if options.follow is not None and options.series is None:
        parser.error("--follow draws the monitor file, not --fields or --measures")
    if options.measures:
        draw_contacts(options.measures, options.distributions, options.step, options.output)
    elif options.fields:
        draw_slice(options.fields, options.time, options.position, options.output)
    else:
        follow.draw_once_or_follow(options, [options.series], lambda: draw_record(
            TimeSeries(options.series, growing=options.follow is not None), results_of(options.results), options.output, options.width))


if __name__ == "__main__":
    main()
