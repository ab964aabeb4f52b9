"""Prints what the particles of the last frame of a file are, read by a program of its format: names of
species or numbers of types, diameters, masses and positions, as far as the reader has them."""

import json
import pathlib
import sys
import warnings

warnings.simplefilter("ignore")

import ase.io
import gsd.hoomd
import h5py
import MDAnalysis
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read_ase(file):
    frame = ase.io.read(file, index=-1)
    return {
        "names": frame.info["type_names"].split(),
        "types": frame.arrays["type"].tolist(),
        "diameters": (2 * frame.arrays["radius"]).tolist(),
        "masses": frame.get_masses().tolist(),
        "positions": frame.positions.tolist(),
    }


def read_mdanalysis(file, **flags):
    """MDAnalysis has single precision, no radii of a dump, and the first frame of what is constant."""
    gas = MDAnalysis.Universe(file, **flags)
    gas.trajectory[-1]
    found = {"positions": gas.atoms.positions.tolist()}
    if hasattr(gas.atoms, "types"):
        found["types"] = gas.atoms.types.tolist()
    if hasattr(gas.atoms, "radii"):
        found["diameters"] = (2 * gas.atoms.radii).tolist()
        found["masses"] = gas.atoms.masses.tolist()
    return found


def read_dump(file):
    """By the documentation of LAMMPS: columns have the names of the line ITEM: ATOMS."""
    with open(file, encoding="ascii") as lines:
        frame = lines.read().split("ITEM: ATOMS ")[-1].splitlines()
    rows = [dict(zip(frame[0].split(), line.split())) for line in frame[1:]]
    return {
        "types": [int(row["type"]) for row in rows],
        "diameters": [2 * float(row["radius"]) for row in rows],
        "masses": [float(row["mass"]) for row in rows],
        "positions": [[float(row[axis]) for axis in "xyz"] for row in rows],
    }


def read_gsd(file):
    with gsd.hoomd.open(file) as frames:
        frame = frames[-1]
    frame.validate()
    return {
        "names": frame.particles.types,
        "types": frame.particles.typeid.tolist(),
        "diameters": frame.log["particles/diameter"].tolist(),
        "masses": frame.log["particles/mass"].tolist(),
        "positions": frame.log["particles/position"].tolist(),
        "single": {
            "diameters": frame.particles.diameter.tolist(),
            "masses": frame.particles.mass.tolist(),
            "moments": frame.particles.moment_inertia[:, 2].tolist(),
        },
    }


def names_of(enumeration):
    numbers = h5py.check_enum_dtype(enumeration)
    return sorted(numbers, key=numbers.get)


def read_h5md(file):
    particles = h5py.File(file)["particles/all"]
    return {
        "names": names_of(particles["species"].dtype),
        "types": particles["species"][:].tolist(),
        "diameters": particles["diameter"][:].tolist(),
        "masses": particles["mass"][:].tolist(),
        "positions": particles["position/value"][-1].tolist(),
    }


def read_events(file):
    particles = h5py.File(file)["particles"]
    return {
        "names": names_of(particles["species"].dtype),
        "types": particles["species"][:].tolist(),
        "diameters": particles["diameter"][:].tolist(),
        "masses": particles["mass"][:].tolist(),
        "units": [particles[name].attrs["units"] for name in ("diameter", "mass")],
    }


def read_vtp(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    assert reader.GetErrorCode() == 0, file
    found = reader.GetOutput()
    data, fields = found.GetPointData(), found.GetFieldData()
    arrays = {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)).tolist()
              for k in range(data.GetNumberOfArrays())}
    names = fields.GetAbstractArray("species_names")
    return {
        "names": [names.GetValue(k) for k in range(names.GetNumberOfValues())] if names else None,
        "time": fields.GetArray("TimeValue").GetValue(0),
        "box": vtk_to_numpy(fields.GetArray("box")).tolist(),
        "scalars": data.GetScalars().GetName(),
        "vectors": data.GetVectors().GetName(),
        "vertices": found.GetNumberOfVerts(),
        "positions": vtk_to_numpy(found.GetPoints().GetData()).tolist() if found.GetPoints() else [],
        "arrays": arrays,
        "types": arrays.get("species"),
        "diameters": arrays["diameter"],
        "masses": arrays["mass"],
    }


def read_series(file):
    """As ParaView: the files are beside the list."""
    with open(file, encoding="utf-8") as stream:
        entries = json.load(stream)["files"]
    folder = pathlib.Path(file).parent
    return [{"listed": entry["time"], **read_vtp(str(folder / entry["name"]))} for entry in entries]


READERS = {"xyz": read_ase, "lammpstrj": read_dump, "gsd": read_gsd, "h5md": read_h5md,
           "h5": read_events, "vtp": read_vtp, "series": read_series}
file = sys.argv[1]
found = READERS[file.rsplit(".", 1)[1]](file)
if file.endswith(".lammpstrj"):
    found["mdanalysis"] = read_mdanalysis(file, format="LAMMPSDUMP",
                                          lammps_coordinate_convention="unscaled")
if file.endswith(".gsd"):
    found["mdanalysis"] = read_mdanalysis(file)
json.dump(found, sys.stdout)
