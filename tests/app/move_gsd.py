"""Writes moved.gsd, the file a.gsd with particle 0 in the centre of the box, but not in the log of
exact numbers; and rounded.gsd, where that frame has no log."""

import gsd.hoomd

new_names = hasattr(gsd.hoomd, "Frame")
with gsd.hoomd.open("a.gsd", "r" if new_names else "rb") as trajectory:
    frames = list(trajectory)
moved = frames[-1]
moved.particles.position = moved.particles.position.copy()
moved.particles.position[0] = 0
with gsd.hoomd.open("moved.gsd", "w" if new_names else "wb") as trajectory:
    trajectory.extend(frames)
moved.log = {}
with gsd.hoomd.open("rounded.gsd", "w" if new_names else "wb") as trajectory:
    trajectory.extend(frames)
