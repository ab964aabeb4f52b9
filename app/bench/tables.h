#pragma once

#include <string>

#include "engine/scene/scene.h"
#include "render/charts/plot.h"

namespace clatter {

/// Prints the cost and the precision of fields in the vibrated scene. Columns: CPU time relative to
/// a bare run, variance of the T profile at equal simulated time, and their product. Rows: the
/// exact estimator, snapshots at several intervals, and all balance equations. `duration` is the
/// simulated time of each run. Writes the table also to `json`, unless it is empty. Returns the
/// exit code.
int bench_fields(double duration, const std::string& json);

/// Prints the CPU time of each stage of a film per frame, by number of particles and picture size.
/// `count` is the number of particles; 0: all of the table. `dimension` is 2 for disks and 3 for
/// spheres. Without ffmpeg the table has no columns of the encoder. Writes the table also to
/// `json`, unless it is empty. Returns the exit code.
int bench_render(const std::string& json, int count, int dimension);

/// Prints the CPU time of jumps to random times of a run, and the memory of its recorded states.
/// The run has as many time units as 10 minutes in the window at the speed of the scene. `count` is
/// the number of disks; 0: 1000 and 20,000. Writes the table also to `json`, unless it is empty.
/// Returns the exit code.
int bench_timeline(const std::string& json, int count);

/// The scene of the tables about the window: the vibrated box over a heatmap of its temperature.
/// Its area grows with the number of disks.
Scene window_scene(int count);

/// Prints the CPU time of the window's thread per picture, with many disks over a heatmap and an
/// OpenGL without any effect, and that of a changed restitution beside that of the same simulation
/// built again. `count` is the number of disks; 0: 10,000. Writes the table also to `json`, unless
/// it is empty. Needs a display for GLFW. Returns the exit code.
int bench_window(const std::string& json, int count);

/// Writes the plot of a benchmark as a PNG file of 1600 x 1000 pixels. Throws RunError if no OpenGL
/// context opens, or if the file cannot be written.
void write_plot(const std::string& file, const Plot& plot);

}  // namespace clatter
