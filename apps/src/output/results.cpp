// SPDX-License-Identifier: BSD-3-Clause
#include "output/results.h"

#include <ostream>

#include "output/figures.h"
#include "output/output_file.h"

namespace vericone {

void publish(const Results& found, const OutputOptions& options, work::StagedFolder& folder,
             const std::string& text, std::ostream& out) {
  write_whole(folder.path() / found.summary_file, found.summary.dump(1) + "\n");
  write_whole(folder.path() / "provenance.json", found.origin.dump(1) + "\n");
  if (options.figures)
    for (const char* script : found.scripts) draw_figures(script, folder.path());
  const std::vector<std::filesystem::path> files = folder.publish(found.old);
  if (options.json) {
    out << found.summary.dump(1) << '\n';
    return;
  }
  out << text << "tables    ";
  const std::filesystem::path shown = options.out;
  for (std::size_t i = 0; i < found.files.size(); ++i)
    out << (i ? ", " : "") << (shown / found.files[i]).string();
  out << '\n';
  for (const auto& picture : pictures_of(files)) out << "picture   " << picture.string() << '\n';
}

}  // namespace vericone
