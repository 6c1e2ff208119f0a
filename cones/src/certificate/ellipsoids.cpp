// SPDX-License-Identifier: BSD-3-Clause
//
// A search in doubles proposes short numbers; integers check them. Where the bodies come so near to each
// other that doubles do not tell, the search goes on in integers.
#include "certificate/ellipsoids.h"

#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "certificate/balance.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

constexpr int kRootBits[] = {60, 72, 84, 100, 120, 150, 190, 240, 300, 400, 600, 1000, 2000};

/// x 2^shift, cut off.
Integer shifted(const Integer& x, int shift) {
  if (shift >= 0) return x << static_cast<unsigned>(shift);
  const Integer size = abs(x) >> static_cast<unsigned>(-shift);
  return x.sign() < 0 ? Integer(-size) : size;
}

/// x rounded to a multiple of 2^quantum, in units of 2^(grid - finer).
std::optional<Vector> rounded(const Vector3d& x, int quantum, int grid, unsigned finer) {
  Vector r;
  for (int i = 0; i < 3; ++i) {
    const double whole = std::nearbyint(std::ldexp(x(i), -quantum));
    if (!(std::abs(whole) < 0x1p53)) return std::nullopt;
    r[i] = shifted(Integer(static_cast<std::int64_t>(whole)), quantum - grid + static_cast<int>(finer));
  }
  return r;
}

/// About numerator / denominator as a multiple of 2^quantum, in units of 2^-finer; denominator > 0.
Integer quotient(const Integer& numerator, const Integer& denominator, int quantum, unsigned finer) {
  const Integer scaled = quantum > 0 ? Integer(numerator / (denominator << static_cast<unsigned>(quantum)))
                                     : Integer((numerator << static_cast<unsigned>(-quantum)) / denominator);
  return shifted(scaled, quantum + static_cast<int>(finer));
}

/// L x = (w_k x_i - w_i x_k, w_k x_j - w_j x_k).
struct ShadowMap {
  const Vector& w;
  int k = largest_entry(w), i = (k + 1) % 3, j = (k + 2) % 3;

  exact::IntegerVector<2> of(const Vector& x) const {
    return {w[k] * x[i] - w[i] * x[k], w[k] * x[j] - w[j] * x[k]};
  }
  exact::IntegerMatrix<2> of(const Matrix& s) const {
    const exact::IntegerVector<2> rows[3] = {of(s[0]), of(s[1]), of(s[2])};
    exact::IntegerMatrix<2> m;
    for (int c = 0; c < 2; ++c) {
      const auto column = of(Vector{rows[0][c], rows[1][c], rows[2][c]});
      m[0][c] = column[0];
      m[1][c] = column[1];
    }
    return m;
  }
};

}  // namespace

/// Where the bodies, grown by one factor, touch: on the line of motion or at one time.
struct EllipsoidPair::Guess {
  double ratio = 1;    // x of Balance
  double contact = 0;  // squared factor by which they have to grow: above 1 they are apart
  double time = 0;
  Vector3d normal = Vector3d::Zero();
  Vector3d on_a = Vector3d::Zero(), on_b = Vector3d::Zero();  // from the centers
};

EllipsoidPair::EllipsoidPair(const Ellipsoid& a, const Vector& center_a, const Ellipsoid& b,
                             const Vector& center_b, const Motion& motion)
    : a_(a),
      b_(b),
      motion_(motion),
      agent_{{center_a}, Round(a, motion.grid)},
      obstacle_{{center_b}, Round(b, motion.grid)},
      c_(center_b - center_a),
      center_a_(to_double(center_a, motion.grid)),
      center_b_(to_double(center_b, motion.grid)),
      line_(to_double(c_, motion.grid)),
      v_a_(to_double(motion.v_a, motion.grid)),
      v_b_(to_double(motion.v_b, motion.grid)),
      w_(to_double(motion.w, motion.grid)) {}

EllipsoidPair::Guess EllipsoidPair::guess_at(double time) const {
  const ContactFrame<3> frame(a_.factor(), b_.factor(), line_ - time * w_);
  Guess guess{frame.ratio, frame.contact, time, frame.separating_normal()};
  const Vector3d n = guess.normal * ((1 + frame.ratio) / frame.ratio);
  guess.on_a = a_.factor() * (a_.factor().transpose() * n);
  guess.on_b = -frame.ratio * (b_.factor() * (b_.factor().transpose() * n));
  return guess;
}

