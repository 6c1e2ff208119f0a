// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/work/staged_folder.h>
#include <iosfwd>
#include <string>
#include <vector>

#include "json/json_value.h"
#include "output/output_options.h"

namespace vericone {

/// What a command found whose rows are in tables.
struct Results {
  Json summary, origin;              // origin: provenance
  std::vector<const char*> scripts;  // that draw it
  std::string summary_file = "summary.json";
  std::vector<std::string> files;  // that the text names
  std::vector<std::string> old;    // what an earlier run may have left
};

/// Writes summary and provenance, draws, publishes the folder, and tells: the summary as JSON, or `text`, the
/// files and the pictures.
void publish(const Results& found, const OutputOptions& options, work::StagedFolder& folder,
             const std::string& text, std::ostream& out);

}  // namespace vericone
