// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/bands.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <string>

#include "bands/at_once.h"
#include "bands/manoeuvre.h"
#include "bands/threats.h"

namespace vericone::guidance {

using namespace banding;

namespace {

void require_finite(const Vector3d& x, const std::string& field) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(x(i)))
      throw InputError(field + "[" + std::to_string(i) + "]", to_text(x(i)), "a finite number (m/s)");
}

void require_range(const Range& range, double least, const char* field) {
  if (range.from >= least && range.to >= range.from && std::isfinite(range.to) && std::isfinite(range.from))
    return;
  throw InputError(
      field, "[" + to_text(range.from) + ", " + to_text(range.to) + "]",
      std::string("two finite numbers, the smaller one first") + (least == 0 ? ", none negative" : ""));
}

bool is_given(const Range& range) { return range.from != 0 || range.to != 0; }

/// A quantity of the agent's velocity.
struct Quantity {
  const Curve& at_once;
  const Change& change;
  Domain domain;  // of a closed one: about its present value, half a turn to either side
};

class Banding {
 public:
  Banding(const Placed& agent, std::span<const Intruder> intruders, const BandOptions& options)
      : options_(options), threats_(agent, intruders, 0) {}

  Band band(const Quantity& quantity) const {
    const bool takes_time = std::isfinite(quantity.change.rate);
    return takes_time ? after(quantity, 0) : at_once(quantity, options_.horizon);
  }

  Band at_once(const Quantity& quantity, const Horizon& horizon) const {
    const Domain whole = quantity.domain.closed ? Domain{0, 2 * kPi, true} : quantity.domain;
    return of_all({whole, whole}, true, [&](const Pair& pair, const Vector3d& velocity) {
      return OfVelocity(pair, velocity, horizon, quantity.at_once);
    });
  }

  /// After going on for `wait`.
  Band after(const Quantity& quantity, double wait, int parts_between_hits = 64) const {
    const Domain whole = quantity.domain.closed ? Domain{0, 2 * kPi, true} : quantity.domain,
                 about{quantity.domain.low, quantity.domain.high};
    return of_all({whole, about}, false, [&](const Pair& pair, const Vector3d& velocity) {
      return OfManoeuvre(pair, velocity, quantity.change, wait, options_.horizon.until,
                         {about.low, about.high}, parts_between_hits);
    });
  }

  Band of_altitude(const Vector3d& level) const {
    const Domain whole{options_.altitude.from, options_.altitude.to};
    return of_all({whole, whole}, true, [&](const Pair& pair, const Vector3d& velocity) {
      return OfAltitude(pair, level, velocity, options_.horizon);
    });
  }

  /// When the bodies meet first on the present course; none within the horizon.
  std::optional<double> violation(const Vector3d& ground) const {
    std::optional<double> first;
    threats_.near(ground, options_.horizon.until, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      if (part.pair.verdict(ground, part.velocity, options_.horizon) == Verdict::out) return;
      const auto contact = part.pair.contact(ground, part.velocity);
      const double time = std::max(contact ? contact->earliest : 0, options_.horizon.from);
      first = std::min(first.value_or(kInfinity), time);
    });
    return first;
  }

  /// Whether all stay apart on the present course from now until then.
  bool is_clear(const Vector3d& ground, double until) const {
    bool clear = true;
    threats_.near(ground, until, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      clear = clear && part.pair.verdict(ground, part.velocity, {0, until}) == Verdict::out;
    });
    return clear;
  }

  /// See Band::last: bisected, as if what works after a wait worked after every shorter one.
  double last(const Quantity& quantity, const Vector3d& ground) const {
    const double until = options_.horizon.until;
    if (std::isinf(until) || options_.horizon.from > 0) return std::numeric_limits<double>::quiet_NaN();
    if (is_clear(ground, until)) return kInfinity;
    const auto works = [&](double wait) {
      return is_clear(ground, wait) && !after(quantity, wait, 16).free.empty();
    };
    if (!works(0)) return -1;
    double low = 0, high = until;
    for (int step = 0; step < 20; ++step) {
      const double between = 0.5 * (low + high);
      (works(between) ? low : high) = between;
    }
    return low;
  }

  std::optional<Bands::Recovery> recovery(const Quantity& headings) const {
    const double until = options_.horizon.until;
    if (std::isinf(until)) return std::nullopt;
    const auto best = [&](double from) -> std::optional<Bands::Recovery> {
      const Band band = at_once(headings, {from, until});
      if (band.free.empty()) return std::nullopt;
      const auto widest =
          std::max_element(band.free.begin(), band.free.end(),
                           [](const Range& a, const Range& b) { return a.to - a.from < b.to - b.from; });
      return Bands::Recovery{0.5 * (widest->from + widest->to), from};
    };
    double low = options_.horizon.from, high = until;
    auto found = best(until);
    for (int step = 0; found && step < 20; ++step) {
      const double between = 0.5 * (low + high);
      const auto sooner = best(between);
      (sooner ? high : low) = between;
      if (sooner) found = sooner;
    }
    return found;
  }

 private:
  /// `ask(pair, velocity of its obstacle)` is the question of one pair.
  template <typename Ask>
  Band of_all(Merged merged, bool hits, const Ask& ask) const {
    threats_.descend(
        Where{true, {}},
        [&](const Pair& pair, const Vector3d& velocity, const Where& where) {
          return merged.not_free(ask(pair, velocity), merged.without_known(where, hits), false);
        },
        [&](const Part& part, const Where& where) {
          const Where still = where.everywhere ? where : merged.without_known(where, hits);
          if (!still.empty())
            merged.block(merged.not_free(ask(part.pair, part.velocity), still, hits && part.exact).ranges);
        });
    return merged.band();
  }

  const BandOptions& options_;
  mutable Threats threats_;  // prepares what is asked about
};

