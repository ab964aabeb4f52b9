"""The program clatter, for comparison with the module."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np

# Rough disks in oblique gravity that changes, and a moving wall.
DISKS = {
    "title": "T",
    "box": {"size": [8, 6]},
    "particles": {"count": 7, "restitution": 0.9, "tangential_restitution": 0.3},
    "gravity": {"acceleration": [0.05, -0.02]},
    "walls": {
        "bottom": {"kind": "sinusoidal", "stroke": 0.2, "frequency": 1.0},
        "top": {"kind": "static"},
    },
    "measure": {"burn_in": 1.0, "duration": 20.0, "fields": ["density", "temperature"]},
    "change": [{"time": 3.3, "set": {"gravity.acceleration": [0.3, 0.1]}}],
}
DISKS_TOML = """title = "T"
box.size = [8, 6]
particles = { count = 7, restitution = 0.9, tangential_restitution = 0.3 }
gravity = { acceleration = [0.05, -0.02] }
walls.bottom = { kind = "sinusoidal", stroke = 0.2, frequency = 1.0 }
walls.top = { kind = "static" }
measure = { burn_in = 1.0, duration = 20.0, fields = ["density", "temperature"] }
[[change]]
time = 3.3
set = { "gravity.acceleration" = [0.3, 0.1] }
"""
# Disks of two species. Those of the second have unequal diameters.
MIXTURE = {
    "title": "M",
    "box": {"size": np.array([14.0, 9.0])},
    "particles": {"restitution": 0.9},
    "species": [
        {"name": "small", "count": 12, "diameter": 0.5, "mass": 0.2, "colour": "#c03030"},
        {
            "name": "large", "count": 4, "diameter": 2.0, "mass": 6.0,
            "polydispersity": {"kind": "uniform", "width": 0.2},
        },
    ],
    "pair": [{"species": ["small", "large"], "restitution": 0.8}],
    "walls": {
        "left": {"kind": "driven", "drive_speed": 1.0},
        "right": {"kind": "static", "species": {"large": {"restitution": 0.7}}},
    },
    "measure": {"burn_in": 0.0, "duration": 5.0},
}
MIXTURE_TOML = """title = "M"
box.size = [14, 9]
particles.restitution = 0.9
measure = { burn_in = 0.0, duration = 5.0 }
walls.left = { kind = "driven", drive_speed = 1.0 }
walls.right = { kind = "static", species.large.restitution = 0.7 }
[[species]]
name = "small"
count = 12
diameter = 0.5
mass = 0.2
colour = "#c03030"
[[species]]
name = "large"
count = 4
diameter = 2.0
mass = 6.0
polydispersity = { kind = "uniform", width = 0.2 }
[[pair]]
species = ["small", "large"]
restitution = 0.8
"""
# Rough spheres between a wall that moves and a wall at rest.
SPHERES_TOML = """title = "T"
box.size = [8, 6, 5]
particles = { count = 9, restitution = 0.9, friction = 0.4 }
walls.back = { kind = "driven", drive_speed = 1.5 }
walls.front = { kind = "static" }
measure = { burn_in = 1.0, duration = 20.0 }
"""


class Folder(tempfile.TemporaryDirectory):
    """A temporary folder with scenes and outputs of the program."""

    def write(self, name, text):
        path = Path(self.name, name)
        path.write_text(text, encoding="utf-8")
        return str(path)

    def clatter(self, *words):
        """Runs the program here. Returns its messages."""
        done = subprocess.run(
            [os.environ["CLATTER"], *map(str, words)],
            cwd=self.name, capture_output=True, text=True, check=False,
        )
        return done.stderr.strip()

    def measure(self, *words):
        """The result of `clatter measure`."""
        messages = self.clatter("measure", *words, "--quiet", "--out", "r.json")
        assert not messages, messages
        return json.loads(Path(self.name, "r.json").read_text(encoding="utf-8"))
