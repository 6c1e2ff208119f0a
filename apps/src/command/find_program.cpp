// SPDX-License-Identifier: BSD-3-Clause
#include "command/find_program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "output/shared_folder.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
}

std::vector<fs::path> folders() {
  std::vector<fs::path> list;
  if (const fs::path here = own_folder(); !here.empty()) list = {here, here / VERICONE_PROGRAMS_FROM_HERE};
  if (const char* path = std::getenv("PATH")) {
    std::istringstream text(path);
    for (std::string folder; std::getline(text, folder, ':');)
      if (!folder.empty()) list.emplace_back(folder);
  }
  return list;
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
  // A name, no path and no option.
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), plain)) return std::nullopt;
  for (const fs::path& folder : folders())
    if (const fs::path file = folder / ("vericone-" + name); is_program(file)) return file;
  return std::nullopt;
}

}  // namespace vericone
