#pragma once

#include <string>
#include <vector>

#include "engine/scene/field.h"

namespace clatter {

/// A field on a grid of equal box cells over the whole box (theory 8).
struct FieldMap {
  Field field;
  std::vector<int> cells;      ///< [D] along each axis
  std::vector<double> values;  ///< [cells_y][cells_x], in 3D [cells_z][cells_y][cells_x]; NaN:
                               ///< never visited
  bool whole_window = false;   ///< whether the average covers the whole window
  std::string species = {};    ///< name of the species of the field; empty: all particles
};

/// The name of a map in files.
inline std::string name_of(const FieldMap& map) {
  return name_of(map.field, map.species);
}

}  // namespace clatter
