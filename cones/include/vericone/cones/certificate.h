// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict, in a form that a program checks which knows nothing of this library
// (docs/reference/certificates.md).
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/uncertain/robust.h>
#include <string>

namespace vericone {

/// What Pair::certificate() gives: a claim, the bodies and velocities that it is about with all their digits,
/// and its proof.
struct Certificate {
  std::string text;    // one JSON object, on one line; empty where there is none
  std::string reason;  // why there is none; empty where there is one
};

}  // namespace vericone
