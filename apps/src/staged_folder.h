// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output_folder.h"

namespace vericone {

/// Files that appear in a folder all together: they are written to one within it, which is gone again unless
/// publish() was reached. (One beside it could be on another file system, or where nothing may be written.)
class StagedFolder {
 public:
  /// `folder` need not exist. Throws InputError as OutputFolder does.
  StagedFolder(const std::filesystem::path& folder, const std::string& option);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return stage_; }

  /// Moves what was written to the folder, and removes those files of `names` there that were not written
  /// this time: they tell of an earlier run. Returns where the files are now, by name. Throws InputError,
  /// with nothing moved, where a folder has the name of a file.
  std::vector<std::filesystem::path> publish(const std::vector<std::string>& names);

 private:
  OutputFolder folder_;
  std::string option_;
  std::filesystem::path stage_;
};

}  // namespace vericone
