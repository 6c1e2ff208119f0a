// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/triangle_mesh.h>
#include <vericone/geometry/integer.h>
#include <vericone/geometry/tracked.h>

#include <optional>

namespace vericone::files {
namespace {

/// Twice the area of the projected triangle: one component of (b - a) x (c - a), number i the one without the
/// coordinate i.
template <typename T>
constexpr T projected_area(const std::array<T, 3>& a, const std::array<T, 3>& b, const std::array<T, 3>& c,
                           std::size_t i) {
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  return (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
}

template <typename T, typename Make>
std::array<T, 3> coordinates(const Eigen::Vector3d& p, const Make& make) {
  return {make(p.x()), make(p.y()), make(p.z())};
}

/// False where certainly not; nothing where it is not certain.
std::optional<bool> triage_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     const Eigen::Vector3d& c) {
  constexpr RoundingCount kCount = projected_area<RoundingCount>({}, {}, {}, 0);
  // Two products lose half of the least number each, and so do their magnitudes.
  constexpr double kUnderflow = 0x1p-1072;
  const auto make = [](double x) { return Tracked::of(x); };
  const auto ta = coordinates<Tracked>(a, make), tb = coordinates<Tracked>(b, make),
             tc = coordinates<Tracked>(c, make);
  for (std::size_t i = 0; i < 3; ++i)
    if (projected_area(ta, tb, tc, i).certain(kCount, kUnderflow) != 0) return false;
  return std::nullopt;
}

bool exact_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr int kNone = 1 << 20;
  int e = kNone;
  for (const auto* p : {&a, &b, &c})
    for (const double x : *p) e = std::min(e, exact::grid_exponent(x, kNone));
  const auto make = [e](double x) { return exact::on_grid(x, e); };
  const auto ia = coordinates<exact::Integer>(a, make), ib = coordinates<exact::Integer>(b, make),
             ic = coordinates<exact::Integer>(c, make);
  for (std::size_t i = 0; i < 3; ++i)
    if (projected_area(ia, ib, ic, i) != 0) return false;
  return true;
}

}  // namespace

bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  if (a == b || b == c || c == a) return true;
  if (const auto answer = triage_collinear(a, b, c)) return *answer;
  return exact_collinear(a, b, c);
}

}  // namespace vericone::files
