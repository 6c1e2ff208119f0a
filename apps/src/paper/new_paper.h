// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone::paper {

/// `vericone paper new`: a small paper that works, with comments, in `folder`, which is empty or not there.
/// Returns the exit status. Throws InputError.
int new_paper(const std::string& folder, std::ostream& out);

}  // namespace vericone::paper
