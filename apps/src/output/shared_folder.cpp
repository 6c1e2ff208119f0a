// SPDX-License-Identifier: BSD-3-Clause
#include "output/shared_folder.h"

#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace vericone {

namespace fs = std::filesystem;

fs::path own_program() {
  if (const char* given = std::getenv("VERICONE_PROGRAM")) return given;
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path own_folder() { return own_program().parent_path(); }

fs::path shared_folder(const std::string& name) {
  const fs::path here = own_folder(), end = here.root_path();
  for (fs::path folder = here; folder != end; folder = folder.parent_path())
    if (const fs::path found = folder / "share/vericone" / name; fs::is_directory(found))
      return fs::canonical(found);
  throw std::runtime_error("share/vericone/" + name + " is not there in any folder above " + here.string());
}

}  // namespace vericone