EllipsoidPair::Guess EllipsoidPair::line_guess() const {
  const Vector3d along = w_ / w_.cwiseAbs().maxCoeff();
  Eigen::Matrix<double, 2, 3> p;
  p.row(0) = along.unitOrthogonal().transpose();
  p.row(1) = along.cross(p.row(0).transpose()).normalized().transpose();
  const auto shadow = [&](const Ellipsoid& body) {
    const Eigen::Matrix<double, 2, 3> f = p * body.factor();
    Eigen::Matrix2d lower = Eigen::Matrix2d::Zero();
    lower(0, 0) = f.row(0).norm();
    const Eigen::RowVector3d e = f.row(0) / lower(0, 0);
    lower(1, 0) = f.row(1).dot(e);
    lower(1, 1) = (f.row(1) - lower(1, 0) * e).norm();
    return lower;
  };
  const ContactFrame<2> frame(shadow(a_), shadow(b_), p * line_);
  Guess guess{frame.ratio, frame.contact, 0, p.transpose() * frame.separating_normal()};
  const Vector3d n = guess.normal * ((1 + frame.ratio) / frame.ratio);
  guess.on_a = a_.factor() * (a_.factor().transpose() * n);
  guess.on_b = -frame.ratio * (b_.factor() * (b_.factor().transpose() * n));
  guess.time = (line_ - guess.on_a + guess.on_b).dot(along) / along.squaredNorm() / w_.cwiseAbs().maxCoeff();
  return guess;
}

/// The time of the motion that is nearest to one.
Dyadic EllipsoidPair::nearest(double time) const {
  if (!(time > to_double(motion_.from))) return motion_.from;
  if (motion_.until && !(time < to_double(*motion_.until))) return *motion_.until;
  return Dyadic::of(time);
}

std::optional<Plane> EllipsoidPair::short_plane(const Guess& guess, bool across) const {
  // What is left between them bounds how far the normal may turn, to second order.
  const double left = std::sqrt(guess.contact) - 1;
  if (!(left > 1e-15)) return std::nullopt;
  const int k = largest_entry(motion_.w), i = (k + 1) % 3, j = (k + 2) % 3;
  Vector3d n = guess.normal;
  if (across) n = Vector3d(n(i) / w_(k), n(j) / w_(k), 0);
  n /= n.cwiseAbs().maxCoeff();
  if (!n.allFinite()) return std::nullopt;
  for (int bits = std::max(1, 2 - log2_of(left) / 2); bits <= 52; bits += 3) {
    const Vector whole = *rounded(n, -bits, -bits, 0);
    Plane plane{primitive(whole)};
    if (across) {
      const Integer common = std::max(Integer(1), Integer(gcd(whole[0], whole[1])));
      plane = plane_across(motion_.w, k, whole[0] / common, whole[1] / common);
    }
    if (!is_zero(plane.normal) && separates(agent_, obstacle_, motion_, plane.normal)) return plane;
  }
  return std::nullopt;
}

std::optional<Plane> EllipsoidPair::exact_plane_across(double ratio) const {
  if (is_zero(motion_.w)) return std::nullopt;
  const ShadowMap shadow{motion_.w};
  const auto d = shadow.of(c_);
  if (d[0].is_zero() && d[1].is_zero()) return std::nullopt;
  const Balance<2> balance(shadow.of(agent_.round->shape()), shadow.of(obstacle_.round->shape()), d);
  for (const int bits : kRootBits) {
    const auto m = balance.normal(balance.root(ratio, bits));
    const int size = std::max(exact::log2_floor(m[0].is_zero() ? Integer(1) : m[0]),
                              exact::log2_floor(m[1].is_zero() ? Integer(1) : m[1]));
    for (const int kept : {bits / 2, 3 * bits / 4, bits}) {
      const Integer a = shifted(m[0], kept - size), b = shifted(m[1], kept - size);
      const Plane plane = plane_across(motion_.w, shadow.k, a, b);
      if (!is_zero(plane.normal) && separates(agent_, obstacle_, motion_, plane.normal)) return plane;
    }
  }
  return std::nullopt;
}

