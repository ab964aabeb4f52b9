#!/usr/bin/env bash
# MDAnalysis and ASE read scaled columns (xs ys zs) of a LAMMPS dump into another frame of reference
# than the columns x y z, unless the lower corner of the box is the origin. The dump is valid:
# LAMMPS defines x = xlo + xs * (xhi - xlo).
set -euo pipefail
suite=trixie
packages=base-files,python3-mdanalysis=2.9.0-12,python3-ase=3.24.0-1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import sys, warnings
import numpy
warnings.filterwarnings("ignore")
import ase, ase.io, MDAnalysis

low, edges = numpy.array([-5, -5, -0.5]), numpy.array([10, 10, 1])
states = numpy.array([[-4, -3, 0], [4, -1, 0]])  # two disks in a box around the origin

def dump(name, columns, rows):
    bounds = "".join(f"{a} {a + l}\n" for a, l in zip(low, edges))
    atoms = "".join(f"{n} 1 {x} {y} {z}\n" for n, (x, y, z) in enumerate(rows, 1))
    open(name, "w").write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n"
                          f"{bounds}ITEM: ATOMS id type {columns}\n{atoms}")

dump("plain.dump", "x y z", states)
dump("scaled.dump", "xs ys zs", (states - low) / edges)

def with_ase(name):
    return ase.io.read(name, format="lammps-dump-text").positions

def with_mdanalysis(name):
    return MDAnalysis.Universe(name, format="LAMMPSDUMP").atoms.positions

as_described = True
print("ASE", ase.__version__, "and MDAnalysis", MDAnalysis.__version__)
print("The same state, written twice:\n", states.tolist())
print("Expectation: x y z and xs ys zs give the same positions.")
for reader, shift_plain, shift_scaled in (with_ase, 0, 1), (with_mdanalysis, 1, 2):
    plain, scaled = reader("plain.dump"), reader("scaled.dump")
    print(reader.__name__, "\n  x y z:   ", plain.tolist(), "\n  xs ys zs:", scaled.tolist())
    as_described &= numpy.allclose(plain, states - shift_plain * low, atol=1e-5)
    as_described &= numpy.allclose(scaled, states - shift_scaled * low, atol=1e-5)
print("Behaviour: ASE subtracts the lower corner from scaled positions alone. MDAnalysis\n"
      "subtracts it from both, and twice from scaled ones, which then lie outside its box.")
sys.exit(not as_described)
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
