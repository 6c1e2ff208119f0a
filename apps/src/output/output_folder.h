// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace vericone {

/// A folder that this process writes to. It is made where it is missing, and is gone again where nothing came
/// into it. No other process gets it meanwhile; what killed ones left in it is removed.
class OutputFolder {
 public:
  /// Throws InputError naming `option` where the folder is, or is in, something that is no folder, cannot be
  /// written to, or is being written to by another run.
  OutputFolder(const std::filesystem::path& folder, const std::string& option);

  const std::filesystem::path& path() const { return path_; }
  /// Of the folder that StagedFolder makes in it for files that are not finished.
  std::filesystem::path stage() const;

 private:
  friend void abandon_output();
  struct Held;  // shared by all objects for one folder
  std::filesystem::path path_;
  std::shared_ptr<Held> held_;
};

/// Held while files appear in a folder, so that an interruption finds all of them or none.
std::mutex& appearing();

/// Removes the unfinished files of all folders that are held. The process must end after that.
void abandon_output();

}  // namespace vericone
