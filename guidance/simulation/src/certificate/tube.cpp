// SPDX-License-Identifier: BSD-3-Clause
//
// A track is taken as spans of time, in each of which it is within a proved bound of a polynomial of degree 5
// (Spans). Segments of the certificate are fitted to them (least squares, however many spans they cover), and
// how far a fit is from each span is told by the Bernstein coefficients of their difference.
#include "certificate/tube.h"

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

namespace vericone::simulation::certified {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

/// Bernstein coefficients, one a column.
template <int D>
using Polynomial = Eigen::Matrix<double, D, Eigen::Dynamic>;

constexpr double kUp = 1 + 1e-9;
constexpr int kMostParts = 1 << 15;   // that one leg is cut into
constexpr double kShortest = 0x1p-8;  // s, of a segment that is halved no more

template <int D>
Eigen::Matrix<double, D, 1> value_at(Polynomial<D> p, double tau) {
  for (Eigen::Index n = p.cols() - 1; n > 0; --n)
    for (Eigen::Index k = 0; k < n; ++k) p.col(k) += tau * (p.col(k + 1) - p.col(k));
  return p.col(0);
}

/// On the part [from, to] of [0, 1], by de Casteljau.
template <int D>
Polynomial<D> part_of_polynomial(Polynomial<D> p, double from, double to) {
  const Eigen::Index n = p.cols() - 1;
  if (to < 1)
    for (Eigen::Index j = 1; j <= n; ++j)
      for (Eigen::Index k = n; k >= j; --k) p.col(k) = p.col(k - 1) + to * (p.col(k) - p.col(k - 1));
  if (from > 0) {
    const double s = from / to;
    for (Eigen::Index j = 1; j <= n; ++j)
      for (Eigen::Index k = 0; k + j <= n; ++k) p.col(k) += s * (p.col(k + 1) - p.col(k));
  }
  return p;
}

template <int D>
Polynomial<D> of_degree(Polynomial<D> p, Eigen::Index degree) {
  while (p.cols() - 1 < degree) {
    const Eigen::Index n = p.cols();  // the new degree
    Polynomial<D> q(D, n + 1);
    q.col(0) = p.col(0);
    q.col(n) = p.col(n - 1);
    for (Eigen::Index k = 1; k < n; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(n);
      q.col(k) = share * p.col(k - 1) + (1 - share) * p.col(k);
    }
    p = q;
  }
  return p;
}

/// Of degree 5, with these values and derivatives (per second) at both ends.
template <int D>
Polynomial<D> hermite(const Eigen::Matrix<double, D, 3>& first, const Eigen::Matrix<double, D, 3>& last,
                      double h) {
  Polynomial<D> p(D, 6);
  p.col(0) = first.col(0);
  p.col(1) = first.col(0) + h / 5 * first.col(1);
  p.col(2) = first.col(0) + 2 * h / 5 * first.col(1) + h * h / 20 * first.col(2);
  p.col(3) = last.col(0) - 2 * h / 5 * last.col(1) + h * h / 20 * last.col(2);
  p.col(4) = last.col(0) - h / 5 * last.col(1);
  p.col(5) = last.col(0);
  return p;
}

/// What some hundred operations on these numbers round.
template <int D>
double rounding(const Polynomial<D>& p) {
  return 1e-13 * p.cwiseAbs().maxCoeff();
}

/// A span of time in which a track is within the errors of polynomials of degree 5.
struct Span {
  double from, to;
  Polynomial<3> position;
  Polynomial<4> turn;
  double position_error = 0, turn_error = 0;  // m, and of the unit quaternion
  bool begins_leg = false;                    // accelerations may jump at its start
};

Vector4d wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Vector4d quaternion_of(const Matrix3d& rotation) { return wxyz(Eigen::Quaterniond(rotation).normalized()); }

/// (0, u) q.
Vector4d turned_by(const Vector3d& u, const Vector4d& q) {
  return wxyz(Eigen::Quaterniond(0, u.x(), u.y(), u.z()) * Eigen::Quaterniond(q(0), q(1), q(2), q(3)));
}

/// An arc's motion is z' = s exp(i chi), s' = l, chi' = a / s in its plane, so the derivative of order k + 2
/// of z is (l + i a) prod_{j<k} (i a - j l) / s^k exp(i chi); the quaternion is exp(i chi / 2) q, its
/// derivative of order k prod_{j<k} (i a / 2 - j l) / s^k times that.
struct ArcRates {
  double longitudinal, lateral, speed;  // m/s^2, m/s^2, m/s: the least
  Vector3d axis;

