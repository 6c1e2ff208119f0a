// SPDX-License-Identifier: BSD-3-Clause
#include "paper/new_paper.h"

#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <ostream>

#include "output/output_file.h"
#include "paper/papers_folder.h"

namespace vericone::paper {

namespace fs = std::filesystem;

int new_paper(const std::string& folder, std::ostream& out) {
  std::error_code error;
  if (fs::exists(folder) && (!fs::is_directory(folder) || !fs::is_empty(folder, error)))
    throw InputError("folder", folder, "a folder that is empty or not there: a new paper overwrites nothing");
  work::StagedFolder stage(folder, "folder");
  for (const auto& entry : fs::recursive_directory_iterator(template_folder())) {
    const fs::path to = stage.path() / entry.path().lexically_relative(template_folder());
    if (entry.is_directory()) {
      fs::create_directories(to);
      continue;
    }
    write_whole(to, content_of(entry.path()));
  }
  stage.publish({});
  const std::string place = fs::path(folder).string();
  out << "paper               " << place << ": README.md says what to change\n"
      << "next                vericone figures --paper " << place << '\n';
  return 0;
}

}  // namespace vericone::paper
