"""Reads the series that unit_lbm_files wrote with VTK's own XDMF reader (run with pvpython): times, geometry, arrays,
and that every value sits in its cell. Usage: lbm_xdmf_reader_test.py FILE.xdmf"""
import sys

from paraview import servermanager, simple

CELLS = (9, 7, 8)
MASK = (1 << 64) - 1


def noise(cell, direction, seed):
    """The pure function of tests/support/lbm_test_tools.h."""
    h = seed * 0x9E3779B97F4A7C15 & MASK
    for v in (*cell, direction):
        h = h + (v + 1) * 0x9E3779B97F4A7C15 & MASK
        h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9 & MASK
        h = (h ^ h >> 27) * 0x94D049BB133111EB & MASK
        h ^= h >> 31
    return (h >> 11) * 2.0**-52 - 1


def main(path):
    reader = simple.XDMFReader(FileNames=[path])
    reader.UpdatePipeline()
    times = list(reader.TimestepValues)
    assert len(times) == 3 and all(abs(t - e) < 1e-9 for t, e in zip(times, (0.0, 0.02, 0.03))), times
    reader.UpdatePipeline(time=times[-1])
    grid = servermanager.Fetch(reader)
    bounds = grid.GetBounds()
    for axis in range(3):
        assert abs(bounds[2 * axis]) < 1e-12 and abs(bounds[2 * axis + 1] - CELLS[axis] * 1e-3) < 1e-9, bounds
    data = grid.GetCellData()
    assert grid.GetNumberOfCells() == CELLS[0] * CELLS[1] * CELLS[2]
    arrays = {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}
    assert set(arrays) == {"velocity", "pressure", "density", "solid_fraction"}, arrays.keys()
    assert arrays["velocity"].GetNumberOfComponents() == 3
    solids = moving = 0
    for n in range(grid.GetNumberOfCells()):
        cell = (n % CELLS[0], n // CELLS[0] % CELLS[1], n // (CELLS[0] * CELLS[1]))
        solid = 1.0 if noise(cell, 2, 3) > 0.75 else 0.0
        assert arrays["solid_fraction"].GetValue(n) == solid, cell
        # p = (rho/1000 - 1)/3 * 1000 * (dx/dt)^2 with dx/dt = 0.1; rho in float has 6e-8 of 1000.
        expected = (arrays["density"].GetValue(n) / 1000 - 1) / 3 * 1000 * 0.01
        assert abs(arrays["pressure"].GetValue(n) - expected) < 1e-6, cell
        speed = max(abs(arrays["velocity"].GetComponent(n, a)) for a in range(3))
        assert speed == 0 or solid == 0, cell
        solids += solid == 1.0
        moving += speed > 1e-6
    assert solids > 30 and moving > 300, (solids, moving)
    print("read", len(times), "times,", solids, "solid and", moving, "moving cells")


main(sys.argv[1])
