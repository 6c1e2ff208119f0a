// SPDX-License-Identifier: BSD-3-Clause
//
// The words of all answers about two bodies and a relative velocity w = v_agent - v_obstacle. Zero is the one
// that lets a body fly on, disjoint or `out`, and nothing else is: an answer taken for a truth value, as
// arrays of numpy do, errs on the safe side.
#pragma once

#include <cstdint>
#include <limits>

namespace vericone {

/// The part of the future that is asked about, both ends included.
struct Horizon {
  double from = 0, until = std::numeric_limits<double>::infinity();  // s; 0 <= from <= until
};

/// How two solid bodies lie. One inside the other counts as overlapping, touching from inside too.
enum class Relation : std::uint8_t { disjoint, touching, overlapping };

/// Where a relative velocity lies with regard to the closed collision cone of two bodies.
enum class Membership : std::uint8_t {
  out,  // they never meet, w = 0 included; touching bodies that part
  on,   // boundary: they will touch without overlapping
  in,   // interior: they will overlap, or do so now
};

/// The same with the past told from never: where the line of motion meets the other body.
enum class Passage : std::uint8_t {
  ahead,           // they will overlap: `in`
  ahead_grazing,   // they will touch: `on`
  never,           // the line misses, or w = 0
  behind_grazing,  // moving backwards they would touch
  behind,          // moving backwards they would overlap
};

/// Whole answer of one engagement. `undecided` of certified families alone: the truth is one of the others.
enum class Verdict : std::uint8_t { out, on, in, touching, overlapping, undecided };

/// Whether two bodies may be in contact now or later: all but `out`. What is not decided counts as yes.
[[nodiscard]] constexpr bool may_collide(Verdict verdict) { return verdict != Verdict::out; }

/// What is known about a direction at the tolerance asked for.
enum class Certified : std::uint8_t { out, in, undecided };

[[nodiscard]] const char* to_string(Relation relation);
[[nodiscard]] const char* to_string(Membership membership);
[[nodiscard]] const char* to_string(Passage passage);
[[nodiscard]] const char* to_string(Verdict verdict);
[[nodiscard]] const char* to_string(Certified answer);

}  // namespace vericone
