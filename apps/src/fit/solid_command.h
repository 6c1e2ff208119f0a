// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <vericone/internal/fitting/solids.h>
#include "fit/fit_command.h"

namespace vericone {

/// Of `--kinds a,b` or `--shape a`: the kinds of solids asked for; none where it is a shape of quadrics.
/// Throws InputError naming the option.
std::vector<fitting::SolidKind> solid_kinds(const FitCommandOptions& given);

/// `vericone fit` with these kinds: as run_fit().
int run_solid_fit(const FitCommandOptions& given, const std::vector<fitting::SolidKind>& kinds,
                  std::ostream& out);

}  // namespace vericone
