#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// What a picture drawn at a setting costs, and how far it is off the best.
struct PictureRow {
  std::string setting;
  double value = 0.0;         ///< on the dial
  double cpu_seconds = 0.0;   ///< a picture, all threads; of frame rates a second of film
  double ssim = 1.0;          ///< structural similarity to the best, 1: equal
  double centre_error = 0.0;  ///< root mean square, of a disk's centre; pixels of the best
  bool dominated = false;     ///< whether another setting costs less and is closer
};

/// A dial of pictures with its settings, from the finest.
struct PictureTable {
  std::string dial;
  std::string title;
  std::vector<PictureRow> rows;
};

/// Names of the dials.
inline constexpr const char* kPictureDials[] = {"antialiasing", "picture_size", "frame_rate"};

/// Draws a gas after `time` at each setting of a dial and compares with what 4 x 4 samples a pixel
/// give: antialiasing at 1280x720; the size of pictures, enlarged to 1920x1080; and the frame rate,
/// each frame with the gas half way to the next.
PictureTable measure_pictures(const std::string& dial, const Scene& scene, double time);

}  // namespace clatter
