// SPDX-License-Identifier: BSD-3-Clause
#include "paper/papers_folder.h"

#include <cstdlib>

namespace vericone {

std::filesystem::path papers_folder() {
  if (const char* given = std::getenv("VERICONE_PAPERS")) return given;
  if (std::filesystem::is_directory(VERICONE_PAPERS_FOLDER)) return VERICONE_PAPERS_FOLDER;
  return VERICONE_INSTALLED_PAPERS_FOLDER;
}

}  // namespace vericone
