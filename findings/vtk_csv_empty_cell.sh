#!/usr/bin/env bash
# VTK's reader of CSV tables, which ParaView uses, reads an empty cell of a column of numbers as 0,
# without a message. A point of a sweep without a result is then drawn as a result of 0. The word
# nan in the cell gives NaN in a column of decimals.
set -euo pipefail
suite=trixie
packages=(python3-vtk9=9.3.0+dfsg1-4+b1 libvtk9.3=9.3.0+dfsg1-4+b1 base-files ibverbs-providers
  libbrotli1 libbz2-1.0 libc6 libcap2 libdeflate0 libdouble-conversion3 libevent-core-2.1-7t64
  libevent-pthreads-2.1-7t64 libexpat1 libfabric1 libfreetype6 libgcc-s1 libhwloc15 libibverbs1
  libjbig0 libjpeg62-turbo liblerc4 liblz4-1 liblzma5 libmunge2 libnl-3-200 libnl-route-3-200
  libnuma1 libopenmpi40 libpmix2t64 libpng16-16t64 libpsm2-2 librdmacm1t64 libsharpyuv0 libstdc++6
  libtbb12 libtiff6 libucx0 libudev1 libwebp7 libxml2 libxxhash0 libzstd1 libicu76 zlib1g
  python3.13-minimal libpython3.13-minimal libpython3.13-stdlib)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
cd "$folder"
mkdir -p lists/partial cache/archives/partial root
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" >sources
apt=(apt-get -qq -o "Dir::Etc::SourceList=$folder/sources" -o Dir::Etc::SourceParts=-
  -o "Dir::State::Lists=$folder/lists" -o "Dir::Cache=$folder/cache" -o Dir::State::Status=/dev/null
  -o APT::Sandbox::User=root)
"${apt[@]}" update && "${apt[@]}" download "${packages[@]}" || exit 2
for package in *.deb; do dpkg-deb -x "$package" root; done

cat >root/finding.py <<'END'
import sys
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOInfovis import vtkDelimitedTextReader

# The second point has no result: an empty cell, or the word nan.
open("sweep.csv", "w").write("point,temperature,checked,collisions\n"
                             "1,0.25,0.25,1000\n2,,nan,\n3,0.5,0.5,3000\n")
reader = vtkDelimitedTextReader()
reader.SetFileName("sweep.csv")
reader.SetHaveHeaders(True)
reader.SetDetectNumericColumns(True)
reader.Update()
table = reader.GetOutput()
columns = [table.GetColumnByName(name) for name in ("temperature", "collisions", "checked")]
print("VTK", vtkVersion.GetVTKVersion())
print("Expectation: an empty cell is NaN, or is marked as missing.")
print("Behaviour:")
for column in columns:
    print(" ", column.GetName(), column.GetClassName(), [column.GetValue(i) for i in range(3)])
temperature, collisions, checked = (column.GetValue(1) for column in columns)
sys.exit(not (temperature == 0 and collisions == 0 and checked != checked))
END
cd root && chroot . /usr/bin/python3.13 /finding.py
