"""A made-up monitor file of an upward-flow run whose conductivity and critical gradients are known.

The bed: layers of given porosities, conductivities after Carman and Kozeny, so that the gradient of each follows from the one
velocity; stresses from the weight less the gradients above; a small elastic rise (Hertz's); it lifts where the mean gradient reaches the
mean of (G_s - 1)(1 - n), and its centre then rises with the cube of what the driving gradient is above that (as under a ramp).
"""
import math
import random

LAYERS, HEIGHT, DIAMETER = 4, 4e-3, 0.3476e-3
POROSITIES = (0.372, 0.356, 0.362, 0.378)  # from the top


def critical(porosity):
    return 1.65 * (1 - porosity)


def conductivity(porosity):
    return 9.81 / 1e-6 * DIAMETER**2 * porosity**3 / (180 * (1 - porosity) ** 2)


BED_CRITICAL = sum(map(critical, POROSITIES)) / LAYERS
BED_CONDUCTIVITY = LAYERS / sum(1 / conductivity(n) for n in POROSITIES)  # layers in a row


def ramp(samples=400, end=1.2):
    return [end * BED_CRITICAL * k / (samples - 1) for k in range(samples)]


def stages(shares=(0.2, 0.4, 0.6, 0.8, 0.9, 0.94, 0.97, 0.99, 1.01, 1.03, 1.06), rise=5, hold=20):
    """Driving gradients: short rises, long holds."""
    driving, before = [0.0], 0.0
    for share in shares:
        driving += [BED_CRITICAL * (before + (share - before) * (k + 1) / rise) for k in range(rise)]
        driving += [BED_CRITICAL * share] * hold
        before = share
    return driving


def rows(driving, noise=0.0, seed=1):
    """Dictionaries of columns, a row a sample."""
    dice = random.Random(seed)
    table, above = [], 0.0
    for k, applied in enumerate(driving):
        mean = min(applied, BED_CRITICAL)
        above += max(applied - BED_CRITICAL, 0)  # how long and how far above the critical gradient
        velocity = BED_CONDUCTIVITY * mean
        local = [velocity / conductivity(n) for n in POROSITIES]
        weight, stress = 9810 * HEIGHT / LAYERS, []
        for layer in range(LAYERS):
            carried = [(critical(n) - i) * weight for n, i in zip(POROSITIES[: layer + 1], local)]
            stress.append(sum(carried[:-1]) + carried[-1] / 2)
        risen = 1e-3 * (1 - (1 - mean / BED_CRITICAL) ** (2 / 3)) + 0.02 * above
        row = {"time_s": 1e-3 * k, "superficial_velocity_x_m_per_s": 0.0, "superficial_velocity_y_m_per_s": 0.0,
               "superficial_velocity_z_m_per_s": velocity, "hydraulic_gradient_z": applied * 0.45, "bed_height_m": HEIGHT * (1 + risen),
               "bed_porosity": sum(POROSITIES) / LAYERS, "centre_of_grains_z_m": HEIGHT * (0.5 + risen)}
        row |= {f"hydraulic_gradient_layer_{l + 1}": i for l, i in enumerate(local)}
        row |= {f"porosity_layer_{l + 1}": n for l, n in enumerate(POROSITIES)}
        row |= {"applied_gradient": applied} | {f"vertical_stress_pa_{l + 1}": s for l, s in enumerate(stress)}
        share = mean / BED_CRITICAL
        row |= {"coordination_number": 5.4 - 0.8 * share**4 - 20 * above, "sliding_share": min(1, 0.01 + 0.15 * share**3),
                "broken_contacts": 0.15 * share**4 + above, "constraint_ratio": 1.35 - 0.3 * share**3 - min(5 * above, 0.9)}
        for name in row:
            if name not in ("time_s", "applied_gradient", "bed_porosity") and not name.startswith("porosity"):
                scale = 1e-5 * HEIGHT / abs(row[name] or 1) if name.endswith("_m") else 1
                row[name] *= 1 + scale * noise * dice.gauss(0, 1) / (1e-2 if name.endswith("_m") else 1)
        table.append(row)
    return table


def text(table):
    lines = [",".join(table[0])]
    lines += [",".join(repr(float(value)) for value in row.values()) for row in table]
    return "\n".join(lines) + "\n"


def write(path, driving, noise=0.0, seed=1):
    path.write_text(text(rows(driving, noise, seed)), encoding="utf-8")


if not math.isclose(BED_CRITICAL, 1.65 * (1 - sum(POROSITIES) / LAYERS)):
    raise AssertionError("the mean of the layers' critical gradients is that of the mean porosity")
