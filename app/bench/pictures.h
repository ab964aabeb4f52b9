#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// The cost of a picture at a setting, and its deviation from the best.
struct PictureRow {
  std::string setting;
  double value = 0.0;         ///< of the parameter
  double cpu_seconds = 0.0;   ///< per picture, all threads; for frame rates per second of film
  double ssim = 1.0;          ///< structural similarity to the best; 1: equal
  double centre_error = 0.0;  ///< root mean square error of a disk's centre, in pixels of the best;
                              ///< NaN: not measured
  /// Of a second of film; NaN: no film.
  double bytes = std::numeric_limits<double>::quiet_NaN();
  bool dominated = false;     ///< whether another setting is cheaper and closer
};

/// A parameter of pictures with its settings, from the finest.
struct PictureTable {
  std::string dial;
  std::string title;
  std::vector<PictureRow> rows;
};

/// Names of the parameters.
inline constexpr const char* kPictureDials[] = {"antialiasing", "picture_size", "frame_rate",
                                                "encoding"};

/// Draws a gas after `time` at each setting of a parameter. Compares with pictures of 4 x 4 samples
/// per pixel: antialiasing at 1280x720, picture sizes enlarged to 1920x1080. For the frame rate,
/// compares each frame with the gas half a frame later. For the encoding, compares the pictures of
/// an mp4 with those that were encoded; needs ffmpeg.
PictureTable measure_pictures(const std::string& dial, const Scene& scene, double time);

}  // namespace clatter
