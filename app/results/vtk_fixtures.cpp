#include "app/results/vtk_fixtures.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/results/vtk_xml.h"

namespace clatter {

namespace {

// Cells of one kind: the numbers of their points, and of their fixtures.
struct Cells {
  std::vector<long> points, ends;
  std::vector<int> fixtures;

  void add(const std::vector<long>& corners, int fixture) {
    points.insert(points.end(), corners.begin(), corners.end());
    ends.push_back(static_cast<long>(points.size()));
    fixtures.push_back(fixture);
  }
  std::string xml(const char* kind, VtkArrays& arrays) const {
    return fmt::format("      <{}>\n", kind) + arrays.add("connectivity", 1, points) +
           arrays.add("offsets", 1, ends) + fmt::format("      </{}>\n", kind);
  }
};

class Shapes {
 public:
  long point(const Vec2& place) { return point(Vec<3>(place.x(), place.y(), 0.0)); }
  long point(const Vec<3>& place) {
    places.insert(places.end(), place.begin(), place.end());
    return static_cast<long>(places.size() / 3) - 1;
  }

  // A segment.
  void add_plate(const Piece<2>& plate, int fixture) {
    const Vec2 end = plate.corner + plate.lengths[0] * plate.directions[0];
    const long first = point(plate.corner), second = point(end);
    lines.add({first, second}, fixture);
  }
  // A rectangle.
  void add_plate(const Piece<3>& plate, int fixture) {
    const Vec<3> a = plate.lengths[0] * plate.directions[0];
    const Vec<3> b = plate.lengths[1] * plate.directions[1];
    std::vector<long> corners;
    for (const Vec<3>& edge : {Vec<3>(Vec<3>::Zero()), a, Vec<3>(a + b), b}) {
      corners.push_back(point(Vec<3>(plate.corner + edge)));
    }
    polygons.add(corners, fixture);
  }
  // A regular polygon.
  void add_ball(const Piece<2>& ball, int fixture) {
    std::vector<long> corners;
    for (int k = 0; k < kParts; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kParts;
      const Vec2 normal(std::cos(angle), std::sin(angle));
      corners.push_back(point(Vec2(ball.corner + ball.radius * normal)));
    }
    polygons.add(corners, fixture);
  }
  // Four-sided parts between circles of latitude. At the poles they have two equal corners.
  void add_ball(const Piece<3>& ball, int fixture) {
    const long first = static_cast<long>(places.size() / 3);
    for (int row = 0; row <= kParts / 2; ++row) {
      const double polar = 2.0 * std::numbers::pi * row / kParts;
      for (int k = 0; k < kParts; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kParts;
        point(Vec<3>(ball.corner + ball.radius * Vec<3>(std::sin(polar) * std::cos(angle),
                                                        std::sin(polar) * std::sin(angle),
                                                        std::cos(polar))));
      }
    }
    for (long row = 0; row < kParts / 2; ++row) {
      for (long k = 0; k < kParts; ++k) {
        const long low = first + row * kParts, high = low + kParts, next = (k + 1) % kParts;
        polygons.add({low + k, high + k, high + next, low + next}, fixture);
      }
    }
  }

  std::vector<double> places;
  Cells lines, polygons;

 private:
  static constexpr long kParts = 48;  // of a circle
};

}  // namespace

template <int D>
std::string fixture_shapes(const std::vector<Fixture<D>>& fixtures, const std::string& origin) {
  Shapes shapes;
  for (std::size_t k = 0; k < fixtures.size(); ++k) {
    const int number = static_cast<int>(k);
    for (const Piece<D>& piece : fixtures[k].pieces) {
      if (piece.is_plate()) shapes.add_plate(piece, number);
      if (piece.radius > 0.0) shapes.add_ball(piece, number);
    }
  }
  std::vector<int> numbers = shapes.lines.fixtures;
  numbers.insert(numbers.end(), shapes.polygons.fixtures.begin(), shapes.polygons.fixtures.end());
  VtkArrays arrays;
  std::string xml = vtk_head("PolyData", origin) + "  <PolyData>\n";
  xml += fmt::format(
      "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      shapes.places.size() / 3, shapes.lines.ends.size(), shapes.polygons.ends.size());
  xml += "      <CellData Scalars=\"fixture\">\n" + arrays.add("fixture", 1, numbers) +
         "      </CellData>\n";
  xml += "      <Points>\n" + arrays.add("positions", 3, shapes.places, "a") + "      </Points>\n";
  xml += shapes.lines.xml("Lines", arrays) + shapes.polygons.xml("Polys", arrays);
  return xml + "    </Piece>\n  </PolyData>\n" + arrays.appended();
}

template std::string fixture_shapes(const std::vector<Fixture<2>>&, const std::string&);
template std::string fixture_shapes(const std::vector<Fixture<3>>&, const std::string&);

}  // namespace clatter
