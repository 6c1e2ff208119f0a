// SPDX-License-Identifier: BSD-3-Clause
#include "motion/path.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kWider = 1 + 1e-12;

void require_finite(const Vector3d& v, const std::string& field, const char* unit) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(v(i)))
      throw InputError(field + "[" + std::to_string(i) + "]", to_text(v(i)),
                       std::string("a finite number (") + unit + ")");
}

void require_motion(const BodyMotion& motion, const std::string& name) {
  require_finite(motion.velocity, name + ".velocity", "m/s");
  require_finite(motion.acceleration, name + ".acceleration", "m/s^2");
  require_finite(motion.spin, name + ".spin", "rad/s");
  if (motion.center) require_finite(*motion.center, name + ".center", "m");
  if (!(motion.braking >= 0) || !std::isfinite(motion.braking))
    throw InputError(name + ".braking", to_text(motion.braking), "not negative (m/s^2)");
  if (motion.braking > 1e300)
    throw InputError(name + ".braking", to_text(motion.braking), "at most 1e300 (m/s^2)");
  if (motion.braking > 0 && !motion.acceleration.isZero(0))
    throw InputError(name + ".braking", to_text(motion.braking), "left out beside an acceleration");
}

Vector3d center_of(const Placed& placed) {
  if (const CombinedEllipsoid* quadric = placed.body.quadric())
    return placed.pose.to_world(quadric->center());
  // An ellipsoid with a margin.
  if (const Convex* convex = placed.body.convex(); convex && convex->pieces().size() == 1)
    if (const Convex::Piece& only = convex->pieces().front(); only.rank == 3)
      return placed.pose.to_world(only.center);
  return placed.pose.position;
}

/// The farthest a point of the body is from `from`, in its frame; rounded.
double farthest(const Body& body, const Vector3d& from) {
  const Box box = body.bounds();
  double most = (box.low - from).cwiseAbs().cwiseMax((box.high - from).cwiseAbs()).norm();
  const auto points = [&](const std::vector<Vector3d>& all, double margin) {
    double far = 0;
    for (const Vector3d& x : all) far = std::max(far, (x - from).norm());
    most = std::min(most, far + margin);
  };
  if (const auto* quadric = body.quadric()) {
    most = std::min(most, (quadric->center() - from).norm() + quadric->ellipsoid().semi_axes().maxCoeff());
  } else if (const auto* hull = body.hull()) {
    points(hull->points(), 0);
  } else if (const auto* convex = body.convex()) {
    double far = 0;
    for (const Convex::Piece& piece : convex->pieces()) {
      const double squared = symmetric_eigenvalues<3>(piece.factor * piece.factor.transpose()).maxCoeff();
      far = std::max(far, (piece.center - from).norm() + std::sqrt(std::max(squared, 0.0)));
    }
    most = std::min(most, far + convex->margin());
  } else if (const auto* assembly = body.assembly(); assembly && assembly->kind() != PieceKind::convex) {
    points(assembly->corners(), assembly->radius());
  }
  return most;
}

/// How far the surface of a delimited body may come to lie elsewhere when its delimiters are turned in
/// doubles: y^T M y changes by up to 16 roundings of |M| |y|^2. With the level positive y / sqrt(1 + change /
/// level) is in the body (it is a star about its center); without one a step along the most negative axis of
/// M and one towards the center lead into it.
double delimiters_rounding(const CombinedEllipsoid& body) {
  double most = 0;
  const double r = body.ellipsoid().semi_axes().maxCoeff();
  for (const Delimiter<3>& d : body.delimiters()) {
    const double change = 16 * kEps * d.matrix.norm();
    const double negative = -symmetric_eigenvalues<3>(d.matrix).minCoeff();
    const double by_level = d.level > 0 ? r * (0.5 * change * r * r / d.level) : kNever;
    const double by_axis = negative > 0 ? 4 * r * std::sqrt(change / negative) : kNever;
    most = std::max(most, std::min(by_level, by_axis));
  }
  return most;
}

