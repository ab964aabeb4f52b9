#include "app/import/frame_order.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The elements of a list at `places`; an empty list stays empty.
template <class T>
void choose(std::vector<T>& list, const std::vector<std::size_t>& places) {
  if (list.empty()) return;
  std::vector<T> chosen;
  for (const std::size_t place : places) chosen.push_back(list[place]);
  list = chosen;
}

}  // namespace

void sort_by_id(ParticleFrame& frame, const std::vector<std::optional<double>>& ids,
                const std::filesystem::path& path) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k]) places.push_back(k);
  }
  const auto id = [&](std::size_t place) { return *ids[place]; };
  std::ranges::stable_sort(places, {}, id);
  const auto twice = std::ranges::adjacent_find(places, {}, id);
  if (twice != places.end()) {
    throw UserError({path.string()}, "the id " + number_text(id(*twice)) + " occurs twice",
                    "give each particle its own id");
  }
  for (const std::size_t place : places) frame.ids.push_back(id(place));
  choose(frame.positions, places);
  choose(frame.velocities, places);
  choose(frame.spins, places);
  choose(frame.images, places);
  choose(frame.masses, places);
  choose(frame.diameters, places);
  choose(frame.types, places);
}

}  // namespace clatter
