// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/ships/ships.h>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "products.h"

namespace vericone::ships {

using Eigen::Vector2d;

namespace {

void check(const Sighting& ship, const char* name) {
  const auto finite = [&](const Vector2d& x, const char* field, const char* unit) {
    if (!x.allFinite())
      throw InputError(std::string(name) + field, to_text(x.x()) + ", " + to_text(x.y()),
                       std::string("finite numbers") + unit);
  };
  finite(ship.position, ".position", " (m)");
  finite(ship.velocity, ".velocity", " (m/s)");
  finite(ship.ahead, ".ahead", "");
  if (ship.ahead.isZero(0)) throw InputError(std::string(name) + ".ahead", "0, 0", "a direction");
}

template <typename Number>
struct Plane {
  Number x, y;
};
template <typename Number>
Number dot(const Plane<Number>& p, const Plane<Number>& q) {
  return Number(p.x * q.x) + Number(p.y * q.y);
}
template <typename Number>
Number cross(const Plane<Number>& p, const Plane<Number>& q) {
  return Number(p.x * q.y) - Number(p.y * q.x);
}

/// Of both ships, what the rules ask: the other one from each, and its bow, up to positive factors.
template <typename Number>
struct Asked {
  Plane<Number> between, approach;  // second less first; first velocity less second
  std::array<Plane<Number>, 2> ahead;