std::optional<Plane> EllipsoidPair::exact_plane_at(const Dyadic& time, double ratio) const {
  const Vector c = (c_ << time.exponent) - time.numerator * motion_.w;
  if (is_zero(c)) return std::nullopt;
  const auto scaled = [&](Matrix s) {
    for (auto& row : s)
      for (Integer& e : row) e <<= 2 * time.exponent;
    return s;
  };
  const Balance<3> balance(scaled(agent_.round->shape()), scaled(obstacle_.round->shape()), c);
  for (const int bits : kRootBits) {
    const Vector m = balance.normal(balance.root(ratio, bits));
    int size = 0;
    for (const Integer& e : m)
      if (!e.is_zero()) size = std::max(size, exact::log2_floor(e));
    for (const int kept : {bits / 2, bits}) {
      const Plane plane{{shifted(m[0], kept - size), shifted(m[1], kept - size), shifted(m[2], kept - size)}};
      if (!is_zero(plane.normal) && separates(agent_, obstacle_, motion_, plane.normal)) return plane;
    }
  }
  return std::nullopt;
}

std::optional<Plane> EllipsoidPair::plane() const {
  const bool moves = !is_zero(motion_.w);
  Guess line;
  if (moves) line = line_guess();
  const double time = moves && !std::isnan(line.time) ? line.time : to_double(motion_.from);
  const bool ahead =
      moves && time > to_double(motion_.from) && !(motion_.until && time >= to_double(*motion_.until));
  const Dyadic end = nearest(time);
  if (ahead) {
    if (auto plane = short_plane(line, true)) return plane;
  }
  const Guess still = guess_at(to_double(end));
  if (!ahead)
    if (auto plane = short_plane(still, false)) return plane;
  if (moves && line.contact > 1 - 1e-6)
    if (auto plane = exact_plane_across(line.ratio)) return plane;
  if (still.contact > 1 - 1e-6)
    if (auto plane = exact_plane_at(end, still.ratio)) return plane;
  if (moves)
    if (auto plane = exact_plane_across(line.ratio)) return plane;
  if (auto plane = exact_plane_at(motion_.from, guess_at(to_double(motion_.from)).ratio)) return plane;
  if (motion_.until) return exact_plane_at(*motion_.until, guess_at(to_double(*motion_.until)).ratio);
  return std::nullopt;
}

bool EllipsoidPair::is_common(const Meeting& meeting) const {
  const Dyadic& t = meeting.time;
  if (exact::compare(t, motion_.from) < 0) return false;
  if (motion_.until && exact::compare(t, *motion_.until) > 0) return false;
  const unsigned finer = std::max(meeting.finer, t.exponent);
  const auto holds = [&](const Convex& body, const Vector& v) {
    const Vector place = (body.points.front() << finer) + ((t.numerator * v) << (finer - t.exponent));
    return body.round->holds((meeting.point << (finer - meeting.finer)) - place, finer);
  };
  return holds(agent_, motion_.v_a) && holds(obstacle_, motion_.v_b);
}

namespace {

/// The least column: of the size of the body where it is thin.
double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return std::min(a.factor().colwise().norm().minCoeff(), b.factor().colwise().norm().minCoeff());
}

}  // namespace

std::optional<Meeting> EllipsoidPair::short_meeting(const Guess& guess) const {
  const double deep = 1 - std::sqrt(guess.contact), size = size_of(a_, b_);
  if (!(deep > 1e-14)) return std::nullopt;
  const double speed = w_.cwiseAbs().maxCoeff();
  int quantum = log2_of(deep * size) - 1, beat = speed > 0 ? log2_of(std::sqrt(deep) * size / speed) - 1 : 0;
  for (int tries = 0; tries < 8; ++tries, quantum -= 4, beat -= 4) {
    const double whole = std::ldexp(std::nearbyint(std::ldexp(guess.time, -beat)), beat);
    const Dyadic time = nearest(std::abs(std::ldexp(guess.time, -beat)) < 0x1p52 ? whole : guess.time);
    const double t = to_double(time);
    const Vector3d x = 0.5 * ((center_a_ + t * v_a_ + guess.on_a) + (center_b_ + t * v_b_ + guess.on_b));
    const auto finer = static_cast<unsigned>(std::max(0, motion_.grid - quantum));
    const auto point = rounded(x, quantum, motion_.grid, finer);
    if (!point) return std::nullopt;
    Meeting meeting{time, *point, finer};
    if (is_common(meeting)) return meeting;
  }
  return std::nullopt;
}

