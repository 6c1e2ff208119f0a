// SPDX-License-Identifier: BSD-3-Clause
#include "output/staged_folder.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <set>
#include <stdexcept>

#include "output/interrupt.h"
#include "output/output_file.h"

namespace vericone {

namespace fs = std::filesystem;

StagedFolder::StagedFolder(const fs::path& folder, const std::string& option)
    : folder_(folder, option), option_(option), stage_(folder_.stage()) {
  std::error_code error;
  const std::lock_guard guard(appearing());  // none appears once an interruption has removed them
  fs::create_directory(stage_, error);
  if (error) throw InputError(option, folder.string(), "a folder that can be written to; " + error.message());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

fs::path StagedFolder::published(const fs::path& file) const {
  return folder_.path() / file.lexically_relative(stage_);
}

fs::path StagedFolder::resumable(const std::string& name) {
  if (std::find(resumable_.begin(), resumable_.end(), name) == resumable_.end()) resumable_.push_back(name);
  return folder_.path() / (name + ".partial");
}

std::vector<StagedFolder::Move> StagedFolder::moves() const {
  std::vector<Move> all;
  for (const auto& entry : fs::recursive_directory_iterator(stage_))
    if (!entry.is_directory()) all.push_back({entry.path(), published(entry.path())});
  for (const std::string& name : resumable_)
    if (const fs::path to = folder_.path() / name; fs::exists(to.string() + ".partial"))
      all.push_back({to.string() + ".partial", to});
  std::sort(all.begin(), all.end(), [](const Move& a, const Move& b) { return a.to < b.to; });
  return all;
}

std::vector<fs::path> StagedFolder::publish(const std::vector<std::string>& names) {
  const std::vector<Move> all = moves();
  std::set<fs::path> folders{folder_.path()};
  for (const Move& move : all) {
    if (fs::is_directory(move.to))
      throw InputError(
          option_, folder_.path().string(),
          "a folder without one in it called " + move.to.filename().string() + ", which is to be a file");
    const fs::path parent = move.to.parent_path();
    if (fs::exists(parent) && !fs::is_directory(parent))
      throw InputError(
          option_, folder_.path().string(),
          "a folder without a file in it called " + parent.filename().string() + ", which is to be a folder");
    folders.insert(parent);
    sync_to_disk(move.from);
  }
  const std::lock_guard guard(appearing());
  if (interrupted()) throw std::runtime_error("interrupted");
  for (const std::string& name : names) {
    const fs::path old = folder_.path() / name;
    if (std::none_of(all.begin(), all.end(), [&](const Move& move) { return move.to == old; }) &&
        !fs::is_directory(old))
      fs::remove(old);
  }
  std::vector<fs::path> files;
  for (const fs::path& folder : folders) fs::create_directories(folder);
  for (const Move& move : all) {
    fs::rename(move.from, move.to);
    files.push_back(move.to);
  }
  for (const fs::path& folder : folders) sync_to_disk(folder);
  return files;
}

}  // namespace vericone
