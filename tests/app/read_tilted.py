"""Prints the frames of a trajectory of a tilted box, read by a program of its format: cells as rows of
edges, positions, and positions in the image in which a particle began."""

import json
import pathlib
import sys
import warnings

warnings.simplefilter("ignore")

import ase.io
import gsd.hoomd
import h5py
import MDAnalysis
from MDAnalysis.coordinates.H5MD import H5MDReader
import numpy
import pandas
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def frame_of(time, cell, positions, images):
    cell, positions = numpy.array(cell), numpy.array(positions)
    frame = {"cell": cell.tolist(), "positions": positions.tolist()}
    if time is not None:
        frame["time"] = float(time)
    if images is not None:
        frame["unwrapped"] = (positions + numpy.array(images) @ cell).tolist()
    return frame


def read_ase(file):
    return [frame_of(f.info["Time"], f.cell[:], f.positions, f.arrays["map_shift"])
            for f in ase.io.read(file, index=":")]


def read_dump(file):
    gas = MDAnalysis.Universe(file, format="LAMMPSDUMP", topology_format="LAMMPSDUMP")
    return [frame_of(None, frame.triclinic_dimensions, frame.positions, None)
            for frame in gas.trajectory]


def read_csv(file):
    """The box is 12 x 9, see the scene of the test."""
    rows = pandas.read_csv(file, float_precision="round_trip")
    frames = []
    for time, frame in rows.groupby("time"):
        cell = [[12, 0], [frame["tilt"].iloc[0], 9]]
        frames.append(frame_of(time, cell, frame[["x", "y"]], frame[["image_x", "image_y"]]))
    return frames


def read_gsd(file):
    """HOOMD's cell has its middle at 0, and its tilt is a share of the edge."""
    frames = []
    with gsd.hoomd.open(file) as trajectory:
        for frame in trajectory:
            frame.validate()
            lx, ly, lz, xy = frame.configuration.box[:4]
            cell = numpy.array([[lx, 0, 0], [xy * ly, ly, 0], [0, 0, lz]], dtype=float)
            positions = frame.particles.position + cell.sum(axis=0) / 2
            numpy.testing.assert_allclose(frame.log["configuration/tilt"], xy * ly, atol=1e-5)
            frames.append(frame_of(frame.log["time"][0], cell, positions, frame.particles.image))
    return frames


def read_h5md(file):
    with h5py.File(file) as trajectory:
        gas = trajectory["particles/all"]
        frames = [frame_of(*frame) for frame in zip(
            gas["position/time"][:], gas["box/edges/value"][:], gas["position/value"][:],
            gas["image/value"][:])]
    with H5MDReader(file, convert_units=False, n_atoms=len(frames[0]["positions"])) as reader:
        for frame, other in zip(frames, reader):
            numpy.testing.assert_allclose(other.triclinic_dimensions, frame["cell"], atol=1e-5)
            numpy.testing.assert_allclose(other.positions, frame["positions"], atol=1e-5)
    return frames


def read_vtp(file):
    frames = []
    for entry in json.loads(pathlib.Path(file + ".series").read_text())["files"]:
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(pathlib.Path(file).parent / entry["name"]))
        reader.Update()
        gas = reader.GetOutput()
        lx, ly, lz = vtk_to_numpy(gas.GetFieldData().GetArray("box"))
        tilt = vtk_to_numpy(gas.GetFieldData().GetArray("tilt"))[0]
        frames.append(frame_of(entry["time"], [[lx, 0, 0], [tilt, ly, 0], [0, 0, lz]],
                               vtk_to_numpy(gas.GetPoints().GetData()),
                               vtk_to_numpy(gas.GetPointData().GetArray("image"))))
    return frames


READERS = {".xyz": read_ase, ".lammpstrj": read_dump, ".csv": read_csv, ".gsd": read_gsd,
           ".h5md": read_h5md, ".vtp": read_vtp}
print(json.dumps(READERS[pathlib.Path(sys.argv[1]).suffix](sys.argv[1])))
