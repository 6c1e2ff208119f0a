// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/internal/guidance/pursuit/source_laws.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pursuit/products.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// Of one focus from A.
struct Seen {
  Vector2d p, v, a;  // a without A's acceleration
  double c, s, n;    // p x v, p.v, v.v

  Seen(const FocalState& f, std::size_t i)
      : p(f.foci[i] - f.position),
        v(f.velocities[i] - f.velocity),
        a(f.accelerations[i]),
        c(cross(p, v)),
        s(p.dot(v)),
        n(v.squaredNorm()) {}
};

/// y_1 as a function of c, s, n of both foci, and its derivatives: errata 3.4. |c| / |v| is the miss distance
/// of a focus, -s / n the time of its nearest approach.
struct SourceForm {
  double y, by_c[2]{}, by_s[2]{}, by_n[2]{};

  SourceForm(const Seen& one, const Seen& two, double a) {
    const double n1 = one.n, n2 = two.n;
    y = -4 * a * a * n1 * n2;
    by_n[0] = -4 * a * a * n2;
    by_n[1] = -4 * a * a * n1;
    if (!(n1 > 0) || !(n2 > 0)) return;
    const double v1 = std::sqrt(n1), v2 = std::sqrt(n2), c1 = std::abs(one.c), c2 = std::abs(two.c);
    const double apart = one.s / n1 - two.s / n2, misses = c1 / v1 + c2 / v2;
    if (!(misses > 0)) {
      // A flies along the line of the foci: only |t_1 - t_2| is left, without a gradient across.
      y += n1 * n2 * 0.5 * (n1 + n2) * apart * apart;
      return;
    }
    const double ratio = apart / misses, tau = ratio * ratio;
    const double a1 = c1 * v2, a2 = c2 * v1, r1 = std::sqrt(1 + tau * n1), r2 = std::sqrt(1 + tau * n2);
    const double w = a1 * r1 + a2 * r2;
    y += w * w;
    // tau = ratio^2, ratio = apart / misses.
    const double w_by_tau = a1 * n1 / (2 * r1) + a2 * n2 / (2 * r2);
    const double by_apart = w_by_tau * 2 * ratio / misses, by_misses = -by_apart * ratio;
    const double w_by_c[] = {v2 * r1 + by_misses / v1, v1 * r2 + by_misses / v2};
    const double w_by_s[] = {by_apart / n1, -by_apart / n2};
    const double w_by_n[] = {a2 * r2 / (2 * n1) + a1 * tau / (2 * r1) - by_apart * one.s / (n1 * n1) -
                                 by_misses * c1 / (2 * n1 * v1),
                             a1 * r1 / (2 * n2) + a2 * tau / (2 * r2) + by_apart * two.s / (n2 * n2) -
                                 by_misses * c2 / (2 * n2 * v2)};
    const double signs[] = {one.c < 0 ? -1.0 : 1.0, two.c < 0 ? -1.0 : 1.0};
    for (int i = 0; i < 2; ++i) {
      by_c[i] = 2 * w * w_by_c[i] * signs[i];
      by_s[i] = 2 * w * w_by_s[i];
      by_n[i] += 2 * w * w_by_n[i];
    }
  }
};

void source_form(const FocalState& state, const Seen (&sights)[2], FocalRates& f) {
  const SourceForm y(sights[0], sights[1], state.a);
  f.y1 = y.y;
  // The term that (4.11) leaves out.
  f.drift1 = -8 * state.a * state.a_rate * sights[0].n * sights[1].n;
  for (int i = 0; i < 2; ++i) {
    const Seen& s = sights[i];
    const Vector2d gradient = y.by_c[i] * left(s.p) + y.by_s[i] * s.p + 2 * y.by_n[i] * s.v;
    f.drift1 += y.by_s[i] * s.n + gradient.dot(s.a);
    f.by_acceleration1 -= gradient;
  }
}

void polynomial_form(const FocalState& state, const Seen (&sights)[2], FocalRates& f) {
  const Vector2d v = 0.5 * (sights[0].v + sights[1].v), a = 0.5 * (sights[0].a + sights[1].a);
  const Vector2d between = state.foci[0] - state.foci[1];
  const double n = v.squaredNorm(), u1 = cross(sights[0].p, v), u2 = cross(sights[1].p, v);
  const double b2 = state.a * state.a - 0.25 * between.squaredNorm();
  const double b2_rate =
      2 * state.a * state.a_rate - 0.5 * between.dot(state.velocities[0] - state.velocities[1]);
  f.y1 = 4 * n * (u1 * u2 - b2 * n);
  const Vector2d gradient =
      8 * (u1 * u2 - 2 * b2 * n) * v + 4 * n * (u2 * left(sights[0].p) + u1 * left(sights[1].p));
  f.by_acceleration1 = -gradient;
  f.drift1 = gradient.dot(a) + 4 * n * (cross(sights[0].v, v) * u2 + u1 * cross(sights[1].v, v)) -
             4 * b2_rate * n * n;
}

