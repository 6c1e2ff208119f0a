// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>

#include "output/output_file.h"
#include "work/abandon.h"
#include "work/interrupt.h"

namespace vericone::work {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStage = ".partial-";  // and numbers

bool is_stage(const fs::path& path) {
  const std::string name = path.filename().string(), start = kStage;
  return name.starts_with(start) && name.size() > start.size() &&
         name.find_first_not_of("0123456789-", start.size()) == std::string::npos;
}

/// As given, without a slash at its end.
fs::path folder_of(const fs::path& given, const std::string& field) {
  fs::path path = given.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (given.empty() || path.empty()) throw InputError(field, "nothing", "a folder");
  for (fs::path above = path; !above.empty() && above != above.root_path(); above = above.parent_path()) {
    std::error_code ignored;
    if (fs::is_directory(above, ignored)) break;
    if (fs::exists(above, ignored))
      throw InputError(field, given.string(), "a folder; " + above.string() + " is a file");
    if (fs::is_symlink(above, ignored))
      throw InputError(field, given.string(), "a folder; " + above.string() + " is a link to nothing");
  }
  return path;
}

}  // namespace

/// A folder that this process writes to.
struct StagedFolder::Held {
  fs::path folder;
  std::vector<fs::path> made;              // from the outermost on
  std::set<std::string> names, resumable;  // of stages, of files that are being gone on with
  unsigned stages = 0;                     // ever
  int lock = -1;

  ~Held() {
    clear();
    if (lock < 0) return;
    flock(lock, LOCK_UN);  // processes forked meanwhile, as by an executor of Python, have it open too
    close(lock);
  }

  void clear() const {
    for (const std::string& name : names) remove(name);
    // Only where nothing is in them.
    std::error_code ignored;
    for (auto path = made.rbegin(); path != made.rend(); ++path) fs::remove(*path, ignored);
  }

  void remove(const std::string& name) const {
    std::error_code ignored;
    // By another name, so that whoever is still writing there finds it gone and adds nothing meanwhile.
    const fs::path gone = folder / (name + "-0");
    fs::rename(folder / name, gone, ignored);
    // A file that was just being made may appear once more after its folder was listed.
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
      fs::remove_all(gone, ignored);
      if (!fs::exists(gone, ignored)) break;
    }
  }

  void make(const std::string& field, const std::string& given) {
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
        refuse(field, given, error.value());
      }
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(field, given, errno);
  }

  void take(const std::string& field, const std::string& given) {
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
      refuse_shared(field, given);
    }  // Some file systems have no locks.
  }

  [[noreturn]] static void refuse(const std::string& field, const std::string& given, int error) {
    throw InputError(field, given,
                     "a folder that can be written to; " + std::generic_category().message(error));
  }
  [[noreturn]] static void refuse_shared(const std::string& field, const std::string& given) {
    throw InputError(field, given, "a folder that no other run is writing to");
  }

  static std::map<fs::path, std::weak_ptr<Held>>& all() {
    static std::map<fs::path, std::weak_ptr<Held>> folders;
    return folders;
  }

  /// With appearing() held.
  static std::shared_ptr<Held> of(const fs::path& folder, const std::string& field,
                                  const std::string& given) {
    const fs::path whole = fs::weakly_canonical(fs::absolute(folder));
    std::weak_ptr<Held>& known = all()[whole];
    if (auto held = known.lock()) return held;
    auto held = std::make_shared<Held>();
    held->folder = whole;
    held->make(field, given);
    held->take(field, given);
    known = held;
    return held;
  }
};

std::mutex& appearing() {
  static std::mutex mutex;
  return mutex;
}

void abandon_output() {
  for (const auto& [path, held] : StagedFolder::Held::all())
    if (const auto folder = held.lock()) folder->clear();
}

StagedFolder::StagedFolder(const fs::path& folder, const std::string& field)
    : folder_(folder_of(folder, field)), field_(field) {
  const std::lock_guard guard(appearing());  // none appears once an interruption has removed them
  held_ = Held::of(folder_, field, folder.string());
  stage_ = folder_ / (kStage + std::to_string(getpid()) + "-" + std::to_string(++held_->stages));
  std::error_code error;
  fs::create_directory(stage_, error);
  if (error) throw InputError(field, folder.string(), "a folder that can be written to; " + error.message());
  held_->names.insert(stage_.filename());
}

StagedFolder::~StagedFolder() { abandon(); }

void StagedFolder::abandon() {
  if (!held_) return;
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
  const std::lock_guard guard(appearing());
  held_->names.erase(stage_.filename());
  for (const std::string& file : resumable_) held_->resumable.erase(file);
  held_.reset();
}

void StagedFolder::require_held() const {
  if (!held_) throw InputError(field_, folder_.string() + ", abandoned", "a folder that was not");
}

fs::path StagedFolder::published(const fs::path& file) const {
  return folder_ / file.lexically_relative(stage_);
}

fs::path StagedFolder::resumable(const std::string& name) {
  require_held();
  const std::lock_guard guard(appearing());
  if (std::find(resumable_.begin(), resumable_.end(), name) == resumable_.end()) {
    if (!held_->resumable.insert(name).second) Held::refuse_shared(field_, folder_.string());
    resumable_.push_back(name);
  }
  return folder_ / (name + ".partial");
}

std::vector<fs::path> StagedFolder::publish(const std::vector<std::string>& names) {
  require_held();
  std::map<fs::path, fs::path> moves;  // to, from
  for (const auto& entry : fs::recursive_directory_iterator(stage_))
    if (!entry.is_directory()) moves.emplace(published(entry.path()), entry.path());
  for (const std::string& file : resumable_)
    if (const fs::path from = folder_ / (file + ".partial"); fs::exists(from))
      moves.emplace(folder_ / file, from);
  std::set<fs::path> folders{folder_};
  for (const auto& [to, from] : moves) {
    if (fs::is_directory(to))
      throw InputError(
          field_, folder_.string(),
          "a folder without one in it called " + to.filename().string() + ", which is to be a file");
    const fs::path parent = to.parent_path();
    if (fs::exists(parent) && !fs::is_directory(parent))
      throw InputError(
          field_, folder_.string(),
          "a folder without a file in it called " + parent.filename().string() + ", which is to be a folder");
    folders.insert(parent);
    sync_to_disk(from);
  }
  const std::lock_guard guard(appearing());
  if (interrupted()) throw std::runtime_error("interrupted");
  for (const std::string& name : names)
    if (const fs::path old = folder_ / name; !moves.contains(old) && !fs::is_directory(old)) fs::remove(old);
  std::vector<fs::path> files;
  for (const fs::path& folder : folders) fs::create_directories(folder);
  for (const auto& [to, from] : moves) {
    fs::rename(from, to);
    files.push_back(to);
  }
  for (const fs::path& folder : folders) sync_to_disk(folder);
  return files;
}

}  // namespace vericone::work
