"""contacts_in_paraview.py FILE_contacts.xdmf NUMBER (by pvpython): VTK's own reader finds so many lines in the last state, of two ends each."""
import sys

from paraview import servermanager
from paraview.simple import XDMFReader


def leaf(data):
    while data.GetClassName() == "vtkMultiBlockDataSet":
        data = data.GetBlock(0)
    return data


reader = XDMFReader(FileNames=[sys.argv[1]])
reader.UpdatePipeline(list(reader.TimestepValues)[-1])
lines = leaf(servermanager.Fetch(reader))
number = int(sys.argv[2])
assert (lines.GetNumberOfCells(), lines.GetNumberOfPoints()) == (number, 2 * number), (lines.GetNumberOfCells(), lines.GetNumberOfPoints())
values = lines.GetCellData()
force, normal = values.GetArray("force"), values.GetArray("normal_force")
for cell in range(number):
    ends = lines.GetCell(cell).GetPoints()
    first, second = ends.GetPoint(0), ends.GetPoint(1)
    branch = [a - b for a, b in zip(first, second)]
    length = sum(b * b for b in branch) ** 0.5
    assert 0.4e-3 < length < 1.1e-3, length  # grains of 0.6 and 1 mm
    along = sum(b * f for b, f in zip(branch, force.GetTuple(cell))) / length
    assert abs(along - normal.GetValue(cell)) < 1e-6 * max(abs(along), 1e-9), (along, normal.GetValue(cell))
print(f"{number} contacts as ParaView reads them: in order")
