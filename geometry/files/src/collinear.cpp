// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/files/files.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/geometry/tracked.h>

#include <cmath>
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

/// x - y where that is a double.
std::optional<double> exact_difference(double x, double y) {
  // The error of the rounded difference is a double itself (Knuth), unless something overflows.
  const double d = x - y, back = x - d, error = (x - (d + back)) + (back - y);
  return error == 0 ? std::optional(d) : std::nullopt;
}

/// Coordinates from floats and from grids mostly have differences that are doubles. Their products are then
/// compared as pairs of doubles, value and error.
std::optional<bool> pair_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c) {
  std::array<double, 3> u, v;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = Eigen::Index(i);
    const auto ui = exact_difference(b(k), a(k)), vi = exact_difference(c(k), a(k));
    if (!ui || !vi) return std::nullopt;
    u[i] = *ui;
    v[i] = *vi;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double left = u[j] * v[k], right = u[k] * v[j];
    const auto is_sound = [](double product, double x, double y) {
      return (x == 0 || y == 0) || (std::abs(product) > 0x1p-900 && std::abs(product) < 0x1p1000);
    };
    if (!is_sound(left, u[j], v[k]) || !is_sound(right, u[k], v[j])) return std::nullopt;
    if (left != right || std::fma(u[j], v[k], -left) != std::fma(u[k], v[j], -right)) return false;
  }
  return true;
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
  VERICONE_REQUIRES(a.allFinite() && b.allFinite() && c.allFinite(), "a, b, c", "a number that is not finite",
                    "finite");
  if (a == b || b == c || c == a) return true;
  if (const auto answer = triage_collinear(a, b, c)) return *answer;
  if (const auto answer = pair_collinear(a, b, c)) return *answer;
  return exact_collinear(a, b, c);
}

}  // namespace vericone::files
