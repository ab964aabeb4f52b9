#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/runs/options.h"
#include "engine/scene/scene.h"
#include "render/output/image.h"

namespace clatter {

/// The flags that add gases to a film, in cells beside its scene.
struct CompareOptions {
  std::vector<std::string> scenes;    ///< paths of scenes or pictures, or gallery names
  std::vector<std::string> settings;  ///< "key=value" of each --compare

  std::size_t count() const { return scenes.size() + settings.size(); }
};

/// A scene of a film that compares gases.
struct ComparedScene {
  Scene scene;
  std::uint64_t seed = 1;
};

/// All scenes of a film: `first`, the other scenes, then the first one with each --compare. `run`
/// has the flags of the first scene; its --set applies to all. `one_seed`: a picture among the
/// other scenes does not bring its seed. Throws UserError.
std::vector<ComparedScene> compared_scenes(ComparedScene first, const CompareOptions& compare,
                                           const CommonOptions& run, bool one_seed);

/// The files that the scenes beside the first one read.
std::vector<std::filesystem::path> inputs_of(const CompareOptions& compare,
                                             const std::vector<ComparedScene>& scenes);

/// The headings of the cells: "A: restitution 1" and "B: restitution 0.9". They have the titles of
/// the scenes and the seeds, if these differ, and up to three keys in which scenes of one title
/// differ.
std::vector<std::string> cell_titles(const std::vector<ComparedScene>& scenes);

/// The texts inside a picture of these scenes: those of the first one, and the seeds and scenes of
/// the others.
std::vector<PngText> picture_texts(const std::vector<ComparedScene>& scenes);

}  // namespace clatter