  /// Of the sixth derivatives: quintics of Hermite are within h^6 / 46080 of these.
  [[nodiscard]] double position_sixth() const {
    double most = std::hypot(longitudinal, lateral);
    for (int j = 0; j < 4; ++j) most *= std::hypot(lateral, j * longitudinal) / speed;
    return most * kUp;
  }
  [[nodiscard]] double turn_sixth() const {
    double most = 1;
    for (int j = 0; j < 6; ++j) most *= std::hypot(lateral / 2, j * longitudinal) / speed;
    return most * kUp;
  }
};

/// How to cut a leg, and what bounds it.
class LegSpans {
 public:
  LegSpans(const Leg& leg, Orientation orientation, const TubeQuestion& question)
      : leg_(leg),
        question_(question),
        turns_(question.turns_matter && leg.most_turn_rate() > 0),
        arc_(dynamic_cast<const Arc*>(&leg) != nullptr) {
    if (arc_ && leg.accelerated()) take_arc(orientation);
    if (!turns_) return;
    if (arc_ && orientation == Orientation::heading && smooth_) {
      follows_ = true;
      turn_bound_ = rates_.turn_sixth() / 46080;
      turn_order_ = 6;
    } else {
      // A chord of q: |q''| <= |Omega'| / 2 + |Omega|^2 / 4, over 8.
      turn_bound_ = turn_acceleration(orientation) / 16;
      turn_order_ = 2;
    }
  }

  [[nodiscard]] bool known() const { return std::isfinite(turn_bound_) && std::isfinite(position_bound_); }

  void append(std::vector<Span>& spans) const {
    const double whole = leg_.to() - leg_.from();
    int parts = 1;
    while (parts < kMostParts && too_long(whole / parts)) parts *= 2;
    double from = leg_.from();
    for (int k = 1; k <= parts; ++k) {
      const double to = k == parts ? leg_.to() : leg_.from() + whole * k / parts;
      if (from < to && to > question_.from && from < question_.to) {
        spans.push_back(span(from, to, spans));
        spans.back().begins_leg = k == 1;
      }
      from = to;
    }
  }

 private:
  void take_arc(Orientation orientation) {
    rates_ = Simulated(leg_, leg_.from()).rates();
    // Linear while the acceleration is carried along; one that brakes beyond rest is below 0 here.
    const double end_speed = rates_.speed + rates_.longitudinal * (leg_.to() - leg_.from());
    rates_.speed = std::min(rates_.speed, end_speed);
    constexpr double kSlow = 4e-3;  // m/s: bodies come to rest at a quarter of it
    const bool straight = rates_.lateral <= 1e-13 * leg_.most_acceleration();
    smooth_ = straight || rates_.speed > kSlow;
    if (!straight && smooth_) {
      position_bound_ = rates_.position_sixth() / 46080;
      position_order_ = 6;
    } else if (!smooth_) {  // the chord
      position_bound_ = leg_.most_acceleration() / 8;
      position_order_ = 2;
    }
    if (straight && orientation != Orientation::fixed && leg_.most_turn_rate() > 0) smooth_ = false;
  }

  /// Not below |Omega'| + |Omega|^2.
  [[nodiscard]] double turn_acceleration(Orientation orientation) const {
    if (!arc_ || orientation != Orientation::level || !smooth_) return leg_.most_turn_acceleration();
    // The frame's azimuth and elevation: with c the cosine of the elevation and omega the rate of the
    // velocity's direction, |azimuth''| <= |omega'| / c + 2 omega^2 / c^2, |elevation''| <= |omega'| + 2
    // omega^2 / c, and the elevation's axis turns with the azimuth.
    const double omega = rates_.lateral / rates_.speed,
                 change = omega * std::abs(rates_.longitudinal) / rates_.speed;
    const double secant = std::max(1.0, leg_.most_turn_rate() / omega);
    const double rate = leg_.most_turn_rate();
    return kUp * (change * (1 + secant) + omega * omega * (2 * secant * secant + 3 * secant) + rate * rate);
  }

  [[nodiscard]] bool too_long(double h) const {
    const double tolerance = question_.tolerance / 16;
    return (turns_ && h * leg_.most_turn_rate() > 1) ||
           position_bound_ * std::pow(h, position_order_) > tolerance ||
           2 * question_.reach * turn_bound_ * std::pow(h, turn_order_) > tolerance;
  }

