// SPDX-License-Identifier: BSD-3-Clause
//
// Small files written by the tests of the readers.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace vericone::testing {

/// A directory that goes away with the test.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    static int count = 0;
    path_ = std::filesystem::path(::testing::TempDir()) /
            ("vericone_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    // A new file: writing over one may wait for the disk (ext4), which takes a hundred times as long.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The bytes of x in the given order.
template <typename T>
std::string bytes_of(T x, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &x, sizeof x);
  if (order != std::endian::native) std::ranges::reverse(raw);
  return {raw.begin(), raw.end()};
}

}  // namespace vericone::testing