double angle_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

}  // namespace

FocalRates focal_cone(const FocalState& state, FocalForm form) {
  const Seen sights[] = {{state, 0}, {state, 1}};
  FocalRates f;
  form == FocalForm::source ? source_form(state, sights, f) : polynomial_form(state, sights, f);
  f.y2 = sights[0].n;
  f.drift2 = 2 * sights[0].v.dot(sights[0].a);
  f.by_acceleration2 = -2 * sights[0].v;
  double v_r = 0;
  for (const Seen& s : sights) v_r += s.p.isZero(0) ? 0 : s.s / s.p.norm();
  f.closing = v_r < 0;
  return f;
}

double least_focal_sum(const FocalState& state) {
  const Seen one(state, 0), two(state, 1);
  const auto value = [&](double t) {
    return (one.p + t * one.v).norm() + (two.p + t * two.v).norm() - 2 * (state.a + t * state.a_rate);
  };
  // A norm's slope at its zero is any number up to its speed; 0 will do.
  const auto slope = [&](double t) {
    double sum = -2 * state.a_rate;
    for (const Seen* s : {&one, &two}) {
      const Vector2d p = s->p + t * s->v;
      const double r = p.norm();
      sum += r > 0 ? p.dot(s->v) / r : 0;
    }
    return sum;
  };
  const double v1 = std::sqrt(one.n), v2 = std::sqrt(two.n), at_last = v1 + v2 - 2 * state.a_rate;
  if (!(at_last > 0)) {
    // It falls for ever, towards its asymptote.
    if (at_last < 0) return -std::numeric_limits<double>::infinity();
    if (v1 + v2 == 0) return value(0);
    return (v1 > 0 ? one.s / v1 : one.p.norm()) + (v2 > 0 ? two.s / v2 : two.p.norm()) - 2 * state.a;
  }
  double low = 0;
  if (slope(0) >= 0) return value(0);
  double high = 1;
  while (slope(high) < 0 && high < 1e300) low = high, high *= 2;
  // The value is flat at its least: half the digits of the time are enough, 60 halvings give them all.
  for (int i = 0; i < 60 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0 ? low : high) = middle;
  }
  // Where both foci stand on the course the least can be in a kink, at the nearest approach of one of them.
  double least = std::min(value(low), value(high));
  for (const Seen* s : {&one, &two})
    if (s->n > 0 && s->s < 0) least = std::min(least, value(-s->s / s->n));
  return least;
}

PursuitCommand FocalLaw::step(const FocalState& state, double time) {
  const FocalRates f = focal_cone(state, form_);
  PursuitCommand command;
  command.y1 = f.y1;
  command.y2 = f.y2;
  const double alpha = angle_of(state.velocity);
  const Vector2d ahead(std::cos(alpha), std::sin(alpha));
  const double determinant = cross(f.by_acceleration1, f.by_acceleration2);
  const Vector2d to_focus = state.foci[0] - state.position;
  const bool receding = to_focus.dot(state.velocities[0] - state.velocity) > 0;
  if (time >= until_ && !(std::abs(determinant) >= gains_.singular && determinant != 0))
    until_ = time + gains_.stay;
  in_layer_ = time < until_ || (gains_.layer_when_receding && receding);
  if (in_layer_) {
    // (4.15), (4.16) with E_c the first focus; the sign of K_r as corrected.
    const double theta = angle_of(to_focus), r = to_focus.norm();
    const double beyond = std::max(0.0, r - gains_.near);
    command.lateral = gains_.heading * wrapped(angle_of(state.velocities[0]) - alpha) +
                      (beyond > 0 ? gains_.sight * wrapped(theta - alpha) : 0);
    command.longitudinal = gains_.speed_error * (state.velocities[0].norm() - state.velocity.norm()) +
                           gains_.distance * (to_focus.dot(ahead) >= 0 ? 1 : -1) * beyond;
    command.status = PursuitStatus::singular;
  } else {
    // (4.14).
    const double k1 = f.y1 >= 0 ? gains_.cone : 0;
    const double first = k1 * (gains_.reference - f.y1) - f.drift1, second = -gains_.speed * f.y2 - f.drift2;
    const Vector2d a = Vector2d(first * f.by_acceleration2.y() - second * f.by_acceleration1.y(),
                                second * f.by_acceleration1.x() - first * f.by_acceleration2.x()) /
                       determinant;
    command.lateral = cross(ahead, a);
    command.longitudinal = ahead.dot(a);
  }
  saturate(command, gains_.most);
  return command;
}

}  // namespace vericone::guidance
