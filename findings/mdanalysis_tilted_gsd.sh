#!/usr/bin/env bash
# A GSD file has the tilt of a triclinic box as the ratio of a shift to an edge: xy = b_x / L_y.
# MDAnalysis takes it for the cosine of the angle between the edges along y and z, without an error:
# another edge is tilted. HOOMD-blue and the gsd package define the box as Lx, Ly, Lz, xy, xz, yz.
set -euo pipefail
suite=trixie
packages=base-files,python3-mdanalysis=2.9.0-12,python3-gsd=3.4.2-2+b1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import sys, warnings
from importlib.metadata import version
import numpy
warnings.filterwarnings("ignore")
import gsd.hoomd, MDAnalysis

def read(tilt):
    frame = gsd.hoomd.Frame()
    frame.configuration.box = [10, 8, 6, tilt, 0, 0]
    frame.particles.N = 1
    frame.particles.position = [[0, 0, 0]]
    with gsd.hoomd.open("gas.gsd", "w") as trajectory:
        trajectory.append(frame)
    state = MDAnalysis.Universe("gas.gsd").trajectory.ts
    return state.dimensions, state.triclinic_dimensions

print("gsd", version("gsd"), "and MDAnalysis", MDAnalysis.__version__)
as_described = True
for tilt in 0, 0.5:
    expected = numpy.array([[10, 0, 0], [8 * tilt, 8, 0], [0, 0, 6]])
    dimensions, edges = read(tilt)
    print("xy =", tilt, "\n  expectation:", expected.tolist())
    print("  behaviour:  ", edges.tolist(), "from", dimensions.tolist())
    as_described &= numpy.allclose(edges, expected, atol=1e-4) == (tilt == 0)
print("Behaviour: the edge along y is straight, and the one along z leans by acos(xy) towards y.")
sys.exit(not (as_described and numpy.allclose(edges[2], [0, 3, 27**0.5])))
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
