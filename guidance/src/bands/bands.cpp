// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/bands.h>

#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <string>

#include "bands/at_once.h"
#include "bands/delimited.h"
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
  Domain domain;   // of a closed one: about its present value, half a turn to either side
  Box velocities;  // over ground, of all values and the present one
};

/// Whether a ball may be met before `until` at all: by the box of all ways seen from it.
struct Within {
  Box velocities;  // over ground
  double until;

  bool operator()(const Vector3d& center, double radius, const Vector3d& other) const {
    if (std::isinf(until)) return true;
    const Vector3d least = (until * (velocities.low - other)).cwiseMin(0),
                   most = (until * (velocities.high - other)).cwiseMax(0);
    const double rounded = 0x1p-40 * (radius + center.norm() + least.norm() + most.norm());
    return (center - center.cwiseMax(least).cwiseMin(most)).norm() <= radius + rounded;
  }
};

class Banding {
 public:
  Banding(const Placed& agent, std::span<const Intruder> intruders, const BandOptions& options, double margin)
      : options_(options), margin_(margin), threats_(agent, intruders, margin) {}

  Band band(const Quantity& quantity) const {
    const bool takes_time = std::isfinite(quantity.change.rate);
    return takes_time ? after(quantity, 0, true) : at_once(quantity, options_.horizon);
  }

  Band at_once(const Quantity& quantity, const Horizon& horizon) const {
    const Domain whole = quantity.domain.closed ? Domain{0, 2 * kPi, true} : quantity.domain;
    const double finest = 1e-5 * (whole.high - whole.low);
    return of_all(
        {whole, whole}, true, Within{quantity.velocities, horizon.until},
        [&](const Part& part, double margin, bool) {
          return OfVelocity(part, horizon, margin, quantity.at_once);
        },
        [&](const Part& part) { return OfDelimited(part, horizon, margin_, quantity.at_once, finest); });
  }

  /// After going on for `wait`. `hits`: whether what conflicts is proved, and looked at as finely.
  Band after(const Quantity& quantity, double wait, bool hits) const {
    const Domain whole = quantity.domain.closed ? Domain{0, 2 * kPi, true} : quantity.domain,
                 about{quantity.domain.low, quantity.domain.high};
    const Within reached{quantity.velocities, options_.horizon.until};
    return of_all({whole, about}, hits, reached, [&](const Part& part, double margin, bool prove) {
      const int parts = prove ? 1 << 16 : hits ? 64 : 16;
      return OfManoeuvre(part, margin, quantity.change, wait, options_.horizon.until, {about.low, about.high},
                         parts, prove);
    });
  }

  Band of_altitude(const Vector3d& level) const {
    const Domain whole{options_.altitude.from, options_.altitude.to};
    const auto all = [](const Vector3d&, double, const Vector3d&) { return true; };
    const double finest = 1e-5 * (whole.high - whole.low);
    return of_all(
        {whole, whole}, true, all,
        [&](const Part& part, double margin, bool) {
          return OfAltitude(part, level, options_.horizon, margin);
        },
        [&](const Part& part) {
          return OfDelimitedAltitude(part, level, options_.horizon, margin_, finest);
        });
  }

  /// When the first body comes nearer than the margin on the present course, at least; none within the
  /// horizon.
  std::optional<double> violation(const Vector3d& ground) const {
    std::optional<double> first;
    threats_.near(ground, options_.horizon.until, 0, [&](std::size_t i) {
      const Part& part = threats_[i];
      if (keeps(part, ground, options_.horizon)) return;
      const Pair& whole = part.as_it_is();
      const Pair wider = margin_ > 0 ? Pair(wider_than(whole.agent(), margin_), whole.obstacle()) : whole;
      const auto contact = wider.contact(ground, part.velocity);
      const double time = std::max(contact ? contact->earliest : 0, options_.horizon.from);
      first = std::min(first.value_or(kInfinity), time);
    });
    return first;
  }

  /// Whether all keep the margin on the present course from now until then.
  bool is_clear(const Vector3d& ground, double until) const {
    bool clear = true;
    threats_.near(ground, until, 0, [&](std::size_t i) {
      clear = clear && keeps(threats_[i], ground, {0, until});
    });
    return clear;
  }

