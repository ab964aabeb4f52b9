#pragma once

namespace clatter {

/// Empties a list and frees its memory. The assignment `list = {}` keeps the memory of a vector.
template <typename List>
void free_memory(List& list) {
  List().swap(list);
}

}  // namespace clatter
