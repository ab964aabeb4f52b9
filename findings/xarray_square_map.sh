#!/usr/bin/env bash
# xarray with h5netcdf gives axes of equal length one name, in HDF5 files whose axes have no names.
# The x of the columns of a square map then belongs to its rows: density * x multiplies each row by
# its number, without a message. In a map of 4 by 5 cells the product is right.
set -euo pipefail
suite=trixie
packages=base-files,python3-xarray=2025.03.1-8,python3-h5netcdf=1.6.1-1,python3-h5py=3.13.0-1

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
import h5netcdf, h5py, numpy, xarray

def product(columns):
    """The first row of density * x, for a density [y][x] of 1 with 4 rows and x = 0, 1, 2, ..."""
    with h5py.File("maps.h5", "w") as file:
        file["density"] = numpy.ones((4, columns))
        file["x"] = numpy.arange(float(columns))
        file["y"] = 100 + numpy.arange(4.0)
    maps = xarray.open_dataset("maps.h5", engine="h5netcdf", phony_dims="sort")
    row = (maps["density"] * maps["x"]).values[0].tolist()
    maps.close()
    return row, maps["density"].dims, maps["x"].dims

print("xarray", xarray.__version__, "and h5netcdf", h5netcdf.__version__)
print("Expectation: the first row of density * x is 0, 1, 2, 3, or an error for the unknown axes.")
print("Behaviour:")
rows = []
for columns in 5, 4:
    row, density, x = product(columns)
    rows.append(row)
    print(f"  4 rows, {columns} columns: {row}. Axes of density: {density}, of x: {x}.")
sys.exit(rows != [[0, 1, 2, 3, 4], [0, 0, 0, 0]])
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
chroot "$folder/root" /usr/bin/python3.13 /finding.py