std::optional<Meeting> EllipsoidPair::exact_meeting(double ratio, double size) const {
  const ShadowMap shadow{motion_.w};
  const auto d = shadow.of(c_);
  const Balance<2> balance(shadow.of(agent_.round->shape()), shadow.of(obstacle_.round->shape()), d);
  const bool central = d[0].is_zero() && d[1].is_zero();
  for (const int bits : kRootBits) {
    const Dyadic x = central ? Dyadic::of(1) : balance.root(ratio, bits + 20);
    const auto m = balance.normal(x);
    const Vector n = plane_across(motion_.w, shadow.k, m[0], m[1]).normal;
    Integer below = balance.determinant(x);
    const Vector on_a = (agent_.round->shape() * n) << x.exponent;
    const Vector to_b = x.numerator * (obstacle_.round->shape() * n);
    Integer way = c_[shadow.k] * below - on_a[shadow.k] - to_b[shadow.k], pace = motion_.w[shadow.k] * below;
    if (pace.sign() < 0) way = -way, pace = -pace;
    // Time to half the digits: the point moves along the surfaces.
    const int beat = log2_of(size) - log2_of(w_.cwiseAbs().maxCoeff()) - bits / 2;
    Dyadic time{0, static_cast<unsigned>(std::max(0, -beat))};
    time.numerator = quotient(way, pace, beat, time.exponent);
    if (exact::compare(time, motion_.from) < 0) time = motion_.from;
    if (motion_.until && exact::compare(time, *motion_.until) > 0) time = *motion_.until;
    const Vector places = (agent_.points.front() + obstacle_.points.front()) << time.exponent;
    const Vector sum =
        below * (places + time.numerator * (motion_.v_a + motion_.v_b)) + ((on_a - to_b) << time.exponent);
    below <<= time.exponent + 1;
    const int quantum = log2_of(size) - bits - motion_.grid;  // in units of the grid
    Meeting meeting{time, {}, static_cast<unsigned>(std::max(0, -quantum))};
    for (int i = 0; i < 3; ++i) meeting.point[i] = quotient(sum[i], below, quantum, meeting.finer);
    if (is_common(meeting)) return meeting;
  }
  return std::nullopt;
}

std::optional<Meeting> EllipsoidPair::exact_meeting_at(const Dyadic& time, double ratio, double size) const {
  const Vector c = (c_ << time.exponent) - time.numerator * motion_.w;
  const Balance<3> balance(agent_.round->shape(), obstacle_.round->shape(), c);  // of c 2^time.exponent
  for (const int bits : kRootBits) {
    const Dyadic x = is_zero(c) ? Dyadic::of(1) : balance.root(ratio, bits + 20);
    const Vector n = balance.normal(x);
    const Vector on_a = (agent_.round->shape() * n) << x.exponent;
    const Vector to_b = x.numerator * (obstacle_.round->shape() * n);
    Integer below = balance.determinant(x);
    const Vector places = (agent_.points.front() + obstacle_.points.front()) << time.exponent;
    const Vector sum = below * (places + time.numerator * (motion_.v_a + motion_.v_b)) + (on_a - to_b);
    below <<= time.exponent + 1;
    const int quantum = log2_of(size) - bits - motion_.grid;
    Meeting meeting{time, {}, static_cast<unsigned>(std::max(0, -quantum))};
    for (int i = 0; i < 3; ++i) meeting.point[i] = quotient(sum[i], below, quantum, meeting.finer);
    if (is_common(meeting)) return meeting;
    if (bits > 600) break;
  }
  return std::nullopt;
}

