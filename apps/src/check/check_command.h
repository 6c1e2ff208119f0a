// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

/// `vericone check`: what a scene, a scenario, a file with a body, or figures or claims of a paper mean, in
/// plain words, or the first thing that is wrong with it. Nothing is computed but what the bodies are and how
/// far apart they stand. As text, or as JSON: a list of label and text.
int run_check(const std::string& file, bool json, std::ostream& out);

}  // namespace vericone
