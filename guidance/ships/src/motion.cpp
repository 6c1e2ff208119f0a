// SPDX-License-Identifier: BSD-3-Clause
#include "motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vericone::ships {

using Eigen::Vector2d, Eigen::Vector3d;
using simulation::Curve, simulation::Jet, simulation::Quintic, simulation::Track;

namespace {

constexpr double kPadding = 1e-6;  // m: rounding of what is proved again a step later

Vector3d lifted(const Vector2d& x) { return {x.x(), x.y(), 0}; }
Vector2d left_of(const Vector2d& x) { return {-x.y(), x.x()}; }

/// Heading with its first two derivatives by time, and speed, after a time.
struct Turning {
  double heading, rate, acceleration, speed, curvature;
};
Turning turning(const Handling& handling, const Piece& piece, double t) {
  const State& at = piece.start;
  const double change = piece.command.acceleration, rudder = piece.command.curvature;
  const double speed = at.speed + change * t, way = t * (at.speed + 0.5 * change * t);
  // Nomoto's lag along the way: the curvature nears the rudder's.
  const double left = at.curvature - rudder, fade = std::exp(-way / handling.lag);
  const double curvature = rudder + left * fade;
  const double heading = at.heading + rudder * way - left * handling.lag * std::expm1(-way / handling.lag);
  return {heading, speed * curvature, change * curvature - speed * speed * left * fade / handling.lag, speed,
          curvature};
}

/// Gauss and Legendre's rule with eight nodes on [-1, 1].
constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                       0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};

/// What a point fixed in the ship does: `beside` is in her frame.
Jet jet_of(const State& state, const Turning& turn, double acceleration, const Vector2d& beside) {
  const Vector2d ahead(std::cos(turn.heading), std::sin(turn.heading)),
      arm = beside.x() * ahead + beside.y() * left_of(ahead);
  const Vector2d velocity = turn.speed * ahead + turn.rate * left_of(arm);
  const Vector2d second = acceleration * ahead + turn.speed * turn.rate * left_of(ahead) +
                          turn.acceleration * left_of(arm) - turn.rate * turn.rate * arm;
  return {lifted(state.position + arm), lifted(velocity), lifted(second)};
}

/// What Hermite's quintic of R(psi(t)) r is off, |r| = 1, for a quintic psi: duration^6 / 46080 times a bound
/// of the sixth derivative, Bell's polynomial of the bounds of psi's derivatives.
double of_turning(const Quintic& psi, double duration) {
  std::array<double, 6> x{};  // of the first to the sixth
  for (int k = 1; k <= 5; ++k)
    for (int j = k; j <= 5; ++j) {
      double factor = std::abs(psi[static_cast<std::size_t>(j)].z()) * std::pow(duration, j - k);
      for (int m = j; m > j - k; --m) factor *= m;
      x[static_cast<std::size_t>(k - 1)] += factor;
    }
  const double a = x[0], b = x[1], c = x[2], d = x[3], e = x[4];
  const double bell = std::pow(a, 6) + 15 * b * std::pow(a, 4) + 20 * c * a * a * a + 45 * b * b * a * a +
                      15 * b * b * b + 60 * c * b * a + 15 * d * a * a + 10 * c * c + 15 * d * b + 6 * e * a;
  return std::pow(duration, 6) / 46080 * bell * (1 + 1e-12);
}

simulation::ShapeInTime ellipse(double ahead, double abeam) {
  return simulation::RigidShape{
      WorldBody(CombinedEllipse(Ellipse::from_axes(Vector2d::Zero(), {ahead, abeam})))};
}

simulation::Motion motion_of(const Jet& jet, double heading) {
  return {jet.value, jet.first, rotation_from_heading(heading, 0)};
}

}  // namespace

State after(const Handling& handling, const Piece& piece, double seconds) {
  Vector2d position = piece.start.position;
  for (std::size_t k = 0; k < 4; ++k)
    for (const double side : {-1.0, 1.0}) {
      const Turning at = turning(handling, piece, 0.5 * seconds * (1 + side * kNodes[k]));
      position +=
          0.5 * seconds * kWeights[k] * at.speed * Vector2d(std::cos(at.heading), std::sin(at.heading));
    }
  const Turning end = turning(handling, piece, seconds);
  return {position, end.heading, std::max(0.0, end.speed), end.curvature};
}

std::vector<Piece> stop_from(const Handling& handling, const State& state) {
  std::vector<Piece> pieces;
  for (State at = state; at.speed > 0;) {
    const double left = at.speed / handling.slower;
    // No last piece that is a rounding of the time.
    const bool last = left <= kStopPiece * (1 + 1e-9);
    const Piece piece{at, {0, -handling.slower}, last ? left : kStopPiece};
    pieces.push_back(piece);
    at = after(handling, piece, piece.seconds);
    if (last) break;
  }
  if (pieces.empty()) pieces.push_back({state, {0, 0}, kStopPiece});
  return pieces;
}

