// SPDX-License-Identifier: BSD-3-Clause
//
// A command whose results are rows by index, each from the seed and its index alone: so threads, parts
// (--part) or processes (mpi/) compute them, what was interrupted goes on, and the bytes are the same.
#pragma once

#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <sstream>
#include <string>
#include <vector>

#include "json/json_value.h"
#include "output/output_options.h"
#include "work/resumable_table.h"

namespace vericone {

/// What a command found, in a folder.
struct Results {
  Json summary, origin;              // origin: provenance
  std::vector<const char*> scripts;  // that draw it
  std::string summary_file = "summary.json";
  std::vector<std::string> files;  // that the text names
  std::vector<std::string> old;    // what an earlier run may have left
  std::ostringstream text = {};    // printed where no JSON is
  int status = 0;                  // of the command
};

/// Writes summary and provenance, draws, publishes the folder, and tells: the summary as JSON, or the text,
/// the files and the pictures. Returns the exit status.
int publish(const Results& found, const OutputOptions& options, work::StagedFolder& folder,
            std::ostream& out);

struct Job {
  const OutputOptions& options;
  std::vector<std::filesystem::path> inputs;  // files that were read
  struct Table {
    work::ResumableTable rows;  // threads and progress are the job's
    std::string label;          // of the bar on standard error
  };
  std::vector<Table> tables;
};

/// Fills the tables, or the part of them that was asked for. `tell` reads all rows where they stand, at
/// folder.resumable(name), and says what they show; it is not asked of a part. Returns the exit status; 130
/// where an interruption came first, and a line says how to go on. Throws InputError naming the option.
int run_job(Job job, const std::function<void(Results&, work::StagedFolder& folder)>& tell,
            std::ostream& out);

/// From here on `with` is asked of every table that run_job() is to fill, and may give it `rows` that other
/// processes compute (mpi/ranks.h). False where this process has helped another one with the table and has no
/// more to do with it.
void share_rows(std::function<bool(work::ResumableTable&)> with);

}  // namespace vericone