  /// The leg at a time.
  struct Simulated {
    Motion motion;
    Vector3d acceleration;
    Simulated(const Leg& leg, double t) : motion(leg.at(t)), acceleration(leg.acceleration(t)) {}
    [[nodiscard]] double speed() const { return motion.velocity.norm(); }
    [[nodiscard]] ArcRates rates() const {
      const double s = speed();
      if (s == 0) return {acceleration.norm(), 0, s, Vector3d::Zero()};
      const Vector3d ahead = motion.velocity / s;
      const double along = acceleration.dot(ahead);
      const Vector3d axis = ahead.cross(acceleration);
      return {along, axis.norm(), s, axis.norm() > 0 ? Vector3d(axis.normalized()) : Vector3d::Zero()};
    }
    [[nodiscard]] Eigen::Matrix3d jet() const {
      Eigen::Matrix3d jet;
      jet << motion.position, motion.velocity, acceleration;
      return jet;
    }
    /// Of the quaternion, where the body follows its velocity.
    [[nodiscard]] Eigen::Matrix<double, 4, 3> turn_jet(const Vector4d& q) const {
      const ArcRates now = rates();
      const double omega = now.lateral / now.speed, change = -omega * now.longitudinal / now.speed;
      Eigen::Matrix<double, 4, 3> jet;
      jet << q, 0.5 * omega * turned_by(now.axis, q),
          0.5 * change * turned_by(now.axis, q) - 0.25 * omega * omega * q;
      return jet;
    }
  };

  [[nodiscard]] Span span(double from, double to, const std::vector<Span>& before) const {
    const double h = to - from;
    const Simulated first(leg_, from), last(leg_, to);
    Span span{from, to, {}, {}};
    if (position_order_ == 2) {
      Polynomial<3> chord(3, 2);
      chord << first.motion.position, last.motion.position;
      span.position = of_degree<3>(chord, 5);
    } else {
      span.position = hermite<3>(first.jet(), last.jet(), h);
    }
    span.position_error =
        position_bound_ * std::pow(h, position_order_) * kUp + 10 * rounding<3>(span.position);
    Vector4d q = quaternion_of(first.motion.rotation);
    if (!before.empty() && before.back().turn.col(5).dot(q) < 0) q = -q;
    Vector4d after = turns_ ? quaternion_of(last.motion.rotation) : q;
    if (after.dot(q) < 0) after = -after;
    if (follows_) {
      span.turn = hermite<4>(first.turn_jet(q), last.turn_jet(after), h);
    } else {
      Polynomial<4> chord(4, 2);
      chord << q, after;
      span.turn = of_degree<4>(chord, 5);
    }
    span.turn_error = turn_bound_ * std::pow(h, turn_order_) * kUp + 1e-12;
    return span;
  }

  const Leg& leg_;
  const TubeQuestion& question_;
  bool turns_, arc_, smooth_ = true, follows_ = false;
  ArcRates rates_{};
  double position_bound_ = 0, turn_bound_ = 0;
  int position_order_ = 6, turn_order_ = 2;
};

std::vector<Span> spans_of(const Track& track, const TubeQuestion& question, bool& known) {
  std::vector<Span> spans;
  for (const auto& leg : track.legs()) {
    if (!(leg->to() > question.from) || !(leg->from() < question.to)) continue;
    const LegSpans parts(*leg, track.orientation(), question);
    known = known && parts.known();
    if (!known) break;
    parts.append(spans);
  }
  return spans;
}

/// Least squares by Bernstein polynomials at Chebyshev's points.
class Fit {
 public:
  static constexpr int kPoints = 24;

  static const Fit& of(int degree) {
    static const std::array<Fit, 6> kFits{Fit(0), Fit(1), Fit(2), Fit(3), Fit(4), Fit(5)};
    return kFits[static_cast<std::size_t>(degree)];
  }
  static double point(int i) { return 0.5 - 0.5 * std::cos((i + 0.5) / kPoints * 3.14159265358979); }

  /// `values`: one a column.
  template <int D>
  [[nodiscard]] Polynomial<D> operator()(const Eigen::Matrix<double, D, kPoints>& values) const {
    return values * inverse_.transpose();
  }

 private:
  explicit Fit(int degree) {
    Eigen::MatrixXd basis(kPoints, degree + 1);
    for (int k = 0; k <= degree; ++k) {
      Polynomial<1> one = Polynomial<1>::Zero(1, degree + 1);
      one(0, k) = 1;
      for (int i = 0; i < kPoints; ++i) basis(i, k) = value_at<1>(one, point(i))(0);
    }
    inverse_ = basis.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(kPoints, kPoints));
  }
  Eigen::MatrixXd inverse_;
};

