#!/usr/bin/env bash
# MDAnalysis joins the elements of an H5MD file by their row. It uses neither the steps of each
# element nor the element `id`. H5MD gives each element its own steps, and names particles by `id`.
# A velocity thus comes with the position of another time, and a particle becomes another one.
set -euo pipefail
suite=trixie
packages=base-files,python3-mdanalysis=2.9.0-12,python3-h5py=3.13.0-1

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
import h5py, numpy, MDAnalysis
from MDAnalysis.coordinates.H5MD import H5MDReader

# Disk 1 rests at x = 10, disk 2 at x = 20. The velocity is v = step / 100 as a mark of its step.
positions, velocities, identities = [0, 100, 200], [100, 200, 300], [[1, 2], [2, 1], [1, 2]]
with h5py.File("gas.h5md", "w") as file:
    file.create_group("h5md").attrs["version"] = [1, 1]
    for who in "author", "creator":
        file.create_group("h5md/" + who).attrs.update({"name": "example", "version": "1"})
    gas = file.create_group("particles/gas")
    gas.create_group("box").attrs.update({"dimension": 3, "boundary": [b"periodic"] * 3})
    def element(name, steps, value):
        gas[name + "/value"], gas[name + "/step"] = value, steps
        gas[name + "/time"] = numpy.array(steps) / 100
    element("box/edges", positions, [numpy.diag([50.0, 50, 1])] * 3)
    element("position", positions, [[[10.0 * i, 0, 0] for i in row] for row in identities])
    element("velocity", velocities, [[[s / 100, 0, 0]] * 2 for s in velocities])
    element("id", positions, identities)

print("MDAnalysis", MDAnalysis.__version__, "and h5py", h5py.__version__)
print("Expectation: x of the disks 1 and 2 is 10 and 20 in each frame. The frame of step 0 has no\n"
      "velocity, those of the steps 100 and 200 have v = 1 and v = 2.")
frames = [(int(t.data["step"]), t.positions[:, 0].tolist(), float(t.velocities[0, 0]))
          for t in H5MDReader("gas.h5md", convert_units=False)]
for step, x, v in frames:
    print(f"  step {step}: x = {x}, v = {v}")
print("Behaviour: row k of velocity joins row k of position, so v is that of the next frame.\n"
      "Atoms have the order of the file: the disks swap at step 100, as the rows of `id` do.")
sys.exit(frames != [(0, [10, 20], 1), (100, [20, 10], 2), (200, [10, 20], 3)])
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
