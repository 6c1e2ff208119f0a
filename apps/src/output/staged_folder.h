// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/output_folder.h"

namespace vericone {

/// Files that appear in a folder all together: they are written to one within it, which is gone again unless
/// publish() was reached. (One beside it could be on another file system, or where nothing may be written.)
/// All commands write their files this way.
class StagedFolder {
 public:
  /// `folder` need not exist. Throws InputError as OutputFolder does.
  StagedFolder(const std::filesystem::path& folder, const std::string& option);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write, also to folders in it.
  const std::filesystem::path& path() const { return stage_; }
  /// Where a file in path() is once it is published.
  std::filesystem::path published(const std::filesystem::path& file) const;

  /// Where to write a file that whoever comes after an interruption goes on with: in the folder itself, as
  /// NAME.partial. publish() gives it its name, with the others.
  std::filesystem::path resumable(const std::string& name);

  /// Moves what was written to the folder, and removes those files of `names` there that were not written
  /// this time: they tell of an earlier run. Returns where the files are now, by name. Throws InputError,
  /// with nothing moved, where a folder has the name of a file; std::runtime_error where an interruption came
  /// first.
  std::vector<std::filesystem::path> publish(const std::vector<std::string>& names);

 private:
  struct Move {
    std::filesystem::path from, to;
  };
  std::vector<Move> moves() const;

  OutputFolder folder_;
  std::string option_;
  std::filesystem::path stage_;
  std::vector<std::string> resumable_;
};

}  // namespace vericone
