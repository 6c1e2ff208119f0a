// SPDX-License-Identifier: BSD-3-Clause
//
// Answers of predicates by name in failures of tests; beside their types, where GoogleTest looks for it.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/opening/orifice.h>
#include <ostream>

namespace vericone {

inline void PrintTo(Membership m, std::ostream* os) { *os << to_string(m); }
inline void PrintTo(Position p, std::ostream* os) { *os << to_string(p); }
inline void PrintTo(Relation r, std::ostream* os) { *os << to_string(r); }
inline void PrintTo(Transit t, std::ostream* os) { *os << to_string(t); }

}  // namespace vericone
