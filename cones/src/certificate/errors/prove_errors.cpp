// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/errors/prove_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "certificate/rounded_hull.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

Vector negated(const Vector& n) { return {-n[0], -n[1], -n[2]}; }

/// x / 2^k, of whole or negative k.
Rational halved(const Integer& x, int k) {
  return k >= 0 ? Rational(x, Integer(1) << static_cast<unsigned>(k))
                : Rational(Integer(x << static_cast<unsigned>(-k)));
}

/// The least multiple of a power of two that is not below x: of one not above `slack`, or x where that is 0.
Rational rounded_up(const Rational& x, const Rational& slack) {
  if (slack.sign() <= 0) return x;
  const int unit = static_cast<int>(msb(numerator(slack))) - static_cast<int>(msb(denominator(slack))) - 1;
  const Rational scaled = unit >= 0 ? Rational(x / Rational(Integer(1) << static_cast<unsigned>(unit)))
                                    : Rational(x * Rational(Integer(1) << static_cast<unsigned>(-unit)));
  Integer whole = numerator(scaled) / denominator(scaled);
  if (Rational(whole) < scaled) ++whole;
  return halved(whole, -unit);
}

/// Not below max n.x over the body, and above it by hardly anything. A dent is passed over.
Rational reach(const Stated& body, const Vector& n) {
  Integer best;
  bool first = true;
  const auto offer = [&](const Integer& value) {
    if (first || value > best) best = value;
    first = false;
  };
  if (!body.points().empty()) {  // of a cloud all balls are as large
    int grid = grid_of(body.at());
    for (const Vector3d& x : body.points()) grid = std::min(grid, grid_of(x));
    if (grid == kNoGrid) grid = 0;
    for (const Vector3d& x : body.points()) offer(dot(n, on_grid(x, grid)));
    const Rational middle = halved(best + dot(n, on_grid(body.at(), grid)), -grid);
    const Piece piece = body.piece(0);
    if (!piece.ball) return middle;
    const Rational radius(piece.ball->factor()(0, 0));
    return middle + root_above(Rational(dot(n, n)) * radius * radius);
  }
  std::optional<Rational> most;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Piece piece = body.piece(i);
    if (piece.convex) {
      const Rational value = rounded_hull(piece, body.at()).reach(n);
      if (!most || value > *most) most = value;
      continue;
    }
    const int grid = std::min({piece.grid(), grid_of(body.at()), 0});
    const Convex convex = piece.on(grid, body.at());
    Rational value = halved(convex.support(n), -grid);
    if (convex.round) value += root_above(halved(convex.round->square(n), -2 * grid));
    if (!most || value > *most) most = value;
  }
  return *most;
}

/// The numbers of a plane that keeps its gap for all errors.
struct Levels {
  Rational agent, obstacle, position, velocity;
};

/// Short ones, where they leave a gap.
std::optional<Levels> levels_of(const UncertainQuestion& question, const Vector& n) {
  const Fractions m{Rational(n[0]), Rational(n[1]), Rational(n[2])};
  Levels found{reach(question.agent, n), -reach(question.obstacle, negated(n)), question.position.most(m),
               question.velocity.most(m)};
  const Fractions v_a = fractions(question.v_a), v_b = fractions(question.v_b);
  const Rational speed = dot(m, v_a) - dot(m, v_b) + found.velocity,
                 gap = found.obstacle - found.agent - found.position;
  Rational slack = gap, of_speed;
  if (std::isinf(question.until)) {
    if (speed.sign() > 0) return std::nullopt;
    of_speed = -speed;
  } else {
    const Rational until(question.until);
    slack = std::min(slack, Rational(gap - until * speed));
    of_speed = slack / (16 * until);
  }
  if (slack.sign() <= 0) return std::nullopt;
  const Rational part = slack / 16;
  found.agent = rounded_up(found.agent, part);
  found.obstacle = -rounded_up(-found.obstacle, part);
  found.position = rounded_up(found.position, part);
  if (!question.velocity.none()) found.velocity = rounded_up(found.velocity, of_speed);
  return found;
}

bool write_plane(const UncertainQuestion& question, const Plane& plane, Text& proof) {
  if (is_zero(plane.normal)) return false;
  const auto levels = levels_of(question, plane.normal);
  if (!levels) return false;
  if (plane.across) {
    const auto& [k, a, b] = *plane.across;
    proof.raw("{\"rule\": \"plane\", \"across_w\": [").index(static_cast<std::size_t>(k)).raw(", ");
    proof.number(k == 1 ? b : a).raw(", ").number(k == 1 ? a : b).raw("]");
  } else {
    proof.raw("{\"rule\": \"plane\", \"n\": ").number(plane.normal);
  }
  proof.raw(", \"agent_at_most\": ").number(levels->agent);
  proof.raw(", \"obstacle_at_least\": ").number(levels->obstacle);
  if (!question.position.none()) proof.raw(", \"position_error_at_most\": ").number(levels->position);
  if (!question.velocity.none()) proof.raw(", \"velocity_error_at_most\": ").number(levels->velocity);
  proof.raw("}");
  return true;
}

