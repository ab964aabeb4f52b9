"""Prints the frames of trajectories, read by independent programs: extended XYZ by ASE, LAMMPS dumps
by MDAnalysis, GSD by the package gsd and by MDAnalysis."""

import json
import sys
import warnings

warnings.simplefilter("ignore")

import ase.io
import gsd.fl
import gsd.hoomd
import gsd.pygsd
import MDAnalysis
import numpy

ARRAYS = ("positions", "velo", "omega", "map_shift", "radius")


def read_xyz(file):
    return [
        {
            "time": float(frame.info["Time"]),
            "periodic": frame.pbc.tolist(),
            "box": frame.cell.lengths().tolist(),
            "symbol": frame.symbols[0],
            **{name: frame.arrays[name].tolist() for name in ARRAYS},
        }
        for frame in ase.io.read(file, index=":")
    ]


def positions_of(universe):
    return [step.positions.tolist() for step in universe.trajectory]


def read_dump(file):
    return positions_of(
        MDAnalysis.Universe(file, format="LAMMPSDUMP", lammps_coordinate_convention="unscaled")
    )


def read_gsd(file):
    """The frames, after a check that a reader in C, one in Python and MDAnalysis agree."""
    with gsd.hoomd.open(file, "rb") as trajectory, open(file, "rb") as stream:
        layer = trajectory.file
        assert layer.schema == "hoomd" and layer.schema_version == (1, 4)
        assert layer.gsd_version == (2, 0) and layer.application.startswith("clatter ")
        plain = gsd.pygsd.GSDFile(stream)
        assert plain.nframes == layer.nframes == len(trajectory)
        frames = []
        for k, frame in enumerate(trajectory):
            frame.validate()
            for name in layer.find_matching_chunk_names(""):
                assert layer.chunk_exists(k, name) == plain.chunk_exists(k, name)
                if layer.chunk_exists(k, name):
                    numpy.testing.assert_array_equal(
                        layer.read_chunk(k, name), plain.read_chunk(k, name)
                    )
            particles = frame.particles
            frames.append(
                {
                    "step": int(frame.configuration.step),
                    "dimensions": int(frame.configuration.dimensions),
                    "box": frame.configuration.box.tolist(),
                    "N": int(particles.N),
                    **{
                        name: getattr(particles, name).tolist()
                        for name in (
                            "position", "velocity", "image", "mass", "diameter",
                            "moment_inertia", "angmom",
                        )
                    },
                    "log": {name: values.tolist() for name, values in frame.log.items()},
                }
            )
    if frames and frames[0]["N"]:
        singles = positions_of(MDAnalysis.Universe(file))
        assert singles == [frame["position"] for frame in frames]
    return frames


READERS = {"xyz": read_xyz, "lammpstrj": read_dump, "gsd": read_gsd}
print(json.dumps({file: READERS[file.rsplit(".", 1)[1]](file) for file in sys.argv[1:]}))