class Tube {
 public:
  Tube(const std::vector<Span>& spans, const TubeQuestion& question, bool turned)
      : spans_(spans), question_(question), turned_(turned) {
    double most = 1;
    for (const Span& span : spans) most = std::max(most, span.position.cwiseAbs().maxCoeff());
    const int finest = 52 - std::ilogb(2 * most),
              wanted = 8 - std::ilogb(question.tolerance / (1 + question.reach));
    stated_.grid = std::clamp(std::min(finest, wanted), 0, 50);
    stated_.turned = turned;
  }

  StatedTrack made() {
    double root = 1;
    while (root < question_.to - question_.from) root *= 2;
    stated_.times.push_back(question_.from);
    for (double t = std::floor(question_.from / root) * root; t < question_.to; t += root)
      divide(t, t + root);
    stated_.radius = rounded_up(position_error_ + 2 * question_.reach * turn_error_ + 2 * question_.padding);
    return std::move(stated_);
  }

 private:
  static double rounded_up(double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.3e", 1.002 * x);
    return std::strtod(digits, nullptr);
  }

  /// A dyadic interval, cut to what is asked about.
  void divide(double first, double last) {
    const double from = std::max(first, question_.from), to = std::min(last, question_.to);
    if (!(from < to)) return;
    checkpoint();
    const bool shortest = last - first <= kShortest;
    const Fitted<3> position = fitted<3>(from, to, question_.tolerance / 2, 1);
    const bool near = position.error <= question_.tolerance / 2;
    if (near || shortest) {
      const double allowed = question_.tolerance / (4 * question_.reach);
      const Fitted<4> turn = turned_ ? fitted<4>(from, to, allowed, 0) : Fitted<4>{};
      if (turn.error <= allowed || shortest) return take(position, turn, to);
    }
    const double middle = cut(first, last, from, to);
    divide(first, middle);
    divide(middle, last);
  }

  /// The middle of an interval; of a short one the time at which a command changes, where one does:
  /// polynomials do not follow that.
  [[nodiscard]] double cut(double first, double last, double from, double to) const {
    constexpr double kShort = 0x1p-5;  // s
    if (last - first <= kShort)
      for (auto span = first_at(from); span != spans_.end() && span->from < to; ++span)
        if (span->begins_leg && span->from > from) return span->from;
    return 0.5 * (first + last);
  }

  template <int D>
  struct Fitted {
    Polynomial<D> p;  // in units of the grid, whole numbers
    double error = 0;
  };

