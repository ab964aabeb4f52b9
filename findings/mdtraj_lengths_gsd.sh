#!/usr/bin/env bash
# MDTraj divides the lengths of LAMMPS dumps and XYZ files by 10 (Angstrom to nm), but not those of
# GSD files. The same particles are 10 times farther apart from GSD. None of the three formats has a
# unit of length.
set -euo pipefail
suite=trixie
packages=base-files,python3-mdtraj=1.10.3-2+b1,python3-gsd=3.4.2-2+b1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import sys, warnings
warnings.filterwarnings("ignore")
from importlib.metadata import version
import gsd.hoomd, mdtraj, numpy

states = numpy.array([[-1.5, 0, 0], [1.5, 0, 0]])  # two spheres, 3 diameters apart
lines = [" ".join(map(str, state)) for state in states]
open("gas.xyz", "w").write("2\n\n" + "".join(f"A {line}\n" for line in lines))
open("gas.lammpstrj", "w").write(
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n" + 3 * "-5 5\n"
    + "ITEM: ATOMS id type x y z\n" + "".join(f"{n} 1 {line}\n" for n, line in enumerate(lines, 1)))
frame = gsd.hoomd.Frame()
frame.particles.N, frame.particles.position = 2, states
frame.configuration.box = [10, 10, 10, 0, 0, 0]
with gsd.hoomd.open("gas.gsd", "w") as trajectory:
    trajectory.append(frame)

topology = mdtraj.Topology()
residue = topology.add_residue("GAS", topology.add_chain())
for _ in range(2):
    topology.add_atom("A", mdtraj.element.virtual, residue)
print("MDTraj", version("mdtraj"))
print("Expectation: the distance is the same from each file, 3 or 0.3.")
distances = []
for name in "gas.xyz", "gas.lammpstrj", "gas.gsd":
    gas = mdtraj.load(name, top=topology)
    distances.append(float(gas.xyz[0, 1, 0] - gas.xyz[0, 0, 0]))
    print(f"  {name}: {distances[-1]:.3g}, box {gas.unitcell_lengths}")
print("Behaviour: positions and box of GSD alone keep their numbers.")
sys.exit(not numpy.allclose(distances, [0.3, 0.3, 3]))
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
