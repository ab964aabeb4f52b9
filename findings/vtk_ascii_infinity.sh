#!/usr/bin/env bash
# VTK reads "-inf" of an ASCII XML file as +infinity, without a message. VTK 9.3 itself writes
# "-Infinity" to such a file, and then cannot read the array. Binary files keep both infinities.
# VTK 9.6 writes "-inf" to its ASCII files, and reads it as +infinity.
set -euo pipefail
suite=trixie
packages=(python3-vtk9=9.3.0+dfsg1-4+b1 libvtk9.3=9.3.0+dfsg1-4+b1 base-files libc6 libexpat1 zlib1g
  libdouble-conversion3 libgcc-s1 liblz4-1 liblzma5 libstdc++6 libtbb12 libxxhash0
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
import re, sys
from math import inf
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkObject, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

vtkObject.GlobalWarningDisplayOff()
values, image, array = [-1.5, inf, -inf, -2.5], vtkImageData(), vtkDoubleArray()
image.SetDimensions(4, 1, 1)
array.SetName("logarithm")
for value in values:
    array.InsertNextValue(value)
image.GetPointData().AddArray(array)

def written(mode):
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(image), writer.SetFileName("map.vti")
    getattr(writer, "SetDataModeTo" + mode)(), writer.Write()
    return read()

def read():
    reader = vtkXMLImageDataReader()
    reader.SetFileName("map.vti"), reader.Update()
    back = reader.GetOutput().GetPointData().GetArray("logarithm")
    return back and [back.GetValue(i) for i in range(back.GetNumberOfTuples())]

print("VTK", vtkVersion.GetVTKVersion(), "\nExpectation: each file gives", values)
results, text = [written("Appended"), written("Ascii")], open("map.vti").read()
open("map.vti", "w").write(text.replace("Infinity", "inf"))
results.append(read())
print("Behaviour:\n  binary:", results[0], "\n  ASCII of VTK itself,",
      re.search("-1.5 .* -2.5", text)[0], ":", results[1], "\n  the same with inf:", results[2])
sys.exit(results != [values, None, [-1.5, inf, inf, -2.5]])
END
chroot root /usr/bin/python3.13 /finding.py
