"""Writes legal files of other programs, by their own packages: extended XYZ by ASE, GSD by the package
gsd, H5MD by h5py. Prints nothing."""

import ase
import ase.io
import gsd.hoomd
import h5py
import numpy

# gsd 3 has other names for frames and modes than gsd 2.
new_names = hasattr(gsd.hoomd, "Frame")
Frame = gsd.hoomd.Frame if new_names else gsd.hoomd.Snapshot


def write_momenta():
    """Velocities (1, 2) and (0.5, 0): ASE writes momenta, and masses where they are set."""
    gas = ase.Atoms("X2", positions=[[2, 2, 0], [6, 6, 0]], cell=[20, 25, 1], pbc=[0, 1, 0])
    gas.set_velocities([[1, 2, 0], [0.5, 0, 0]])
    ase.io.write("momenta.extxyz", gas)
    gas.set_masses([4, 4])
    gas.set_velocities([[1, 2, 0], [0.5, 0, 0]])
    ase.io.write("heavy.extxyz", gas)
    iron = ase.Atoms("Fe2", positions=gas.positions, cell=gas.cell, pbc=gas.pbc)
    iron.set_velocities([[1, 2, 0], [0.5, 0, 0]])
    ase.io.write("iron.extxyz", iron)


def gsd_frame(box, positions, velocities=None, dimensions=None):
    frame = Frame()
    frame.configuration.box = box
    if dimensions:
        frame.configuration.dimensions = dimensions
    frame.particles.N = len(positions)
    frame.particles.position = numpy.array(positions, numpy.float32)
    if velocities:
        frame.particles.velocity = numpy.array(velocities, numpy.float32)
    return frame


def write_gsd(file, *frames):
    with gsd.hoomd.open(file, "w" if new_names else "wb") as trajectory:
        trajectory.extend(frames)


def write_gsd_files():
    flat = [20, 10, 0, 0, 0, 0]
    two, three = [[-9, -3, 0], [2, 2, 0]], [[-9, -3, 0], [2, 2, 0], [5, -4, 0]]
    moving = [[1, 0, 0], [-1, 0, 0]]
    first = gsd_frame(flat, two, moving, 2)
    first.particles.mass = [2, 2]
    first.particles.image = [[1, 0, 0], [0, 0, 0]]
    write_gsd("more.gsd", first, gsd_frame(flat, three, None, 2))
    # The chunk of the number of dimensions is absent where it is 3.
    write_gsd("old.gsd", gsd_frame(flat, two, moving, 3))
    write_gsd("layer.gsd", gsd_frame([20, 10, 1, 0, 0, 0], two, moving))
    write_gsd("spheres.gsd", gsd_frame([20, 10, 8, 0, 0, 0], two, moving))
    write_gsd("tilted.gsd", gsd_frame([20, 10, 0, 0.5, 0, 0], two, moving, 2))
    write_gsd("rest.gsd", gsd_frame(flat, two, None, 2))
    # Angular velocities 3 and -1 of spheres with I = 0.1; the second one is turned by 90 degrees
    # about x, so that its angular momentum along z is one along y of its body.
    turning = gsd_frame([20, 10, 8, 0, 0, 0], two, moving)
    turning.particles.moment_inertia = [[0.1, 0.1, 0.1]] * 2
    turning.particles.orientation = [[1, 0, 0, 0], [numpy.sqrt(0.5), numpy.sqrt(0.5), 0, 0]]
    half = numpy.sqrt(0.5) * 2 * 0.1 * -1
    turning.particles.angmom = [[0, 0, 0, 2 * 0.1 * 3], [0, 0, half, half]]
    write_gsd("turning.gsd", turning)
    # The chunks of the log are exact numbers of clatter. Others with defaults are not written.
    for name, exact in (("position", two), ("velocity", moving), ("inertia", [[0, 0, 3], [0, 0, -1]])):
        lost = gsd_frame(flat, two, moving, 2)
        if name == "position":
            lost.particles.position = None
            exact = numpy.array(two) + [10, 5, 0]
        if name == "velocity":
            lost.particles.velocity = None
        lost.log["particles/" + name.replace("inertia", "angular_velocity")] = numpy.array(exact, float)
        write_gsd("lost_" + name + ".gsd", lost)
    write_gsd("negative.gsd", gsd_frame([20, 10, -8, 0, 0, 0], two, moving, 2))
    for file, last in (("inertia.gsd", 0), ("nan_inertia.gsd", numpy.nan)):
        frame = gsd_frame([20, 10, 8, 0, 0, 0], two, moving)
        frame.particles.moment_inertia = [[0.1, 0.1, 0.1], [last] * 3]
        write_gsd(file, frame)


def element(group, name, value, step, offset=None, **options):
    made = group.create_group(name)
    made.create_dataset("value", data=numpy.array(value), **options)
    made["step"] = step
    if offset is not None:
        made["step"].attrs["offset"] = offset
    return made


