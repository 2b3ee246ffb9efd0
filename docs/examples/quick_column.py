# Figures of the quick column from its files, in cells (`# %%`) for Spyder, VS Code or Jupyter; plain Python runs it too:
#
#   ./quickstart && /usr/bin/python3 docs/examples/quick_column.py runs/quickstart runs/quickstart
#
# First the folder of the run, then the folder for the figures. Needs python3-pandas besides what ./quickstart installs
# (scripts/install_packages python).

# %% Where things are
import pathlib
import sys

import matplotlib

matplotlib.use("Agg") if __name__ == "__main__" and not hasattr(sys, "ps1") else None
import matplotlib.pyplot as plt

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "analysis/python"))
import suffuse_data as data

run = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "runs/quickstart")
figures = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else run)

# %% The monitor as a table
flow = data.read_monitor(run / "flow.csv")
layers = sorted((name for name in flow if name.startswith("hydraulic_gradient_layer_")), key=lambda name: int(name.rsplit("_", 1)[1]))
flow["gradient"] = flow[layers].mean(axis=1)
print(flow[["time_s", "gradient", "superficial_velocity_z_m_per_s", "bed_height_m"]].describe().loc[["min", "max"]])

# %% What suffuse-analyse found
results = data.read_monitor(run / "results.csv")
whole_bed = results[results["layer"].isna()].set_index("quantity")["value"].astype(float)
terzaghi, conductivity = whole_bed["critical gradient, Terzaghi"], whole_bed["conductivity, measured"]

# %% Velocity, stresses and rise against the gradient
figure, (velocity, stress, rise) = plt.subplots(3, 1, sharex=True, figsize=(5.2, 6.7), constrained_layout=True)
velocity.plot(flow["gradient"], 1e3 * flow["superficial_velocity_z_m_per_s"], label="measured")
velocity.plot([0, flow["gradient"].max()], [0, 1e3 * conductivity * flow["gradient"].max()], ":", label=f"k = {1e3 * conductivity:.3g} mm/s")
velocity.set(ylabel="superficial\nvelocity (mm/s)", ylim=(0, 1.8e3 * conductivity * flow["gradient"].max()))
for number, layer in enumerate(layers, start=1):
    ratio = flow[f"vertical_stress_pa_{number}"] / flow[f"vertical_stress_pa_{number}"].iloc[0]
    stress.plot(flow[layer], ratio, label=f"layer {number}")
stress.set_ylabel("vertical effective stress\n$\\sigma'/\\sigma'_0$ (−)")
rise.plot(flow["applied_gradient"], 1e6 * (flow["bed_height_m"] - flow["bed_height_m"].iloc[0]))
rise.set(ylabel="rise of the bed (µm)", xlabel="hydraulic gradient i (−)")
for axes in (velocity, stress, rise):
    axes.axvline(terzaghi, color="0.4", linestyle="--", label=f"Terzaghi, i = {terzaghi:.3f}")
    axes.legend(fontsize=7, frameon=False)
figure.savefig(figures / "quick_column_record.png", dpi=150)

# %% A slice through grains and water
water = data.read_fields(run / "bed.h5")
grains = data.read_grains(run / "bed_grains.h5", time=water.time_s)
row = len(water.centres(1)) // 2
y = water.centres(1)[row]
speed = (water["velocity"][:, row] ** 2).sum(axis=2) ** 0.5
extent = [1e3 * v for axis in (0, 2) for v in (water.centres(axis)[0] - water.spacing / 2, water.centres(axis)[-1] + water.spacing / 2)]
figure, axes = plt.subplots(figsize=(3.6, 6), constrained_layout=True)
picture = axes.imshow(1e3 * speed, origin="lower", extent=extent)
figure.colorbar(picture, label="speed of the water (mm/s)")
cut = grains[(grains["position_y"] - y).abs() < grains["radius"]]
for x, z, r in zip(cut["position_x"], cut["position_z"], (cut["radius"] ** 2 - (cut["position_y"] - y) ** 2) ** 0.5):
    axes.add_patch(plt.Circle((1e3 * x, 1e3 * z), 1e3 * r, facecolor="0.95", edgecolor="0.1", linewidth=0.5))
axes.set(xlabel="x (mm)", ylabel="z (mm)", title=f"{water.time_s:.3g} s")
figure.savefig(figures / "quick_column_slice.png", dpi=150)
print(f"{len(grains)} grains, {grains['diameter'].min() * 1e3:.3g} to {grains['diameter'].max() * 1e3:.3g} mm; figures in {figures}")