/// The nearest whole numbers to x 2^bits, x of length one or so.
Vector rounded(const Vector3d& x, int bits) {
  return primitive(on_grid((std::ldexp(1.0, bits) * x).array().round(), 0));
}

}  // namespace

bool prove_all_out(const UncertainQuestion& question, const Vector3d& normal, Text& proof) {
  if (!(normal.norm() > 0) || !normal.allFinite()) return false;
  const Vector3d n = normal / normal.cwiseAbs().maxCoeff(), w = question.w();
  for (const int bits : {4, 8, 14, 22, 32, 50})
    if (write_plane(question, {rounded(n, bits)}, proof)) return true;
  if (write_plane(question, {primitive(on_grid(normal, grid_of(normal)))}, proof)) return true;
  if (w.isZero(0)) return false;
  // As nearly across w as can be: exactly. Of velocities that are rounded by no difference.
  const int grid = std::min(grid_of(question.v_a), grid_of(question.v_b));
  const Vector whole = on_grid(question.v_a, grid) - on_grid(question.v_b, grid);
  const int k = largest_entry(whole), i = (k + 1) % 3, j = (k + 2) % 3;
  const double size = n.cwiseAbs().maxCoeff() / std::abs(w(k));
  for (const int bits : {8, 14, 22, 32, 50}) {
    const auto whole_part = [&](double x) {
      return exact::on_grid(std::nearbyint(std::ldexp(x / size / w(k), bits)), 0);
    };
    if (write_plane(question, plane_across(whole, k, whole_part(n(i)), whole_part(n(j))), proof)) return true;
  }
  return false;
}

namespace {

/// Where an error leads, rounded, and the error that leads there exactly.
struct Moved {
  Vector3d to;
  Fractions error;
};

/// Nothing where that is not in the set.
std::optional<Moved> moved_by(const StatedErrors& set, const Vector3d& from, const Vector3d& error) {
  Moved moved{from + error, {}};
  for (int i = 0; i < 3; ++i) moved.error[i] = Rational(moved.to(i)) - Rational(from(i));
  if (!set.contains(moved.error)) return std::nullopt;
  return moved;
}

/// A proof of what these errors lead to: `in` or `out`.
bool prove_one(const UncertainQuestion& question, const Pair& pair, const RelativeError& error,
               Verdict wanted, Text& proof) {
  for (const double less : {0.0, 0x1p-48, 0x1p-40, 0x1p-30, 0x1p-20, 0x1p-10}) {
    Placed obstacle = pair.obstacle();
    const auto position = moved_by(question.position, obstacle.pose.position, (1 - less) * error.position);
    const auto velocity = moved_by(question.velocity, question.v_a, (1 - less) * error.velocity);
    if (!position || !velocity) continue;
    obstacle.pose.position = position->to;
    const Vector3d v_a = velocity->to;
    const Pair moved(pair.agent(), obstacle);
    const Horizon horizon{0, question.until};
    Verdict found = moved.verdict(v_a, question.v_b, horizon);
    if (found == Verdict::overlapping) found = Verdict::in;
    if (found != wanted) continue;
    const Stated other(obstacle);
    const Question one{question.agent, other, v_a, question.v_b, horizon};
    Text text;
    std::string reason;
    if (!prove(one, wanted, text, reason)) continue;
    write(proof.raw("{\"position\": "), position->error);
    write(proof.raw(", \"velocity\": "), velocity->error);
    proof.raw(", \"proof\": ").raw(text.take()).raw("}");
    return true;
  }
  return false;
}

}  // namespace

bool prove_depends(const UncertainQuestion& question, const Pair& pair, const RelativeError& collides,
                   const RelativeError& passes, Text& proof) {
  proof.raw("{\"rule\": \"errors\", \"collides\": ");
  const auto overlaps = [&](const RelativeError& error) {
    return prove_one(question, pair, error, Verdict::in, proof);
  };
  // One that only touches proves nothing; what is against an error that passes goes deeper.
  const auto against = [&](double part) {
    return RelativeError{-part * passes.position, -part * passes.velocity};
  };
  if (!overlaps(collides) && !overlaps(against(0.25)) && !overlaps(against(1)) && !overlaps(against(0.01)))
    return false;
  proof.raw(", \"passes\": ");
  if (!prove_one(question, pair, passes, Verdict::out, proof)) return false;
  proof.raw("}");
  return true;
}

}  // namespace vericone::certificates