void require(const Vector3d& velocity, std::span<const Intruder> intruders, const BandOptions& options) {
  require_finite(velocity, "velocity");
  require_finite(options.wind, "wind");
  for (std::size_t i = 0; i < intruders.size(); ++i)
    require_finite(intruders[i].velocity, "intruders[" + std::to_string(i) + "].velocity");
  const Horizon& horizon = options.horizon;
  if (!(horizon.from >= 0 && horizon.until >= horizon.from && horizon.until > 0 &&
        std::isfinite(horizon.from)))
    throw InputError("horizon", "[" + to_text(horizon.from) + ", " + to_text(horizon.until) + "]",
                     "from 0 or later to a time after now, not before that (seconds)");
  require_range(options.speed, 0, "speed");
  require_range(options.climb, -kInfinity, "climb");
  require_range(options.altitude, -kInfinity, "altitude");
  for (const auto& [value, field] : {std::pair(options.lateral, "lateral"),
                                     {options.longitudinal, "longitudinal"},
                                     {options.vertical, "vertical"}}) {
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError(field, to_text(value), "positive, or 0: at once (m/s^2)");
    if (value > 0 && (horizon.from > 0 || std::isinf(horizon.until)))
      throw InputError("horizon", "[" + to_text(horizon.from) + ", " + to_text(horizon.until) + "]",
                       "from now to a finite time, for manoeuvres that take time");
  }
}

}  // namespace

Bands bands(const Placed& agent, const Vector3d& velocity, std::span<const Intruder> intruders,
            const BandOptions& options) {
  require(velocity, intruders, options);
  const double speed = std::hypot(velocity.x(), velocity.y()), fast = velocity.norm();
  const Vector3d ahead =
      speed > 0 ? Vector3d(velocity.x() / speed, velocity.y() / speed, 0) : Vector3d::UnitY();
  const Vector3d ground = velocity + options.wind, up = Vector3d::UnitZ();
  const Vector3d level(ground.x(), ground.y(), options.wind.z()), climbing = options.wind + velocity.z() * up;
  const Range speeds = is_given(options.speed) ? options.speed : Range{0, 2 * speed};
  const Range climbs = is_given(options.climb) ? options.climb : Range{-fast, fast};
  const auto rate = [](double acceleration, double by) {
    return acceleration > 0 ? acceleration / by : kInfinity;
  };

  const double heading = std::atan2(ahead.x(), ahead.y());
  const Headings headings(speed, velocity.z(), options.wind);
  const Line speed_line(climbing, ahead, speeds), climb_line(level, up, climbs);
  const Turn turn(speed, heading, speed > 0 ? rate(options.lateral, speed) : kInfinity, climbing);
  const Acceleration faster(climbing, ahead, speed, rate(options.longitudinal, 1));
  const Acceleration higher(level, up, velocity.z(), rate(options.vertical, 1));
  const Quantity of_heading{headings, turn, {heading - kPi, heading + kPi, true}};
  const Quantity of_speed{speed_line, faster, {speeds.from, speeds.to}};
  const Quantity of_climb{climb_line, higher, {climbs.from, climbs.to}};

  const Banding banding(agent, intruders, options);
  Bands result;
  for (const auto& [quantity, band] :
       {std::pair(&of_heading, &result.heading), {&of_speed, &result.speed}, {&of_climb, &result.climb}}) {
    *band = banding.band(*quantity);
    if (options.last) band->last = banding.last(*quantity, ground);
  }
  if (is_given(options.altitude)) {
    result.altitude = banding.of_altitude(level);
  }
  result.time_to_violation = banding.violation(ground);
  const auto none = [](const Band& band) { return band.free.empty(); };
  if (none(result.heading) && none(result.speed) && none(result.climb))
    result.recovery = banding.recovery(of_heading);
  return result;
}

}  // namespace vericone::guidance