  /// The other one, seen from a ship.
  [[nodiscard]] Plane<Number> to_other(int ship) const {
    return ship == 0 ? between : Plane<Number>{-between.x, -between.y};
  }
};

std::optional<Sign> sign_of(const Interval& x) {
  const FilteredSign sign = x.sign();
  if (sign == FilteredSign::uncertain) return std::nullopt;
  return sign == FilteredSign::positive ? Sign::positive : Sign::negative;
}
std::optional<Sign> sign_of(const exact::Integer& x) { return static_cast<Sign>(x.sign()); }

/// nullopt: rounding hides it.
template <typename Number>
std::optional<bool> abaft_the_beam(const Asked<Number>& asked, int ship) {
  // With p ahead and q aside of the other: p < 0 and |q| / |p| < tan 67.5, that is |p| > (sqrt 2 - 1) |q|, or
  // (|p| + |q|)^2 > 2 q^2.
  const Number p = dot(asked.ahead[ship], asked.to_other(ship)),
               q = cross(asked.ahead[ship], asked.to_other(ship));
  const std::optional<Sign> along = sign_of(p), aside = sign_of(q);
  if (!along) return std::nullopt;
  if (*along != Sign::negative) return false;
  if (!aside) return std::nullopt;
  const Number pq = Number(p * q), square = Number(p * p) - Number(q * q);
  const Number both = pq + pq;  // 2 p q: of |p| |q| the sign is to be positive, and p is negative
  const std::optional<Sign> more =
      sign_of(*aside == Sign::positive ? Number(square - both) : Number(square + both));
  if (!more) return std::nullopt;
  return *more == Sign::positive;
}

template <typename Number>
std::optional<bool> nearly_ahead(const Asked<Number>& asked, int ship) {
  // Twice the angle from ahead is below 22.5 degrees: with P = p^2 - q^2, Q = 2 p |q|, Q < (sqrt 2 - 1) P.
  const Number p = dot(asked.ahead[ship], asked.to_other(ship)),
               q = cross(asked.ahead[ship], asked.to_other(ship));
  const std::optional<Sign> along = sign_of(p);
  if (!along) return std::nullopt;
  if (*along != Sign::positive) return false;
  const Number pq = Number(p * q), twice = Number(p * p) - Number(q * q);
  const std::optional<Sign> small = sign_of(twice), aside = sign_of(q);
  if (!small) return std::nullopt;
  if (*small != Sign::positive) return false;
  if (!aside) return std::nullopt;
  const Number both = *aside == Sign::negative ? Number(-(pq + pq)) : Number(pq + pq);
  const Number cosine = Number(twice * twice), product = Number(twice * both), sine = Number(both * both);
  const std::optional<Sign> less = sign_of(Number(cosine - Number(product + product) - sine));
  if (!less) return std::nullopt;
  return *less == Sign::positive;
}

template <typename Number>
std::optional<Encounter> decide(const Asked<Number>& asked) {
  const std::optional<Sign> approach = sign_of(dot(asked.between, asked.approach));
  if (!approach) return std::nullopt;
  if (*approach != Sign::positive) return Encounter::none;
  const std::optional<bool> overtaken = abaft_the_beam(asked, 0), overtaking = abaft_the_beam(asked, 1);
  if (!overtaken || !overtaking) return std::nullopt;
  if (*overtaken && *overtaking) return Encounter::doubtful;
  if (*overtaken || *overtaking) return *overtaken ? Encounter::overtaken : Encounter::overtaking;
  const std::optional<bool> first = nearly_ahead(asked, 0), second = nearly_ahead(asked, 1);
  if (!first || !second) return std::nullopt;
  if (*first && *second) return Encounter::head_on;
  // To port positive. Dead ahead or astern, 0, is the side that the other one is not on.
  const std::optional<Sign> of_first = sign_of(cross(asked.ahead[0], asked.to_other(0))),
                            of_second = sign_of(cross(asked.ahead[1], asked.to_other(1)));
  if (!of_first || !of_second) return std::nullopt;
  const int difference = static_cast<int>(*of_first) - static_cast<int>(*of_second);
  if (difference == 0) return Encounter::doubtful;
  return difference < 0 ? Encounter::crossing_give_way : Encounter::crossing_stand_on;
}

Plane<Interval> rounded(const Vector2d& x, const Vector2d& y) {
  return {Interval(x.x()) - Interval(y.x()), Interval(x.y()) - Interval(y.y())};
}
Plane<exact::Integer> whole(const Vector2d& x, const Vector2d& y) {
  const auto difference = exact::difference_on_grid<2>(x, y);
  return {difference[0], difference[1]};
}

}  // namespace

ClosestApproach closest_approach(const Sighting& a, const Sighting& b) {
  const Vector2d c = b.position - a.position, w = a.velocity - b.velocity;
  const double largest = w.lpNorm<Eigen::Infinity>();
  if (!(largest > 0)) return {0, c.norm()};
  // By a power of two, so that squares neither vanish nor overflow.
  const int scale = std::ilogb(largest);
  const Vector2d unit = w.unaryExpr([&](double x) { return std::scalbn(x, -scale); });
  const double square = unit.squaredNorm();
  return {std::scalbn(dot(c, unit) / square, -scale), std::abs(cross(c, unit)) / std::sqrt(square)};
}

Sign compare_approach(const Sighting& a, const Sighting& b, double distance) {
  check(a, "a");
  check(b, "b");
  if (!(distance >= 0) || !std::isfinite(distance))
    throw InputError("distance", to_text(distance), "0 or more (m)");
  // (c x w)^2 - d^2 w^2, of c and d on one grid.
  const auto decided = [&](const auto& c, const auto& w, const auto& d) {
    using Number = std::decay_t<decltype(d)>;
    if (a.velocity == b.velocity) return sign_of(Number(dot(c, c) - Number(d * d)));
    const Number across = cross(c, w);
    return sign_of(Number(Number(across * across) - Number(Number(d * d) * dot(w, w))));
  };
  if (const auto sign =
          decided(rounded(b.position, a.position), rounded(a.velocity, b.velocity), Interval(distance)))
    return *sign;
  int finest = exact::grid_exponent(distance, 2000);
  for (const double x : {a.position.x(), a.position.y(), b.position.x(), b.position.y()})
    finest = std::min(finest, exact::grid_exponent(x, 2000));
  const auto on = [&](double x) { return exact::on_grid(x, finest); };
  const Plane<exact::Integer> c{on(b.position.x()) - on(a.position.x()),
                                on(b.position.y()) - on(a.position.y())};
  return *decided(c, whole(a.velocity, b.velocity), on(distance));
}

const char* to_string(Encounter encounter) {
  switch (encounter) {
    case Encounter::none:
      return "none";
    case Encounter::head_on:
      return "head-on";
    case Encounter::overtaking:
      return "overtaking";
    case Encounter::overtaken:
      return "overtaken";
    case Encounter::crossing_give_way:
      return "crossing, gives way";
    case Encounter::crossing_stand_on:
      return "crossing, stands on";
    case Encounter::doubtful:
      break;
  }
  return "doubtful";
}

const char* to_string(Side side) { return side == Side::port ? "port" : "starboard"; }

Encounter classify(const Sighting& a, const Sighting& b) {
  check(a, "a");
  check(b, "b");
  const Asked<Interval> asked{rounded(b.position, a.position),
                              rounded(a.velocity, b.velocity),
                              {rounded(a.ahead, Vector2d::Zero()), rounded(b.ahead, Vector2d::Zero())}};
  if (const auto encounter = decide(asked)) return *encounter;
  const Asked<exact::Integer> exactly{whole(b.position, a.position),
                                      whole(a.velocity, b.velocity),
                                      {whole(a.ahead, Vector2d::Zero()), whole(b.ahead, Vector2d::Zero())}};
  return *decide(exactly);
}

double share_of_effort(Encounter encounter) {
  switch (encounter) {
    case Encounter::head_on:
    case Encounter::overtaking:
    case Encounter::crossing_give_way:
    case Encounter::doubtful:
      return 1;
    case Encounter::none:
    case Encounter::overtaken:
    case Encounter::crossing_stand_on:
      break;
  }
  return 0;
}

}  // namespace vericone::ships
