// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone {

struct ChildOutput {
  int status = -1;  // exit status; -1: ended by a signal
  std::string output, errors;
};
inline constexpr int kNotStarted = 127;  // exit status where the program is not there

/// Runs a program and waits for it; it ends with us. `folder`: where it runs; empty: here. Throws
/// std::runtime_error where no process can be had.
ChildOutput run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder = {});

/// The last line that is not empty.
std::string last_line(const std::string& text);

}  // namespace vericone
