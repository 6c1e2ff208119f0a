// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone {

/// Files that appear in a folder all together: they are written to one beside it, which is gone again unless
/// publish() was reached.
class StagedFolder {
 public:
  /// `folder` need not exist. Throws InputError naming `option` where it is, or is in, something that is no
  /// folder.
  StagedFolder(const std::filesystem::path& folder, const std::string& option);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write; made at the first call.
  const std::filesystem::path& path();

  /// Moves what was written to the folder, and removes those files of `names` there that were not written
  /// this time: they tell of an earlier run. Returns where the files are now, by name.
  std::vector<std::filesystem::path> publish(const std::vector<std::string>& names);

 private:
  std::filesystem::path folder_, stage_;
};

}  // namespace vericone
