// SPDX-License-Identifier: BSD-3-Clause
#include "paper/papers_folder.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cstdlib>

#include "output/shared_folder.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;

fs::path our_papers() {
  if (const char* given = std::getenv("VERICONE_PAPERS")) return given;
  return shared_folder("papers");
}

}  // namespace

fs::path paper_folder(const std::string& given) {
  for (const fs::path& folder : {fs::path(given), our_papers() / (given.empty() ? "dhal2022" : given)})
    if (!folder.empty() && (fs::exists(folder / "figures.yaml") || fs::exists(folder / "claims.yaml")))
      return folder;
  throw InputError("--paper", given.empty() ? "dhal2022" : given,
                   "a folder with figures.yaml and claims.yaml, or the name of one of ours");
}

fs::path template_folder() { return our_papers() / "template"; }

std::vector<fs::path> files_of(const fs::path& paper) {
  std::vector<fs::path> files;
  for (const char* name : {"figures.yaml", "claims.yaml"})
    if (fs::exists(paper / name)) files.push_back(paper / name);
  if (fs::is_directory(paper / "scenarios"))
    for (const auto& entry : fs::directory_iterator(paper / "scenarios"))
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace vericone::paper
