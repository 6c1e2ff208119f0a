// SPDX-License-Identifier: BSD-3-Clause
#include "round/root_sum.h"

#include <cmath>

namespace vericone::round {

Integer floor_root(const Integer& x) {
  if (x <= 0) return 0;
  const auto bits = static_cast<int>(msb(x)) + 1;
  // From the leading digits, rounded up: Newton's steps then fall towards the root and stop at its floor.
  const int drop = bits > 62 ? (bits - 61) / 2 * 2 : 0;
  const auto top = static_cast<double>(static_cast<std::int64_t>(Integer(x >> static_cast<unsigned>(drop))));
  Integer r = (Integer(static_cast<std::int64_t>(std::sqrt(top) * (1 + 0x1p-50))) + 1)
              << static_cast<unsigned>(drop / 2);
  for (;;) {
    Integer next = (r + x / r) >> 1;
    if (next >= r) return r;
    r = std::move(next);
  }
}

std::optional<Integer> whole_root(const Integer& x) {
  // 12 of 64 remainders are those of squares.
  constexpr std::uint64_t kSquares = 0x0202021202030213;
  if (x < 0) return std::nullopt;
  if (!(kSquares >> static_cast<unsigned>(Integer(x & 63)) & 1)) return std::nullopt;
  Integer r = floor_root(x);
  if (r * r != x) return std::nullopt;
  return r;
}

Range enclose_root(const Integer& x, unsigned bits) {
  const Integer scaled = x << (2 * bits);
  Integer r = floor_root(scaled);
  const bool whole = r * r == scaled;
  return {r, whole ? r : Integer(r + 1)};
}

Range enclose(const RootSum& sum, unsigned bits) {
  const Integer whole = sum.whole << bits;
  Range r{whole, whole};
  for (const Integer& x : sum.squares) r += enclose_root(x, bits);
  return r;
}

int sign(const RootSum& sum) {
  // A sum of whole roots is enclosed by a single number before any digit is added.
  for (unsigned bits = 0;; bits = bits == 0 ? 64 : 2 * bits) {
    const Range r = enclose(sum, bits);
    if (r.lo > 0) return 1;
    if (r.hi < 0) return -1;
    if (r.lo == r.hi) return 0;
  }
}

}  // namespace vericone::round