/// Whether turning about z through `center` leaves a body as it is; of its numbers as they are stored, so no
/// turned body is.
bool is_round(const Body& body, const Pose& pose, const Vector3d& center, const Vector3d& spin) {
  if (pose.rotation != Matrix3d::Identity()) return false;
  const Vector3d from = center - pose.position;
  if (pose.position + from != center) return false;
  const auto axial = [&](const Vector3d& p, const Matrix3d& f, bool sphere) {
    const Matrix3d diagonal = f.diagonal().asDiagonal();
    if (f != diagonal || std::abs(f(0, 0)) != std::abs(f(1, 1))) return false;
    if (p.x() != from.x() || p.y() != from.y()) return false;
    return !sphere || (p == from && std::abs(f(2, 2)) == std::abs(f(0, 0)));
  };
  const bool sphere = spin.x() != 0 || spin.y() != 0;
  if (const auto* quadric = body.quadric())
    return quadric->is_ellipsoid() && axial(quadric->center(), quadric->ellipsoid().factor(), sphere) &&
           axial(quadric->center(), quadric->ellipsoid().shape(), sphere);
  if (const auto* convex = body.convex())
    return std::all_of(convex->pieces().begin(), convex->pieces().end(), [&](const Convex::Piece& piece) {
      return !piece.shape && axial(piece.center, piece.factor, sphere);
    });
  return false;
}

}  // namespace

Matrix3d turn(const Vector3d& w) {
  const double angle = w.stableNorm();
  if (angle == 0) return Matrix3d::Identity();
  const Vector3d u = w / angle;
  const double s = std::sin(angle), half = std::sin(0.5 * angle), c = 2 * half * half;
  Matrix3d k;
  k << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
  return Matrix3d::Identity() + s * k + c * (k * k);
}

Path::Path(const Placed& body, const BodyMotion& motion, const std::string& name)
    : whole_(body.body),
      start_(body.pose),
      velocity_(motion.velocity),
      acceleration_(motion.acceleration),
      spin_(motion.spin),
      stop_(kNever) {
  require_motion(motion, name);
  center_ = motion.center.value_or(center_of(body));
  if (const auto* quadrics = body.body.quadrics())
    bodies_.assign(quadrics->begin(), quadrics->end());
  else
    bodies_.push_back(body.body);
  for (const Body& part : bodies_)
    if (const auto* quadric = part.quadric())
      rounded_once_ = std::max(rounded_once_, delimiters_rounding(*quadric));
  if (motion.braking > 0) {
    const double speed = velocity_.stableNorm();
    stop_ = speed / motion.braking;
    if (speed > 0) acceleration_ = velocity_ * (-motion.braking / speed);
  }
  if (is_round(whole_, start_, center_, spin_)) spin_.setZero();
  rate_ = spin_.stableNorm() * kWider;
  const Vector3d from = start_.to_body(center_);
  reach_ = farthest(whole_, from) * kWider + 8 * kEps * (center_.norm() + start_.position.norm());
  rotation_ = orthonormal<3>(start_.rotation);
  rounded_once_ += (rotation_ - start_.rotation).norm() * (reach_ + from.norm());
}

Vector3d Path::shift(double t) const {
  if (t == 0) return Vector3d::Zero();
  const double until = std::min(t, stop_);
  return velocity_ * until + acceleration_ * (0.5 * until * until);
}

Course Path::course(double t) const {
  const Vector3d center = center_ + shift(t);
  if (t >= stop_) return {center, Vector3d::Zero(), Vector3d::Zero()};
  return {center, velocity_ + acceleration_ * t, acceleration_};
}

Pose Path::pose(double t, const Vector3d& center) const {
  if (spin_.isZero(0)) return {center - center_ + start_.position, start_.rotation};
  const Matrix3d r = turn(spin_ * t);
  return {center + r * (start_.position - center_), r * rotation_};
}

std::vector<Placed> Path::parts(double t) const {
  Pose at = start_;
  if (t > 0) {
    at = pose(t, center_ + shift(t));
    // What does not turn moves without rounding its place twice.
    if (spin_.isZero(0)) at.position = start_.position + shift(t);
  }
  std::vector<Placed> result;
  for (const Body& body : bodies_) result.emplace_back(body, at);
  return result;
}

Placed Path::about_center(double t) const {
  const Matrix3d r = turn(spin_ * t);
  return {whole_, {r * (start_.position - center_), r * rotation_}};
}

double Path::rounding(double t) const {
  const double until = std::min(t, stop_);
  const double way = velocity_.norm() * until + 0.5 * acceleration_.stableNorm() * until * until;
  // The angle and its sine and cosine, the product with the rotation, the points, the center and its way.
  const double turning = reach_ * (64 + 8 * rate_ * t);
  const double places = 32 * (2 * center_.norm() + start_.position.norm() + way + reach_);
  return kEps * (turning + places) + rounded_once_;
}

}  // namespace vericone::motion
