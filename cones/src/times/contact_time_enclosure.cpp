// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/internal/geometry/requires.h>

#include "times/contact_time_exact.h"
#include "times/contact_time_search.h"

namespace vericone {

std::optional<Interval> interval_time_to_contact(const Ellipsoid& a, const Ellipsoid& b,
                                                 const std::array<Interval, 3>& w, double widest) noexcept {
  const auto found = ContactTimeSearch(a, b, w).bounds(0x1p-50, widest);
  if (!found || found->when != ContactTimeBounds::When::later) return std::nullopt;
  const Interval time = Interval::between(found->lo, found->hi);
  return time.rad() <= widest * time.mid() ? std::optional(time) : std::nullopt;
}

std::optional<Interval> exact_time_to_contact(const ConeOracle& oracle, const Eigen::Vector3d& v_a,
                                              const Eigen::Vector3d& v_b) {
  VERICONE_REQUIRES(v_a.allFinite() && v_b.allFinite());
  exact::ContactTime time(oracle, v_a, v_b);
  switch (time.when()) {
    case exact::ContactTime::When::now:
      return Interval(0);
    case exact::ContactTime::When::later:
      return time.enclosure();
    case exact::ContactTime::When::never:
      break;
  }
  return std::nullopt;
}

std::optional<Interval> enclose_time_to_contact(const ConeOracle& oracle, const Eigen::Vector3d& v_a,
                                                const Eigen::Vector3d& v_b) {
  switch (oracle.verdict(v_a, v_b)) {
    case Verdict::overlapping:
    case Verdict::touching:
      return Interval(0);
    case Verdict::out:
    case Verdict::undecided:  // never of ellipsoids
      return std::nullopt;
    case Verdict::in: {
      std::array<Interval, 3> w;
      for (int i = 0; i < 3; ++i) w[i] = Interval(v_a(i)) - Interval(v_b(i));
      if (const auto found = interval_time_to_contact(oracle.a(), oracle.b(), w)) return found;
      break;
    }
    case Verdict::on:
      break;
  }
  return exact_time_to_contact(oracle, v_a, v_b);
}

}  // namespace vericone
