#!/usr/bin/env bash
# VTK loses all points of a PolyData file if an ASCII array has an XML comment, a character reference
# or a CDATA section, which are valid XML. The error code of the reader is 0, so a script does not
# notice. Tools that write XML by a library may write such files.
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
import sys
import xml.etree.ElementTree as tree
from vtkmodules.vtkCommonCore import vtkObject, vtkVersion
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

vtkObject.GlobalWarningDisplayOff()
FILE = """<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="2"><PointData>
<DataArray type="Float64" Name="speed" format="ascii">{} 4.0</DataArray></PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">1 2 0 3 4 0</DataArray>
</Points></Piece></PolyData></VTKFile>"""

def points(first):
    open("gas.vtp", "w").write(FILE.format(first))
    assert tree.parse("gas.vtp").find(".//PointData/DataArray").text.split() == ["3.5", "4.0"]
    reader = vtkXMLPolyDataReader()
    reader.SetFileName("gas.vtp"), reader.Update()
    return reader.GetOutput().GetNumberOfPoints(), reader.GetErrorCode()

print("VTK", vtkVersion.GetVTKVersion(), "\nExpectation: 2 points, or an error code, of each file")
results = {}
for name, text in {"plain": "3.5", "comment": "<!-- fast -->3.5", "reference": "&#51;.5",
                   "CDATA": "<![CDATA[3.5]]>"}.items():
    results[name] = points(text)
    print("Behaviour:", name, "gives %d points, error code %d" % results[name])
sys.exit(results != {"plain": (2, 0), "comment": (0, 0), "reference": (0, 0), "CDATA": (0, 0)})
END
chroot root /usr/bin/python3.13 /finding.py
