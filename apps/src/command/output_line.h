// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command/command_line.h"
#include "output/output_options.h"

namespace vericone {

/// Declares --part.
inline void part_option(CommandLine& line, std::string& part,
                        const std::string& what = "rows alone; vericone merge puts all N together") {
  line.option("--part", part, "The K-th of N parts of the " + what).shown_type("K/N");
}

/// Declares what all commands are told that write tables and pictures, the last in their help; reads the
/// line, and keeps its words. `usual`: the folder, where it is chosen once the line is read; without any one
/// has to be given.
inline void read_files_line(CommandLine& line, OutputOptions& options, const std::string& usual = "") {
  auto out = line.option("--out", options.out, "Folder for tables and pictures");
  if (!usual.empty())
    out.shown_default(usual);
  else if (options.out.empty())
    out.required();
  line.negative_flag("--no-figures", options.figures, "Tables only");
  line.flag("--quiet", options.quiet, "No progress");
  line.flag("--json", options.json, "Print JSON");
  line.read();
  options.command_line = line.text();
  options.words = line.words();
}

/// The same of a command with threads.
inline void read_output_line(CommandLine& line, OutputOptions& options, const std::string& usual = "") {
  line.option("--threads", options.threads, "Threads, 0: one per processor");
  read_files_line(line, options, usual);
}

/// The same of a command whose results are the rows of a job (job/job.h): also --part and --rows.
inline void read_job_line(CommandLine& line, OutputOptions& options, const std::string& usual = "") {
  part_option(line, options.part);
  line.option("--rows", options.rows,
              "Of the rows what is kept: none, sample:N of them, or all in FILE, .csv or .h5 (HDF5)")
      .shown_default("the table");
  read_output_line(line, options, usual);
}

}  // namespace vericone