std::optional<Meeting> EllipsoidPair::meeting() const {
  const bool moves = !is_zero(motion_.w);
  const double size = size_of(a_, b_), from = to_double(motion_.from);
  Guess line;
  if (moves) line = line_guess();
  const bool within = moves && line.time >= from && !(motion_.until && line.time > to_double(*motion_.until));
  if (within)
    if (auto meeting = short_meeting(line)) return meeting;
  const Dyadic time = nearest(moves ? line.time : from);
  const Guess still = guess_at(to_double(time));
  if (!within)
    if (auto meeting = short_meeting(still)) return meeting;
  if (moves)
    if (auto meeting = exact_meeting(line.ratio, size)) return meeting;
  if (auto meeting = exact_meeting_at(motion_.from, guess_at(from).ratio, size)) return meeting;
  if (motion_.until) return exact_meeting_at(*motion_.until, guess_at(to_double(*motion_.until)).ratio, size);
  return std::nullopt;
}

std::optional<Touch> EllipsoidPair::touch_of(const Vector& normal, const std::optional<Dyadic>& at) const {
  const Vector& n = normal;
  const Integer along = dot(n, motion_.w), q_a = agent_.round->square(n), q_b = obstacle_.round->square(n);
  Rational time = 0;
  if (at) time = to_rational(*at);
  const Rational gap = Rational(dot(n, c_)) - time * along;
  if (gap.sign() <= 0) return std::nullopt;
  Touch touch{n, (gap + Rational(q_a - q_b) / gap) / 2, (gap - Rational(q_a - q_b) / gap) / 2, time, {}};
  const Rational &rho_a = touch.agent_radius, &rho_b = touch.obstacle_radius;
  if (rho_a.sign() <= 0 || rho_b.sign() <= 0 || rho_a * rho_a != q_a || rho_b * rho_b != q_b)
    return std::nullopt;
  const Vector s_a = agent_.round->shape() * n, s_b = obstacle_.round->shape() * n;
  std::array<Rational, 3> way;  // from A's point to B's
  for (int i = 0; i < 3; ++i) way[i] = c_[i] - s_a[i] / rho_a - s_b[i] / rho_b;
  if (!at) {
    if (!along.is_zero()) return std::nullopt;
    const int k = largest_entry(motion_.w);
    touch.time = way[k] / motion_.w[k];
  }
  if (touch.time < to_rational(motion_.from)) return std::nullopt;
  if (motion_.until && touch.time > to_rational(*motion_.until)) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    if (way[i] != touch.time * motion_.w[i]) return std::nullopt;
    touch.point[i] = agent_.points.front()[i] + touch.time * motion_.v_a[i] + s_a[i] / rho_a;
  }
  return touch;
}

std::optional<Touch> EllipsoidPair::touch() const {
  if (!is_zero(motion_.w)) {
    const ShadowMap shadow{motion_.w};
    const auto d = shadow.of(c_);
    const Balance<2> balance(shadow.of(agent_.round->shape()), shadow.of(obstacle_.round->shape()), d);
    if (const auto x = balance.touching_root()) {
      const auto m = balance.normal(*x);
      const Vector n = primitive(plane_across(motion_.w, shadow.k, m[0], m[1]).normal);
      if (auto touch = touch_of(n, std::nullopt)) return touch;
    }
  }
  const auto still = [&](const Dyadic& time, int sign) -> std::optional<Touch> {
    const Vector c = (c_ << time.exponent) - time.numerator * motion_.w;
    const auto scaled = [&](Matrix s) {
      for (auto& row : s)
        for (Integer& e : row) e <<= 2 * time.exponent;
      return s;
    };
    const Balance<3> balance(scaled(agent_.round->shape()), scaled(obstacle_.round->shape()), c);
    const auto x = balance.touching_root();
    if (!x) return std::nullopt;
    const Vector n = primitive(balance.normal(*x));
    if (sign * dot(n, motion_.w).sign() < 0) return std::nullopt;
    return touch_of(n, time);
  };
  // Of one time alone they may be on their way in or out.
  const bool instant = motion_.until && exact::compare(motion_.from, *motion_.until) == 0;
  if (auto touch = still(motion_.from, instant ? 0 : -1)) return touch;
  return motion_.until ? still(*motion_.until, 1) : std::nullopt;
}

}  // namespace vericone::certificates
