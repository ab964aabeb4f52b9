"""Writes two spheres as a GSD file, by the package gsd, and as H5MD, by h5py. Two further files
have spheres of different masses. A last H5MD file claims more spheres than it has."""

import sys

import gsd.hoomd
import h5py
import numpy

position = numpy.array([[0.5, 3.5, 2.25], [5, 1.5, 2.5]])
velocity = numpy.array([[1, 0, 0.5], [0, 2, 0]])
box = numpy.array([6.0, 5.0, 4.0])
gsd_file, h5md_file, heavy_gsd_file, heavy_h5md_file, huge_file = sys.argv[1:]

# gsd 3 has other names for frames and modes than gsd 2.
new_names = hasattr(gsd.hoomd, "Frame")
mode = "w" if new_names else "wb"

frame = gsd.hoomd.Frame() if new_names else gsd.hoomd.Snapshot()
frame.configuration.box = [*box, 0, 0, 0]
frame.particles.N = 2
frame.particles.position = position - box / 2
frame.particles.velocity = velocity
with gsd.hoomd.open(gsd_file, mode) as file:
    file.append(frame)
    frame.configuration.step = 7
    file.append(frame)
frame.particles.mass = [1, 2.5]
with gsd.hoomd.open(heavy_gsd_file, mode) as file:
    file.append(frame)


def write_head(file):
    file.create_group("h5md").attrs["version"] = [1, 1]


def write_h5md(file):
    write_head(file)
    group = file.create_group("particles/gas/box")
    group.attrs["dimension"] = 3
    group.attrs["boundary"] = numpy.array([b"periodic", b"none", b"none"])
    group["edges"] = box
    for name, vectors in (("position", position), ("velocity", velocity)):
        element = file.create_group("particles/gas/" + name)
        element["value"] = numpy.array([vectors, vectors])
        element["step"] = 10
        element["time"] = 0.5


with h5py.File(h5md_file, "w") as file:
    write_h5md(file)
with h5py.File(heavy_h5md_file, "w") as file:
    write_h5md(file)
    file["particles/gas/mass"] = numpy.array([1, 2.5])

with h5py.File(huge_file, "w") as file:
    write_head(file)
    file.create_dataset("particles/gas/position/value", (1, 200_000_000, 3))
