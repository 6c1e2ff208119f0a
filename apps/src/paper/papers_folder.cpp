// SPDX-License-Identifier: BSD-3-Clause
#include "paper/papers_folder.h"

#include <algorithm>
#include <cstdlib>

namespace vericone {

std::filesystem::path papers_folder() {
  if (const char* given = std::getenv("VERICONE_PAPERS")) return given;
  if (std::filesystem::is_directory(VERICONE_PAPERS_FOLDER)) return VERICONE_PAPERS_FOLDER;
  return VERICONE_INSTALLED_PAPERS_FOLDER;
}

std::vector<std::filesystem::path> scenario_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(papers_folder() / "dhal2022" / "scenarios"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace vericone