  template <int D>
  void add(const Polynomial<D>& p, std::vector<std::array<std::int64_t, D>>& list) const {
    for (Eigen::Index k = 0; k < p.cols(); ++k) {
      std::array<std::int64_t, D> c;
      for (int i = 0; i < D; ++i) c[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(p(i, k));
      list.push_back(c);
    }
  }

  void take(const Fitted<3>& position, const Fitted<4>& turn, double to) {
    position_error_ = std::max(position_error_, position.error);
    turn_error_ = std::max(turn_error_, turn.error);
    stated_.times.push_back(to);
    Segment segment;
    add<3>(position.p, segment.position);
    if (turned_) add<4>(turn.p, segment.turn);
    stated_.segments.push_back(std::move(segment));
  }

  /// Of the least degree that comes as near as allowed.
  template <int D>
  Fitted<D> fitted(double from, double to, double allowed, int least) const {
    Eigen::Matrix<double, D, Fit::kPoints> values;
    auto span = first_at(from);
    for (int i = 0; i < Fit::kPoints; ++i) {
      const double t = from + (to - from) * Fit::point(i);
      while (span->to < t && span + 1 != spans_.end()) ++span;
      values.col(i) = value_at<D>(polynomial<D>(*span), (t - span->from) / (span->to - span->from));
    }
    Fitted<D> best;
    const double unit = std::ldexp(1.0, -stated_.grid);
    for (int degree = least; degree <= 5; degree += degree % 2 == 1 ? 2 : 1) {
      Fitted<D> now{Fit::of(degree).template operator()<D>(values), 0};
      now.p = (now.p / unit).array().round().matrix();
      now.error = error<D>(now.p * unit, from, to);
      if (best.p.cols() == 0 || now.error < best.error) best = now;
      if (best.error <= allowed) break;
    }
    return best;
  }

  template <int D>
  static const Polynomial<D>& polynomial(const Span& span) {
    if constexpr (D == 3)
      return span.position;
    else
      return span.turn;
  }

  [[nodiscard]] std::vector<Span>::const_iterator first_at(double t) const {
    const auto after = std::upper_bound(spans_.begin(), spans_.end(), t,
                                        [](double time, const Span& span) { return time < span.from; });
    return after == spans_.begin() ? after : after - 1;
  }

  /// How far the track may be from p, proved: the largest coefficient of the difference, and the span's
  /// error.
  template <int D>
  double error(const Polynomial<D>& p, double from, double to) const {
    double most = 0;
    for (auto span = first_at(from); span != spans_.end() && span->from < to; ++span) {
      const double a = std::max(from, span->from), b = std::min(to, span->to), h = span->to - span->from;
      if (!(a < b)) continue;
      const Polynomial<D> whole = of_degree<D>(p, 5);
      const Polynomial<D> mine =
          part_of_polynomial<D>(whole, (a - from) / (to - from), (b - from) / (to - from));
      const Polynomial<D> its =
          part_of_polynomial<D>(polynomial<D>(*span), (a - span->from) / h, (b - span->from) / h);
      const double own = D == 3 ? span->position_error : span->turn_error;
      most =
          std::max(most, (mine - its).colwise().norm().maxCoeff() + own + rounding<D>(p) + rounding<D>(its));
    }
    return most;
  }

  const std::vector<Span>& spans_;
  const TubeQuestion& question_;
  bool turned_;
  StatedTrack stated_;
  double position_error_ = 0, turn_error_ = 0;
};

/// Of what does not move.
StatedTrack at_rest(const Motion& motion, const TubeQuestion& question) {
  Span span{question.from, question.to, Polynomial<3>(3, 6), Polynomial<4>(4, 6)};
  span.position.colwise() = motion.position;
  span.turn.colwise() = quaternion_of(motion.rotation);
  const bool turned = question.turns_matter && motion.rotation != Matrix3d::Identity();
  const std::vector<Span> spans{span};
  return Tube(spans, question, turned).made();
}

Polynomial<3> position_of(const StatedTrack& track, std::size_t segment) {
  const auto& its = track.segments[segment].position;
  const double unit = std::ldexp(1.0, -track.grid);
  Polynomial<3> p(3, static_cast<Eigen::Index>(its.size()));
  for (std::size_t k = 0; k < its.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) p(i, k) = unit * static_cast<double>(its[k][i]);
  return p;
}

}  // namespace

std::optional<StatedTrack> tube(const Track& track, const TubeQuestion& question) {
  if (track.legs().empty()) return at_rest(track.motion(track.appears()), question);
  bool known = true;
  const std::vector<Span> spans = spans_of(track, question, known);
  if (!known) return std::nullopt;
  const bool upright = std::all_of(spans.begin(), spans.end(), [](const Span& span) {
    return (span.turn.colwise() - Vector4d(1, 0, 0, 0)).isZero(0) ||
           (span.turn.colwise() + Vector4d(1, 0, 0, 0)).isZero(0);
  });
  return Tube(spans, question, question.turns_matter && !upright).made();
}

Placement placement(const StatedTrack& track, std::size_t segment, double t) {
  const Segment& its = track.segments[segment];
  const double from = track.times[segment], tau = (t - from) / (track.times[segment + 1] - from);
  Placement found{value_at<3>(position_of(track, segment), tau), Matrix3d::Identity()};
  if (!track.turned) return found;
  Polynomial<4> q(4, static_cast<Eigen::Index>(its.turn.size()));
  for (std::size_t k = 0; k < its.turn.size(); ++k)
    for (std::size_t i = 0; i < 4; ++i) q(i, k) = static_cast<double>(its.turn[k][i]);
  const Vector4d at = value_at<4>(q, tau);
  found.rotation = Eigen::Quaterniond(at(0), at(1), at(2), at(3)).normalized().toRotationMatrix();
  return found;
}

std::vector<Vector3d> control_points(const StatedTrack& track, double from, double to) {
  const std::size_t k = track.segment_of(from, to);
  const double first = track.times[k], length = track.times[k + 1] - first;
  const Polynomial<3> p =
      part_of_polynomial<3>(position_of(track, k), (from - first) / length, (to - first) / length);
  std::vector<Vector3d> points;
  for (Eigen::Index i = 0; i < p.cols(); ++i) points.emplace_back(p.col(i));
  return points;
}

Placement placement_at(const StatedTrack& track, double t) {
  return placement(track, std::min(track.segment_of(t, t), track.segments.size() - 1), t);
}

}  // namespace vericone::simulation::certified
