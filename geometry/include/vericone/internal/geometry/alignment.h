// SPDX-License-Identifier: BSD-3-Clause
//
// Eigen aligns its types as the compiler's options allow: with -march=haswell an Ellipse has 128 bytes,
// without 96. A program compiled otherwise than the library would read past its bodies. Each translation unit
// that knows them therefore asks for a name that only a library compiled alike has, and linking says which is
// missing.
#pragma once

#include <Eigen/Core>

#define VERICONE_JOINED(name, bytes) name##bytes
#define VERICONE_JOIN(name, bytes) VERICONE_JOINED(name, bytes)
#define VERICONE_COMPILED_ALIKE \
  VERICONE_JOIN(library_and_program_need_the_same_EIGEN_MAX_STATIC_ALIGN_BYTES_, EIGEN_MAX_STATIC_ALIGN_BYTES)

namespace vericone {

extern const char VERICONE_COMPILED_ALIKE;
[[gnu::used]] static const char* const kCompiledAlike = &VERICONE_COMPILED_ALIKE;

}  // namespace vericone
