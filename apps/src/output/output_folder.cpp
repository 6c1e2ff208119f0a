// SPDX-License-Identifier: BSD-3-Clause
#include "output/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <vericone/geometry/error.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <system_error>
#include <vector>

namespace vericone {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStage = ".partial-";  // and the number of the process

bool is_stage(const fs::path& path) {
  const std::string name = path.filename().string(), start = kStage;
  return name.starts_with(start) && name.size() > start.size() &&
         name.find_first_not_of("0123456789", start.size()) == std::string::npos;
}

}  // namespace

struct OutputFolder::Held {
  fs::path folder;
  std::vector<fs::path> made;  // from the outermost on
  int lock = -1;

  ~Held() {
    clear();
    if (lock >= 0) close(lock);
  }

  void clear() const {
    std::error_code ignored;
    // By another name, so that whoever is still writing there finds it gone and adds nothing meanwhile.
    const fs::path stage = folder / (kStage + std::to_string(getpid())), gone = stage.string() + "0";
    fs::rename(stage, gone, ignored);
    // A file that was just being made may appear once more after its folder was listed.
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
      fs::remove_all(gone, ignored);
      if (!fs::exists(gone, ignored)) break;
    }
    // Only where nothing is in them.
    for (auto path = made.rbegin(); path != made.rend(); ++path) fs::remove(*path, ignored);
  }

  void make(const std::string& option, const std::string& given) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path above = folder; !fs::exists(above, ignored); above = above.parent_path())
      missing.push_back(above);
    std::reverse(missing.begin(), missing.end());
    for (const fs::path& path : missing) {
      std::error_code error;
      if (fs::create_directory(path, error)) made.push_back(path);
      if (error) {
        clear();
        refuse(option, given, error.value());
      }
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(option, given, errno);
  }

  void take(const std::string& option, const std::string& given) {
    lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock < 0) return;
    if (flock(lock, LOCK_EX | LOCK_NB) == 0) {
      // Nobody else is at work here: what is unfinished was left by a process that was killed.
      std::error_code ignored;
      std::vector<fs::path> left;
      for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (is_stage(entry.path())) left.push_back(entry.path());
      for (const fs::path& path : left) fs::remove_all(path, ignored);
    } else if (errno == EWOULDBLOCK) {
      throw InputError(option, given, "a folder that no other run is writing to");
    }  // Some file systems have no locks.
  }

  [[noreturn]] static void refuse(const std::string& option, const std::string& given, int error) {
    throw InputError(option, given,
                     "a folder that can be written to; " + std::generic_category().message(error));
  }

  static std::map<fs::path, std::weak_ptr<Held>>& all() {
    static std::map<fs::path, std::weak_ptr<Held>> folders;
    return folders;
  }
};

OutputFolder::OutputFolder(const fs::path& folder, const std::string& option)
    : path_(folder.lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();
  if (folder.empty() || path_.empty()) throw InputError(option, "nothing", "a folder");
  for (fs::path above = path_; !above.empty() && above != above.root_path(); above = above.parent_path()) {
    std::error_code ignored;
    if (fs::is_directory(above, ignored)) break;
    if (fs::exists(above, ignored))
      throw InputError(option, folder.string(), "a folder; " + above.string() + " is a file");
    if (fs::is_symlink(above, ignored))
      throw InputError(option, folder.string(), "a folder; " + above.string() + " is a link to nothing");
  }
  const std::lock_guard guard(appearing());
  const fs::path whole = fs::weakly_canonical(fs::absolute(path_));
  std::weak_ptr<Held>& known = Held::all()[whole];
  held_ = known.lock();
  if (held_) return;
  held_ = std::make_shared<Held>();
  held_->folder = whole;
  held_->make(option, folder.string());
  held_->take(option, folder.string());
  known = held_;
}

fs::path OutputFolder::stage() const { return path_ / (kStage + std::to_string(getpid())); }

std::mutex& appearing() {
  static std::mutex mutex;
  return mutex;
}

void abandon_output() {
  for (const auto& [path, held] : OutputFolder::Held::all())
    if (const auto folder = held.lock()) folder->clear();
}

}  // namespace vericone
