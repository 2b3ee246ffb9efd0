"""coupling_xdmf_reader_test.py FILE.xdmf (by pvpython): VTK's own reader finds the grains that unit_coupling_sums wrote on one rank."""
import sys

from paraview import servermanager
from paraview.simple import XDMFReader


def leaf(data):
    while data.GetClassName() == "vtkMultiBlockDataSet":
        data = data.GetBlock(0)
    return data


reader = XDMFReader(FileNames=[sys.argv[1]])
reader.UpdatePipeline(0.7)
assert list(reader.TimestepValues) == [0.5, 0.7], reader.TimestepValues
grains = leaf(servermanager.Fetch(reader))
assert grains.GetNumberOfPoints() == 1, grains.GetNumberOfPoints()
arrays = {grains.GetPointData().GetArrayName(n) for n in range(grains.GetPointData().GetNumberOfArrays())}
assert {"id", "radius", "diameter", "velocity", "angular_velocity", "force", "torque"} <= arrays, arrays
assert abs(grains.GetPoint(0)[2] - 0.2) < 1e-12, grains.GetPoint(0)
assert grains.GetPointData().GetArray("diameter").GetValue(0) == 2e-3
print("grains as ParaView reads them: in order")
