// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace vericone::work {

/// Files that appear in a folder all together: they are written to one within it, which is gone again unless
/// publish() was reached. (One beside it could be on another file system, or where nothing may be written.)
/// All commands write their files this way. The folder is made where it is missing, and is gone again where
/// nothing came into it. No other process gets it meanwhile; what killed ones left in it is removed. Those of
/// one process for one folder share it.
class StagedFolder {
 public:
  /// Errors call the folder `field`. Throws InputError naming it where the folder is, or is in, something
  /// that is no folder, cannot be written to, or is being written to by another run.
  explicit StagedFolder(const std::filesystem::path& folder, const std::string& field = "out");
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write, also to folders in it.
  [[nodiscard]] const std::filesystem::path& path() const { return stage_; }
  /// Where a file in path() is once it is published.
  [[nodiscard]] std::filesystem::path published(const std::filesystem::path& file) const;
  /// How errors call the folder.
  [[nodiscard]] const std::string& field() const { return field_; }

  /// Where to write a file that whoever comes after an interruption goes on with: in the folder itself, as
  /// NAME.partial. publish() gives it its name, with the others. Throws InputError where another one of this
  /// process writes it.
  std::filesystem::path resumable(const std::string& name);

  /// Moves what was written to the folder, and removes those files of `names` there that were not written
  /// this time: they tell of an earlier run. Returns where the files are now, by name. Throws InputError,
  /// with nothing moved, where a folder has the name of a file; std::runtime_error where an interruption came
  /// first.
  std::vector<std::filesystem::path> publish(const std::vector<std::string>& names = {});

  /// Gives up what was not published. Publishing after that throws InputError.
  void abandon();

 private:
  struct Held;  // shared by all of this process for one folder
  friend void abandon_output();
  void require_held() const;

  std::filesystem::path folder_, stage_;
  std::string field_;
  std::vector<std::string> resumable_;
  std::shared_ptr<Held> held_;
};

/// What it takes to get the same result again, as JSON: commit, version, compiler, flags, processor, the
/// command or call; how many threads computed, and each file that was read, with its SHA-256 (null where it
/// cannot be read again). As the commands write it to provenance.json.
[[nodiscard]] std::string provenance(const std::string& command_line, int threads,
                                     const std::vector<std::filesystem::path>& inputs);

}  // namespace vericone::work
