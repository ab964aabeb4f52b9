#include "engine/checkpoint/archive.h"

#include "engine/error.h"

namespace clatter {

void ArchiveReader::refuse() const {
  throw UserError({file_}, "its content does not fit this program",
                  "resume it with the program that wrote it");
}

}  // namespace clatter
