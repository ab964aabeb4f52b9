#include "render/occlusion.h"

#include <algorithm>
#include <cmath>

namespace clatter {

Occlusion::Occlusion(Size size)
    : size_(size),
      words_(static_cast<std::size_t>((size.width + kBits - 1) / kBits)),
      covered_(static_cast<std::size_t>(size.height) * words_) {}

namespace {

// The numbers of the pixels, among `count`, with centres at most `half` from `middle`.
struct Span {
  Span(double middle, double half, int count)
      : first(static_cast<int>(std::clamp(std::ceil(middle - half - 0.5), 0.0, 1.0 * count))),
        end(static_cast<int>(std::clamp(std::floor(middle + half + 0.5), 0.0, 1.0 * count))) {}
  int first, end;
};

}  // namespace

// Whether `visit` returns true for the index of each word of the disk and its bits of the disk.
template <class Visit>
bool Occlusion::all_words(const Vec2& centre, double radius, Visit visit) const {
  if (!(radius > 0.0)) return true;
  const Span rows(centre.y(), radius, size_.height);
  for (int row = rows.first; row < rows.end; ++row) {
    const double off = row + 0.5 - centre.y();
    const Span span(centre.x(), std::sqrt(std::max(0.0, radius * radius - off * off)), size_.width);
    for (int begin = span.first, end = 0; begin < span.end; begin = end) {
      const int word = begin / kBits;
      end = std::min(span.end, (word + 1) * kBits);
      const std::uint64_t bits = (~std::uint64_t{0} >> (kBits - (end - begin))) << (begin % kBits);
      if (!visit(static_cast<std::size_t>(row) * words_ + static_cast<std::size_t>(word), bits)) {
        return false;
      }
    }
  }
  return true;
}

bool Occlusion::hides(const Vec2& centre, double radius) const {
  return all_words(centre, radius, [&](std::size_t word, std::uint64_t bits) {
    return (covered_[word] & bits) == bits;
  });
}

void Occlusion::cover(const Vec2& centre, double radius) {
  all_words(centre, radius, [&](std::size_t word, std::uint64_t bits) {
    covered_[word] |= bits;
    return true;
  });
}

}  // namespace clatter
