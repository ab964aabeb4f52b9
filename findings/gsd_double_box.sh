#!/usr/bin/env bash
# gsd 5 writes trajectories in double precision with precision="double". It rounds the box to single
# precision all the same, and stores the rounded numbers as doubles. Particles near a face of the
# periodic box can then lie outside of it.
set -euo pipefail
suite=sid
packages=base-files,python3-gsd=5.0.1-2

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import sys
from importlib.metadata import version
import numpy
import gsd.fl, gsd.hoomd

edge, x = 5.7, 2.8499999999  # the periodic box ends at edge / 2 = 2.85
frame = gsd.hoomd.Frame()
frame.configuration.box = numpy.array([edge, edge, 1, 0, 0, 0], dtype=numpy.float64)
frame.particles.N = 1
frame.particles.position = numpy.array([[x, 0, 0]], dtype=numpy.float64)
with gsd.hoomd.open("gas.gsd", "w", precision="double") as trajectory:
    trajectory.append(frame)

with gsd.fl.open("gas.gsd", "r") as file:
    box, position = (file.read_chunk(frame=0, name=name)
                     for name in ("configuration/box", "particles/position"))
print("gsd", version("gsd"))
print(f"Expectation: the box is {edge!r} wide, and has the disk at {x!r} within {edge / 2!r}.")
print(f"Behaviour: the position is {position.dtype}: {float(position[0, 0])!r}.\n"
      f"The box is {box.dtype} too, but its width is {float(box[0])!r}. The disk is "
      f"{float(position[0, 0] - box[0] / 2):.1e} outside.")
rounded = float(numpy.float32(edge))
sys.exit(not (position.dtype == box.dtype == numpy.float64 and position[0, 0] == x
              and box[0] == rounded != edge and position[0, 0] > box[0] / 2))
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3 -W ignore /finding.py