def particles(file, name="all", boundary=("periodic", "periodic", "none"), edges=(20.0, 10.0, 1.0)):
    if "h5md" not in file:
        file.create_group("h5md").attrs["version"] = [1, 1]
    group = file.create_group("particles/" + name)
    box = group.create_group("box")
    box.attrs["dimension"] = 3
    if boundary:
        box.attrs["boundary"] = numpy.array(boundary, dtype="S8")
    if edges:
        box["edges"] = edges
    return group


def write_h5md_files():
    places = [[[1.0 + k, 2, 0], [12.0 - k, 7, 0]] for k in range(3)]
    speeds = [[[1.0 + k, 0, 0], [-1.0 - k, 0, 0]] for k in range(3)]
    with h5py.File("rare.h5md", "w") as file:  # velocities at every tenth step
        group = particles(file)
        element(group, "position", places, [0, 1, 2])
        element(group, "velocity", speeds, [0, 10, 20])
    with h5py.File("fixed.h5md", "w") as file:  # positions at 4, 6, 8, velocities at 0, 4, 8
        group = particles(file)
        element(group, "position", places, 2, offset=4)
        element(group, "velocity", speeds, 4)
    with h5py.File("box.h5md", "w") as file:  # one row of the box, and constant velocities
        group = particles(file, edges=None)
        element(group["box"], "edges", [[20.0, 10.0, 1.0]], [0])
        element(group, "position", places, [0, 1, 2])
        group["velocity"] = speeds[1]
    with h5py.File("ids.h5md", "w") as file:  # the particles change places, one is missing
        group = particles(file)
        element(group, "position", [places[0] + [[5.0, 5, 0]], [[numpy.nan] * 3] + places[1][::-1]], [0, 1])
        element(group, "velocity", [speeds[0] + [[0.0, 1, 0]], [[0.0] * 3] + speeds[1][::-1]], [0, 1])
        element(group, "id", [[3, 7, 8], [-1, 7, 3]], [0, 1], fillvalue=-1)
    with h5py.File("zero.h5md", "w") as file:  # without a fill value of its own, 0 is a particle
        group = particles(file)
        element(group, "position", places[:1], [0])
        element(group, "velocity", speeds[:1], [0])
        element(group, "id", [[1, 0]], [0])
    with h5py.File("unbounded.h5md", "w") as file:
        group = particles(file, boundary=None)
        element(group, "position", places, [0, 1, 2])
        element(group, "velocity", speeds, [0, 1, 2])
    with h5py.File("strange.h5md", "w") as file:
        group = particles(file, boundary=("periodic", "wall", "none"))
        element(group, "position", places, [0, 1, 2])
        element(group, "velocity", speeds, [0, 1, 2])
    with h5py.File("groups.h5md", "w") as file:
        element(particles(file, "Walls"), "position", places, [0, 1, 2])
        grains = particles(file, "grains")
        element(grains, "position", places, [0, 1, 2])
        element(grains, "velocity", speeds, [0, 1, 2])
    with h5py.File("still.h5md", "w") as file:
        element(particles(file, "grains"), "position", places, [0, 1, 2])
    with h5py.File("next.h5md", "w") as file:
        file.create_group("h5md").attrs["version"] = [2, 0]
        element(particles(file), "position", places, [0, 1, 2])
    with h5py.File("swapped.h5md", "w") as file:  # steps that go back cannot be looked up
        group = particles(file)
        element(group, "position", places, [0, 2, 1])
        element(group, "velocity", speeds, [0, 1, 2])
    with h5py.File("heavy_ids.h5md", "w") as file:
        group = particles(file)
        element(group, "position", places[:1], [0])
        element(group, "velocity", speeds[:1], [0])
        element(group, "id", [[9, 4]], [0])
        group["mass"] = [1.0, 2.5]
    for name in ("anonymous", "scalar", "line", "undimensioned", "spelled", "open", "overflow"):
        with h5py.File(name + ".h5md", "w") as file:
            group = particles(file)
            element(group, "position", places, [0, 1, 2])
            element(group, "velocity", speeds, [0, 1, 2])
            box = group["box"]
            if name == "anonymous":
                del file["h5md"]
            if name == "scalar":
                file["h5md"].attrs["version"] = 1.5
            if name == "line":
                box.attrs["dimension"] = 1
            if name == "undimensioned":
                del box.attrs["dimension"]
            if name == "spelled":
                box.attrs["dimension"] = "three"
            if name == "open":
                box.attrs["boundary"] = numpy.array(["none"] * 3, dtype="S8")
                del box["edges"]
            if name == "overflow":  # 2^64 numbers, none of them in the file
                group.create_dataset("mass", (2**22, 2**22, 2**20), "f8", chunks=(1, 16, 16))


write_momenta()
write_gsd_files()
write_h5md_files()
