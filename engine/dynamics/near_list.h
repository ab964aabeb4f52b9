#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/neighbour.h"
#include "engine/vec.h"

namespace clatter {

/// Near particles, or a part of them: up to kCapacity entries.
template <int kCapacity>
struct NearList {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::array<Neighbour, kCapacity> neighbours;  ///< entries beyond the count are kNobody
  std::uint16_t count = 0;
  bool wraps = false;          ///< whether a neighbour may have a wrap other than 0
  std::uint32_t next = kNone;  ///< list that continues this one, which is full; or kNone

  NearList() { neighbours.fill(kNobody); }
};

/// A list of any capacity, for reading.
struct NearListView {
  static constexpr std::uint32_t kNone = NearList<2>::kNone;

  int capacity;                 ///< of the NearList
  const Neighbour* neighbours;  ///< the start of the NearList
  int count;
  bool wraps;          ///< as NearList::wraps
  std::uint32_t next;  ///< as NearList::next

  template <int kCapacity>
  explicit NearListView(const NearList<kCapacity>& of)
      : capacity(kCapacity),
        neighbours(of.neighbours.data()),
        count(of.count),
        wraps(of.wraps),
        next(of.next) {}
};

/// Capacity of the lists that continue full lists. These fill one cache line: lists of spheres
/// continue often, by a few neighbours.
inline constexpr int kContinuedCapacity = 14;

/// The lists that continue full lists.
template <int D, class List>
class Continuations {
 public:
  /// The list that continues a list, which must not be the last.
  NearListView next(const NearListView& list) const { return NearListView(lists_[list.next]); }
  /// Calls visit(particle, wrap) for each neighbour of a list and of its continuations. `wrap` is
  /// its periodic image in box lengths.
  template <typename Visit>
  void visit(const List& first, const Visit& visit) const;
  /// Appends the neighbours of a list and of its continuations.
  void append_to(std::vector<Neighbour>& neighbours, const List& first) const;
  /// Number of neighbours in a list and its continuations.
  std::size_t count(const List& first) const;
  /// Appends a neighbour to a list.
  void put_on(List& list, Neighbour neighbour);
  /// Removes a neighbour from a list or from its continuations. The last entry replaces it.
  void take_off(List& list, Neighbour neighbour);
  /// Removes all neighbours from a list.
  void clear(List& list);

 private:
  static constexpr std::uint32_t kNone = List::kNone;
  struct alignas(64) Continued : NearList<kContinuedCapacity> {};

  template <typename VisitList>
  void visit_lists(const List& first, const VisitList& visit) const;
  template <class AnyList>
  static void append(AnyList& list, Neighbour neighbour);
  void take_off_chain(List& list, Neighbour neighbour);
  std::uint32_t new_list();

  LargeArray<Continued> lists_;
  std::vector<std::uint32_t> spare_;  // unused elements of lists_
};

// Calls visit(list) for a list and its continuations.
template <int D, class List>
template <typename VisitList>
void Continuations<D, List>::visit_lists(const List& first, const VisitList& visit) const {
  visit(first);
  for (std::uint32_t at = first.next; at != kNone; at = lists_[at].next) visit(lists_[at]);
}

template <int D, class List>
template <typename Visit>
void Continuations<D, List>::visit(const List& first, const Visit& visit) const {
  visit_lists(first, [&](const auto& list) {
    for (std::uint32_t k = 0; k < list.count; ++k) {
      Vec<D> wrap;
      for (int axis = 0; axis < D; ++axis) wrap[axis] = wrap_of<D>(list.neighbours[k], axis);
      visit(particle_of<D>(list.neighbours[k]), wrap);
    }
  });
}

template <int D, class List>
void Continuations<D, List>::append_to(std::vector<Neighbour>& neighbours,
                                       const List& first) const {
  visit_lists(first, [&](const auto& list) {
    const auto begin = list.neighbours.begin();
    neighbours.insert(neighbours.end(), begin, begin + list.count);
  });
}

template <int D, class List>
std::size_t Continuations<D, List>::count(const List& first) const {
  std::size_t count = 0;
  visit_lists(first, [&](const auto& list) { count += list.count; });
  return count;
}

template <int D, class List>
template <class AnyList>
void Continuations<D, List>::append(AnyList& list, Neighbour neighbour) {
  list.neighbours[list.count++] = neighbour;
  list.wraps = list.wraps || neighbour != particle_of<D>(neighbour);
}

template <int D, class List>
void Continuations<D, List>::put_on(List& first, Neighbour neighbour) {
  const auto full = [](const auto& list) { return list.count == list.neighbours.size(); };
  if (!full(first)) return append(first, neighbour);
  std::uint32_t last = kNone, at = first.next;
  for (; at != kNone && full(lists_[at]); at = lists_[at].next) last = at;
  if (at == kNone) {
    at = new_list();
    (last == kNone ? first.next : lists_[last].next) = at;
  }
  append(lists_[at], neighbour);
}

// Index of a neighbour in a list; 0 if it is not there. Compares all entries at once, because a
// branch on the index would be unpredictable.
template <int kCapacity>
std::uint32_t place_of(Neighbour neighbour, const NearList<kCapacity>& list) {
  using Four = std::uint32_t __attribute__((vector_size(16)));
  // The last two words of a list hold no neighbours.
  static_assert(kCapacity % 4 == 2 && sizeof(list) >= (kCapacity + 2) * sizeof(Neighbour));
  Four found{};
  for (std::uint32_t k = 0; k < kCapacity; k += 4) {
    Four four;
    std::memcpy(&four, reinterpret_cast<const char*>(&list) + k * sizeof k, sizeof four);
    const bool last = k + 4 > kCapacity;
    const Four places = {k, k + 1, last ? 0 : k + 2, last ? 0 : k + 3};
    found |= (four == neighbour) & places;
  }
  return (found[0] | found[1]) | (found[2] | found[3]);
}

template <int D, class List>
void Continuations<D, List>::take_off(List& list, Neighbour neighbour) {
  if (list.next != kNone) [[unlikely]]
    return take_off_chain(list, neighbour);
  Neighbour& last = list.neighbours[--list.count];
  list.neighbours[place_of(neighbour, list)] = last;
  last = kNobody;
}

template <int D, class List>
void Continuations<D, List>::take_off_chain(List& first, Neighbour neighbour) {
  Neighbour* place = &first.neighbours[place_of(neighbour, first)];
  bool* wraps = &first.wraps;
  std::uint32_t before_last = kNone, at = first.next;
  for (;; before_last = at, at = lists_[at].next) {
    Neighbour& found = lists_[at].neighbours[place_of(neighbour, lists_[at])];
    if (found == neighbour) {
      place = &found;
      wraps = &lists_[at].wraps;
    }
    if (lists_[at].next == kNone) break;
  }
  Continued& list = lists_[at];
  Neighbour& last = list.neighbours[--list.count];
  *place = last;
  *wraps = *wraps || list.wraps;
  last = kNobody;
  if (list.count > 0) return;
  spare_.push_back(at);
  (before_last == kNone ? first.next : lists_[before_last].next) = kNone;
}

template <int D, class List>
void Continuations<D, List>::clear(List& list) {
  for (std::uint32_t next = list.next; next != kNone; next = lists_[next].next) {
    spare_.push_back(next);
  }
  list = List{};
}

template <int D, class List>
std::uint32_t Continuations<D, List>::new_list() {
  if (spare_.empty()) return append_sparingly(lists_);
  const std::uint32_t list = spare_.back();
  spare_.pop_back();
  lists_[list] = Continued{};
  return list;
}

}  // namespace clatter
