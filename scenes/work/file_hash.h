// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace vericone {

/// SHA-256 (FIPS 180-4) of a file's bytes, 64 hexadecimal digits, as sha256sum prints it. Throws
/// std::runtime_error naming a file that cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace vericone
