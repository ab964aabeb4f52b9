"""Prints the frames of trajectories, read by independent programs: extended XYZ by ASE, LAMMPS dumps
by MDAnalysis, GSD by the package gsd and by MDAnalysis, H5MD by h5py and by MDAnalysis."""

import json
import sys
import warnings

warnings.simplefilter("ignore")

import ase.io
import gsd.fl
import gsd.hoomd
import gsd.pygsd
import h5py
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
    with gsd.hoomd.open(file) as trajectory, open(file, "rb") as stream:
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


def read_h5md(file):
    """The frames, after a check that MDAnalysis reads the same."""
    with h5py.File(file) as h5md:
        assert h5md["h5md"].attrs["version"].tolist() == [1, 1]
        assert h5md["h5md/author"].attrs["name"]
        assert h5md["h5md/creator"].attrs["name"] == "clatter"
        assert h5md["h5md/creator"].attrs["version"] and h5md.attrs["units"]
        particles = h5md["particles/all"]
        box = particles["box"]
        constant = {
            "boundary": list(box.attrs["boundary"]),
            "mass": particles["mass"][()].tolist(),
            "diameter": particles["diameter"][()].tolist(),
        }
        assert box.attrs["dimension"] == 3
        elements = {"edges": box["edges"]}
        elements |= {name: item for name, item in particles.items() if "value" in item}
        for element in elements.values():
            assert element["step"].dtype == "int64" and element["time"].dtype == "float64"
            assert element["step"] == particles["position/step"]
            assert element["value"].compression == "gzip"
        frames = [
            {
                "step": int(step),
                "time": float(particles["position/time"][k]),
                **{name: element["value"][k].tolist() for name, element in elements.items()},
                **constant,
            }
            for k, step in enumerate(particles["position/step"])
        ]
    universe = MDAnalysis.Universe(file, convert_units=False, n_atoms=len(frames[0]["position"]))
    assert [step.time for step in universe.trajectory] == [frame["time"] for frame in frames]
    for step, frame in zip(universe.trajectory, frames):
        for single, name in ((step.positions, "position"), (step.velocities, "velocity")):
            exact = numpy.array(frame[name]).astype(numpy.float32)
            numpy.testing.assert_array_equal(single, exact)
        assert step.dimensions[:3].tolist() == numpy.diag(frame["edges"]).tolist()
    return frames


READERS = {"xyz": read_xyz, "lammpstrj": read_dump, "gsd": read_gsd, "h5md": read_h5md}
print(json.dumps({file: READERS[file.rsplit(".", 1)[1]](file) for file in sys.argv[1:]}))
