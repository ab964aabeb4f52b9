"""Writes particles as files of VTK PolyData, by VTK's own writer in each of its encodings. Prints the
names of the files. The exit code is 3 without VTK."""

import itertools

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError:
    raise SystemExit(3)
import numpy


def array(name, values, kind=float):
    made = numpy_to_vtk(numpy.array(values, kind), deep=True)
    made.SetName(name)
    return made


def gas():
    """Two kinds of disks. Their numbers need all digits of double precision."""
    made, points, vertices = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetData(array("Points", [[1 / 3, 1, 0], [4.1, 2, 0], [6, 1e-9, 0]]))
    for k in range(3):
        vertices.InsertNextCell(1, [k])
    made.SetPoints(points)
    made.SetVerts(vertices)
    of_points = made.GetPointData()
    of_points.AddArray(array("Velocity", [[0.1, 2, 0], [-1 / 3, 0, 0], [0, 1e-300, 0]]))
    of_points.AddArray(array("radius", [0.5, 0.5, 1]))
    of_points.AddArray(array("mass", [1, 1, 8]))
    of_points.AddArray(array("type", [1, 1, 2], numpy.int32))
    of_points.AddArray(array("pressure", [1, 2, 3], numpy.float32))
    names = vtkStringArray()
    names.SetName("species_names")
    for name in ("none", "light", "heavy"):
        names.InsertNextValue(name)
    made.GetFieldData().AddArray(names)
    made.GetFieldData().AddArray(array("TimeValue", [2.5]))
    return made


particles = gas()
modes = ("Ascii", "Binary", "Appended")
for mode, base64, zlib, words, big in itertools.product(modes, (0, 1), (0, 1), (32, 64), (0, 1)):
    if mode != "Appended" and base64:
        continue  # only appended data have a choice
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(particles)
    getattr(writer, "SetDataModeTo" + mode)()
    writer.SetEncodeAppendedData(base64)
    if zlib:
        writer.SetCompressorTypeToZLib()
        writer.SetBlockSize(64)  # several blocks, and a last one that is smaller
    else:
        writer.SetCompressorTypeToNone()
    getattr(writer, f"SetHeaderTypeToUInt{words}")()
    if big:
        writer.SetByteOrderToBigEndian()
    name = f"{mode}_{base64}{zlib}_{words}_{big}.vtp"
    writer.SetFileName(name)
    assert writer.Write() == 1
    print(name)