  /// See Band::last: bisected, as if what works after a wait worked after every shorter one.
  double last(const Quantity& quantity, const Vector3d& ground) const {
    const double until = options_.horizon.until;
    if (std::isinf(until) || options_.horizon.from > 0) return std::numeric_limits<double>::quiet_NaN();
    if (is_clear(ground, until)) return kInfinity;
    const auto works = [&](double wait) {
      return is_clear(ground, wait) && !after(quantity, wait, false).free.empty();
    };
    if (!works(0)) return -1;
    double low = 0, high = until;
    for (int step = 0; step < 20; ++step) {
      const double between = 0.5 * (low + high);
      (works(between) ? low : high) = between;
    }
    return low;
  }

  /// Of headings in some ranges alone.
  std::optional<Bands::Recovery> recovery(const Quantity& headings, const std::vector<Range>& among) const {
    const double until = options_.horizon.until;
    if (std::isinf(until)) return std::nullopt;
    const auto best = [&](double from) -> std::optional<Bands::Recovery> {
      const std::vector<Range> free = common(at_once(headings, {from, until}).free, among);
      if (free.empty()) return std::nullopt;
      const auto widest = std::max_element(free.begin(), free.end(), [](const Range& a, const Range& b) {
        return a.to - a.from < b.to - b.from;
      });
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
  /// What both have, each in order.
  static std::vector<Range> common(const std::vector<Range>& some, const std::vector<Range>& others) {
    std::vector<Range> both;
    for (const Range& one : some)
      for (const Range& other : others)
        if (const Range range{std::max(one.from, other.from), std::min(one.to, other.to)};
            range.from <= range.to)
          both.push_back(range);
    return both;
  }

  /// Proved.
  bool keeps(const Part& part, const Vector3d& ground, const Horizon& horizon) const {
    if (margin_ == 0) return part.as_it_is().verdict(ground, part.velocity, horizon) == Verdict::out;
    return safe(part, ground, horizon, margin_) ||
           (part.truth && AsTheyAre(*part.truth).apart(ground, part.velocity, horizon, margin_));
  }

  /// `ask(part, margin, whether hits are to be proved)` is the question of one part; `ask_as_it_is(part)` of
  /// one of which a body has delimiters, where there is such a question.
  template <typename Reaches, typename Ask, typename AskAsItIs = std::nullptr_t>
  Band of_all(Merged merged, bool hits, const Reaches& reaches, const Ask& ask,
              const AskAsItIs& ask_as_it_is = nullptr) const {
    threats_.descend(
        Where{true, {}}, reaches,
        [&](const Part& ball, const Where& where) {
          return merged.not_free(ask(ball, 0, false), merged.without_known(where, hits), false);
        },
        [&](const Part& part, const Where& where) {
          const Where still = where.everywhere ? where : merged.without_known(where, hits);
          if (still.empty()) return;
          const bool prove = hits && part.exact();
          Where blocked = merged.not_free(ask(part, margin_, prove), still, prove);
          if constexpr (!std::is_null_pointer_v<AskAsItIs>)
            if (!part.exact() && !blocked.empty())
              blocked = merged.not_free(ask_as_it_is(part), blocked, hits);
          merged.block(blocked.ranges);
        });
    return merged.band();
  }

  const BandOptions& options_;
  double margin_;            // m
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
  if (!(options.margin >= 0 && std::isfinite(options.margin)))
    throw InputError("margin", to_text(options.margin), "0 or more (metres)");
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

/// The quantities of an agent that flies with a velocity through the air.
class Quantities {
 public:
  Quantities(const Vector3d& velocity, const BandOptions& options)
      : speed_(std::hypot(velocity.x(), velocity.y())),
        ahead_(speed_ > 0 ? Vector3d(velocity.x() / speed_, velocity.y() / speed_, 0) : Vector3d::UnitY()),
        ground_(velocity + options.wind),
        level_(ground_.x(), ground_.y(), options.wind.z()),
        climbing_(options.wind + velocity.z() * Vector3d::UnitZ()),
        speeds_(is_given(options.speed) ? options.speed : Range{0, 2 * speed_}),
        climbs_(is_given(options.climb) ? options.climb : Range{-velocity.norm(), velocity.norm()}),
        now_(std::atan2(ahead_.x(), ahead_.y())),
        headings_(speed_, velocity.z(), options.wind),
        speed_line_(climbing_, ahead_, speeds_),
        climb_line_(level_, Vector3d::UnitZ(), climbs_),
        turn_(speed_, now_, speed_ > 0 ? rate(options.lateral, speed_) : kInfinity, climbing_),
        faster_(climbing_, ahead_, speed_, rate(options.longitudinal, 1)),
        higher_(level_, Vector3d::UnitZ(), velocity.z(), rate(options.vertical, 1)) {}

  Quantity heading() const {
    const Vector3d about(speed_, speed_, 0);
    return {headings_, turn_, {now_ - kPi, now_ + kPi, true}, {climbing_ - about, climbing_ + about}};
  }

  Bands bands(const Banding& banding, const BandOptions& options) const {
    const Quantity of_heading = heading(),
                   of_speed{speed_line_, faster_, {speeds_.from, speeds_.to}, all_of(speed_line_, speeds_)},
                   of_climb{climb_line_, higher_, {climbs_.from, climbs_.to}, all_of(climb_line_, climbs_)};
    Bands result;
    for (const auto& [quantity, band] :
         {std::pair(&of_heading, &result.heading), {&of_speed, &result.speed}, {&of_climb, &result.climb}}) {
      *band = banding.band(*quantity);
      if (options.last) band->last = banding.last(*quantity, ground_);
    }
    if (is_given(options.altitude)) result.altitude = banding.of_altitude(level_);
    result.time_to_violation = banding.violation(ground_);
    const auto none = [](const Band& band) { return band.free.empty(); };
    if (none(result.heading) && none(result.speed) && none(result.climb))
      result.recovery = banding.recovery(of_heading, {{0, 2 * kPi}});
    return result;
  }

 private:
  Box all_of(const Line& line, const Range& range) const {
    const Vector3d from = line.velocity(range.from), to = line.velocity(range.to);
    return {from.cwiseMin(to).cwiseMin(ground_), from.cwiseMax(to).cwiseMax(ground_)};
  }
  static double rate(double acceleration, double by) {
    return acceleration > 0 ? acceleration / by : kInfinity;
  }

  double speed_;
  Vector3d ahead_, ground_, level_, climbing_;
  Range speeds_, climbs_;
  double now_;  // rad
  Headings headings_;
  Line speed_line_, climb_line_;
  Turn turn_;
  Acceleration faster_, higher_;
};

}  // namespace

Bands bands(const Placed& agent, const Vector3d& velocity, std::span<const Intruder> intruders,
            const BandOptions& options) {
  require(velocity, intruders, options);
  return Quantities(velocity, options).bands(Banding(agent, intruders, options, options.margin), options);
}

AlertBands alert_bands(const Placed& agent, const Vector3d& velocity, std::span<const Intruder> intruders,
                       std::span<const double> margins, const BandOptions& options) {
  require(velocity, intruders, options);
  for (std::size_t i = 0; i < margins.size(); ++i)
    if (!(margins[i] >= 0 && std::isfinite(margins[i]) && (i == 0 || margins[i] < margins[i - 1])))
      throw InputError("margins[" + std::to_string(i) + "]", to_text(margins[i]),
                       "0 or more, and less than the one before (metres)");
  const Quantities quantities(velocity, options);
  AlertBands result;
  for (const double margin : margins)
    result.levels.push_back(quantities.bands(Banding(agent, intruders, options, margin), options));
  if (margins.size() < 2 || !result.levels.front().recovery) return result;
  // Out of the outermost as soon as can be, and never in the innermost.
  const Banding outermost(agent, intruders, options, margins.front()),
      innermost(agent, intruders, options, margins.back());
  const Band never = innermost.at_once(quantities.heading(), options.horizon);
  if (!never.free.empty()) result.recovery = outermost.recovery(quantities.heading(), never.free);
  return result;
}

}  // namespace vericone::guidance
