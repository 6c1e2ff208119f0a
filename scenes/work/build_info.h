// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What a program was built from. A file that the build makes defines them, so that a commit compiles it
/// alone.
namespace vericone::build_info {

const char* version();
const char* commit();
const char* flags();

}  // namespace vericone::build_info
