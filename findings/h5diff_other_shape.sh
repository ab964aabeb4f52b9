#!/usr/bin/env bash
# h5diff ends with 0, as for equal files, if a dataset has another number of rows, another shape or
# another type. It prints that "some objects are not comparable", but only without --quiet. A
# comparison of results by its exit code passes.
set -euo pipefail
suite=trixie
packages=base-files,hdf5-tools=1.14.5+repack-3,python3-h5py=3.13.0-1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import subprocess, sys
import h5py, numpy

def file(name, values):
    with h5py.File(name, "w") as new:
        new["energy"] = values
    return name

def compared(values, *flags):
    done = subprocess.run(["h5diff", *flags, "ten.h5", file("other.h5", values)],
                          capture_output=True, text=True)
    return done.returncode, " ".join(done.stdout.replace("-", "").split())

ten = numpy.arange(10.0)
file("ten.h5", ten)
print(subprocess.run(["h5diff", "--version"], capture_output=True, text=True).stdout.strip())
print("Expectation: 0 for equal files alone; 1 where something differs.")
print("Behaviour:")
codes = []
for name, values in (("the same", ten), ("another number", ten + (ten == 3)),
                     ("two more rows", numpy.arange(12.0)), ("five columns", ten.reshape(2, 5)),
                     ("integers", numpy.arange(10) + 7), ("a text", "no numbers")):
    code, output = compared(values)
    quiet, nothing = compared(values, "--quiet")
    codes.append((code, quiet, nothing))
    print(f"  {name}: {code}, {quiet} with --quiet; {output}")
sys.exit(codes != [(0, 0, ""), (1, 1, "")] + 4 * [(0, 0, "")])
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
