// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <string>

#include "commands.h"
#include "output/output_file.h"
#include "paper/papers_folder.h"

namespace vericone::paper {
namespace {

namespace fs = std::filesystem;

/// `vericone paper new`: a small paper that works, with comments, in `folder`, which is empty or not there.
/// Returns the exit status. Throws InputError.
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

}  // namespace

}  // namespace vericone::paper

namespace vericone {

int paper_command(CommandLine& line) {
  std::string what, folder;
  line.option("what", what, "new: a small paper that works, to begin with (docs/reference/papers.md)")
      .required();
  line.option("folder", folder, "Where it is to be: a folder that is empty or not there").required();
  line.quiet();
  line.read();
  if (what != "new")
    throw UsageError("paper: " + what + " is not known, new DIR is; see vericone paper --help");
  return paper::new_paper(folder, std::cout);
}

}  // namespace vericone
