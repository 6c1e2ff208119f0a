// SPDX-License-Identifier: BSD-3-Clause
//
// Files that must be refused, and how.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>

#include <filesystem>
#include <ostream>
#include <string>

#include "geometry/files/written_files.h"

namespace vericone::testing {

/// A file of these bytes, and what the one line about it has to contain.
struct BadFile {
  std::string name, file, bytes, value, requirement;
};

inline void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.name; }

/// `read(path)` must throw an InputError of one line that names the path, the value and what would be right.
template <typename Read>
void expect_refused(const BadFile& bad, Read read) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.write(bad.file, bad.bytes);
  try {
    read(path);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), path.string());
    EXPECT_THAT(error.value(), ::testing::HasSubstr(bad.value));
    EXPECT_THAT(error.requirement(), ::testing::HasSubstr(bad.requirement));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
  }
}

}  // namespace vericone::testing
