"""Prints the texts of an SVG file, one a line."""

import sys
import xml.etree.ElementTree as xml

for text in xml.parse(sys.argv[1]).iter("{http://www.w3.org/2000/svg}text"):
    print(text.text)
