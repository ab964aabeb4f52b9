"""Prints the frames of an extended XYZ file, read by ASE, and of a LAMMPS dump, read by MDAnalysis."""

import json
import sys
import warnings

warnings.simplefilter("ignore")

import ase.io
import MDAnalysis

ARRAYS = ("positions", "velo", "omega", "map_shift", "radius")
xyz, dump = sys.argv[1:]
frames = [
    {
        "time": float(frame.info["Time"]),
        "periodic": frame.pbc.tolist(),
        "box": frame.cell.lengths().tolist(),
        "symbol": frame.symbols[0],
        **{name: frame.arrays[name].tolist() for name in ARRAYS},
    }
    for frame in ase.io.read(xyz, index=":")
]
universe = MDAnalysis.Universe(dump, format="LAMMPSDUMP", lammps_coordinate_convention="unscaled")
positions = [step.positions.tolist() for step in universe.trajectory]
print(json.dumps({"ase": frames, "mdanalysis": positions}))