std::vector<Piece> plan_of(const Handling& handling, const Piece& piece) {
  std::vector<Piece> pieces{piece};
  const State end = after(handling, piece, piece.seconds);
  if (end.speed > 0)
    for (const Piece& stop : stop_from(handling, end)) pieces.push_back(stop);
  return pieces;
}

double length_of(const std::vector<Piece>& pieces) {
  double length = 0;
  for (const Piece& piece : pieces)
    length += piece.seconds * (piece.start.speed + 0.5 * piece.command.acceleration * piece.seconds);
  return length;
}

double seconds_of(const std::vector<Piece>& pieces) {
  double seconds = 0;
  for (const Piece& piece : pieces) seconds += piece.seconds;
  return seconds;
}

Command steer(const Handling& handling, const State& state, double heading, double speed, double step) {
  const double error = std::remainder(heading - state.heading, 2 * std::numbers::pi),
               most = 1 / handling.radius;
  // With the lag, psi' = k and lag k' = r - k along the way: r = error / (4 lag) has a double root.
  const double rudder = std::clamp(error / (4 * handling.lag), -most, most);
  return {rudder, std::clamp((speed - state.speed) / step, -handling.slower, handling.faster)};
}

Sailed sailed(const Ship& ship, const std::vector<Piece>& pieces, const Vector2d& current, double from,
              double until) {
  const Handling& handling = ship.handling;
  const Vector2d beside[2] = {Vector2d::Zero(), ship.domain.center};
  const auto start_of = [&](int which) {
    const Piece& first = pieces.front();
    const Turning turn = turning(handling, first, 0);
    Jet jet = jet_of(first.start, turn, first.command.acceleration, beside[which]);
    jet.value += from * lifted(current);
    jet.first += lifted(current);
    return motion_of(jet, first.start.heading);
  };
  Sailed both{Track(ellipse(0.5 * handling.length, 0.5 * handling.beam), start_of(0),
                    simulation::Orientation::fixed, from),
              Track(ellipse(ship.domain.half.x(), ship.domain.half.y()), start_of(1),
                    simulation::Orientation::fixed, from)};
  double t = from;
  for (const Piece& piece : pieces) {
    if (!(t < until)) break;
    const State end = after(handling, piece, piece.seconds);
    const Turning first = turning(handling, piece, 0), last = turning(handling, piece, piece.seconds);
    const auto turned = [&](const Turning& turn) -> Jet {
      return {Vector3d(0, 0, turn.heading - piece.start.heading), Vector3d(0, 0, turn.rate),
              Vector3d(0, 0, turn.acceleration)};
    };
    const Quintic psi = quintic(turned(first), turned(last), piece.seconds);
    both.error = std::max(both.error, ship.domain.center.norm() * of_turning(psi, piece.seconds));
    const Eigen::Matrix3d rotation = rotation_from_heading(piece.start.heading, 0);
    for (const int which : {0, 1}) {
      Quintic position = quintic(jet_of(piece.start, first, piece.command.acceleration, beside[which]),
                                 jet_of(end, last, piece.command.acceleration, beside[which]), piece.seconds);
      position[0] += t * lifted(current);
      position[1] += lifted(current);
      (which == 0 ? both.hull : both.domain).append(Curve(position, psi, rotation, t, t + piece.seconds));
    }
    t += piece.seconds;
  }
  for (Track* track : {&both.hull, &both.domain})
    if (t < until) {
      simulation::Motion rest = track->motion(t);
      rest.velocity = lifted(current);
      track->append(Curve::steady(rest, Vector3d::Zero(), t, until));
    }
  return both;
}

DomainProof prove_domains(const Sailed& a, const Sailed& b, double from, double until) {
  simulation::ProofOptions options;
  options.padding = kPadding + std::max(a.error, b.error);
  const simulation::PairProof first = simulation::prove(a.domain, b.hull, from, until, options);
  // Of a domain whose track is known to an error alone a touch is none.
  const auto said = [](const Sailed& ship, simulation::ProofVerdict verdict) {
    const bool sure = !(ship.error > 0) || verdict != simulation::ProofVerdict::touched;
    return sure ? verdict : simulation::ProofVerdict::undecided;
  };
  if (first.verdict != simulation::ProofVerdict::avoided) return {said(a, first.verdict), 0};
  const simulation::PairProof second = simulation::prove(a.hull, b.domain, from, until, options);
  if (second.verdict != simulation::ProofVerdict::avoided) return {said(b, second.verdict), 0};
  return {first.verdict, std::min(first.least_distance, second.least_distance)};
}

Ellipse hull_of(const Handling& handling, const Vector2d& position, double heading) {
  return Ellipse::from_axes(position, {0.5 * handling.length, 0.5 * handling.beam}, rotation_2d(heading));
}

}  // namespace vericone::ships
