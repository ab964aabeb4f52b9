"""Runs the code of docs/haff.ipynb without Jupyter, and checks its numbers and pictures."""

import json
import pathlib
import sys

try:
    import matplotlib
except ImportError:
    sys.exit("[skipped]: this test needs matplotlib")

matplotlib.use("Agg")
notebook = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
names = {}
for cell in notebook["cells"]:
    if cell["cell_type"] == "code":
        exec("".join(cell["source"]), names)

# Clusters and the velocity correlations before them slow the decay by some percent.
assert 0.9 < names["measured"] / names["rate"] < 1.05, (names["measured"], names["rate"])
assert len(names["plt"].gcf().axes[0].images) == 2
assert len(names["plt"].gcf().axes[0].lines) == 2
