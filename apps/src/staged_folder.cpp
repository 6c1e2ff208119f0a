// SPDX-License-Identifier: BSD-3-Clause
#include "staged_folder.h"

#include <vericone/geometry/error.h>
#include <algorithm>

#include "output_file.h"

namespace vericone {

namespace fs = std::filesystem;

StagedFolder::StagedFolder(const fs::path& folder, const std::string& option)
    : folder_(folder, option), option_(option), stage_(folder_.stage()) {
  std::error_code error;
  fs::create_directory(stage_, error);
  if (error) throw InputError(option, folder.string(), "a folder that can be written to; " + error.message());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

std::vector<fs::path> StagedFolder::publish(const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(stage_)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const auto target = [&](const fs::path& file) { return folder_.path() / file.filename(); };
  for (const fs::path& file : files) {
    if (fs::is_directory(target(file)) && !fs::is_directory(file))
      throw InputError(
          option_, folder_.path().string(),
          "a folder without one in it called " + file.filename().string() + ", which is to be a file");
    sync_to_disk(file);
  }
  const std::lock_guard guard(appearing());
  for (const std::string& name : names)
    if (std::none_of(files.begin(), files.end(), [&](const fs::path& f) { return f.filename() == name; }) &&
        !fs::is_directory(folder_.path() / name))
      fs::remove(folder_.path() / name);
  for (fs::path& file : files) {
    fs::rename(file, target(file));
    file = target(file);
  }
  sync_to_disk(folder_.path());
  return files;
}

}  // namespace vericone
