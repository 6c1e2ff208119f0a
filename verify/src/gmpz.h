// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integers as CGAL's quadratic programs take them.
#pragma once

#include <CGAL/Gmpz.h>

#include "predicates/algebra.h"

namespace vericone::verify {

inline CGAL::Gmpz gmpz(const algebra::Integer& x) { return CGAL::Gmpz(x.get_mpz_t()); }

}  // namespace vericone::verify
