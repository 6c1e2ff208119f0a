// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/fitting/fit.h>
#include <iosfwd>

#include <vericone/fits/fit_files.h>

namespace vericone::fit {

/// The table of `vericone fit`. `seconds`: the fit with its proof.
void print_fit(const fits::Scan& scan, const fitting::FitResult& result, double seconds, std::ostream& out);

}  // namespace vericone::fit
