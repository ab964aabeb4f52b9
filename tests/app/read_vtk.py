"""Prints a .vti file, or all files of a .pvd file, as JSON, read by VTK's own reader."""

import json
import pathlib
import sys
import xml.etree.ElementTree as xml

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLImageDataReader


def without_nan(values):
    """Nested lists with None for NaN, which JSON does not have."""
    if isinstance(values, list):
        return [without_nan(value) for value in values]
    return None if values != values else values


def array(found):
    return {
        "components": [
            found.GetComponentName(k) for k in range(found.GetNumberOfComponents())
        ],
        "units": found.GetInformation().Get(vtkDataArray.UNITS_LABEL()),
        "values": without_nan(vtk_to_numpy(found).tolist()),
    }


def image(path):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    found = reader.GetOutput()
    data = found.GetCellData()
    return {
        "dimensions": found.GetDimensions(),
        "origin": found.GetOrigin(),
        "spacing": found.GetSpacing(),
        "time": vtk_to_numpy(found.GetFieldData().GetArray("time")).tolist(),
        "arrays": {
            data.GetArrayName(k): array(data.GetArray(k))
            for k in range(data.GetNumberOfArrays())
        },
    }


def collection(path):
    return [
        {"timestep": float(entry.get("timestep")), **image(path.parent / entry.get("file"))}
        for entry in xml.parse(path).iter("DataSet")
    ]


path = pathlib.Path(sys.argv[1])
json.dump(collection(path) if path.suffix == ".pvd" else image(path), sys.stdout, allow_nan=False)
