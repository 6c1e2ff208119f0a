// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two bodies will meet if neither does anything: what laws ask before they say anything.
#include <vericone/cones/pair.h>
#include <vericone/guidance/guide.h>
#include <vericone/internal/cones/may_meet.h>
#include <vericone/internal/guidance/collision_course.h>
#include <vericone/internal/guidance/plane_view.h>

namespace vericone::guidance {
namespace {

/// The relative velocity against the sector on the plane that holds it.
std::optional<bool> by_sector(const BodyState& a, const BodyState& b, SectorMethod method, double cease) {
  PlaneOptions of_motion;
  of_motion.choice = PlaneChoice::of_motion;
  const auto across = choose_plane(a, b, method, of_motion);
  if (!across) return std::nullopt;
  const auto view = plane_view(a, b, *across, method, RateMethod::none);
  if (!view) return std::nullopt;
  const ConeRates rates = cone_rates(view->state, view->cone);
  return rates.y < cease && rates.v_r_hat < 0;
}

}  // namespace

std::optional<bool> on_collision_course(const BodyState& a, const BodyState& b, SectorMethod method,
                                        double cease) {
  const auto truly = [&] { return may_meet(a.shape, b.shape, a.velocity, b.velocity); };
  if (!has_sectors(a, b, method)) return truly();
  if (a.planar() || method == SectorMethod::slice || cease > 0) return by_sector(a, b, method, cease);
  const std::optional<bool> course = truly();
  // Below 0 the law is to let go before the cone is left.
  return course && *course && cease < 0 ? by_sector(a, b, method, cease) : course;
}

}  // namespace vericone::guidance
