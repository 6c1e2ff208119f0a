// SPDX-License-Identifier: BSD-3-Clause
#include "staged_folder.h"

#include <unistd.h>

#include <vericone/geometry/error.h>
#include <algorithm>

namespace vericone {

namespace fs = std::filesystem;

StagedFolder::StagedFolder(const fs::path& folder, const std::string& option)
    : folder_(folder.lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  if (folder_.empty()) throw InputError(option, "nothing", "a folder");
  for (fs::path above = folder_; !above.empty(); above = above.parent_path()) {
    if (fs::is_directory(above)) break;
    if (fs::exists(above))
      throw InputError(option, folder.string(), "a folder; " + above.string() + " is a file");
  }
  stage_ = folder_ == "." ? fs::current_path() : folder_;
  stage_ += ".partial-" + std::to_string(getpid());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

const fs::path& StagedFolder::path() {
  fs::create_directories(stage_);
  return stage_;
}

std::vector<fs::path> StagedFolder::publish(const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  fs::create_directories(folder_);
  for (const std::string& name : names)
    if (std::none_of(files.begin(), files.end(), [&](const fs::path& f) { return f.filename() == name; }))
      fs::remove(folder_ / name);
  for (fs::path& file : files) {
    fs::rename(file, folder_ / file.filename());
    file = folder_ / file.filename();
  }
  return files;
}

}  // namespace vericone
