// SPDX-License-Identifier: BSD-3-Clause
//
// Trajectories as curves: Hermite's quintic from the values and two derivatives at both ends of a piece of
// time, which is the polynomial itself up to degree 5. Ends of pieces that miss each other by rounding meet
// in their middle; where both end values of a quintic move by at most d, it moves by at most d all over.
#include <vericone/geometry/error.h>
#include <vericone/simulation/trajectory.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "foreign/bernstein.h"
#include "foreign/pieces.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNear = 1e-9;  // m, rad: of quintics to polynomials of higher degree
constexpr double kFitRounding =
    1e-13;  // of the largest coordinate in what a quintic is made and evaluated by
constexpr int kMostHalvings = 24;

/// A vector in one piece of time.
struct TrackPart {
  ControlPoints points;
  Vector3d first, last;  // where it is to begin and end
};

/// A piecewise polynomial while it is cut into curves.
class Cut {
 public:
  /// `name`: of the input that it is.
  Cut(const Piecewise& of, const char* name, double join) : of_(of), name_(name), join_(join) {
    require_pieces(of, name, name);
    for (const ControlPoints& piece : of.points) size_ = std::max(size_, most_of(piece));
  }

  [[nodiscard]] const std::vector<double>& times() const { return of_.times; }
  [[nodiscard]] double error() const { return error_ + of_.error + kFitRounding * size_; }
  [[nodiscard]] std::size_t piece_at(double t) const {
    const auto after = std::upper_bound(of_.times.begin(), of_.times.end(), t);
    return std::min<std::size_t>(static_cast<std::size_t>(after - of_.times.begin()) - 1,
                                 of_.points.size() - 1);
  }

  /// Where two pieces meet both end in the middle between them, unless `apart` says that each has a frame of
  /// its own.
  [[nodiscard]] TrackPart part(double from, double to, bool apart) {
    const std::size_t k = piece_at(from);
    const double begin = of_.times[k], h = of_.times[k + 1] - begin;
    TrackPart part{
        part_of(of_.points[k], (from - begin) / h, to == of_.times[k + 1] ? 1 : (to - begin) / h), {}, {}};
    part.first = part.points.front();
    part.last = part.points.back();
    if (apart) return part;
    if (from == begin && k > 0) part.first = joined(k);
    if (to == of_.times[k + 1] && k + 1 < of_.points.size()) part.last = joined(k + 1);
    return part;
  }

  /// Whether a quintic is near enough to the part; notes how near where it is taken.
  [[nodiscard]] bool near(const TrackPart& part) const { return sixth(part.points) <= kNear; }
  void take(const TrackPart& part) { error_ = std::max(error_, missed_ + sixth(part.points)); }

 private:
  [[nodiscard]] std::string where(std::size_t i) const {
    return std::string(name_) + "[" + std::to_string(i) + "]";
  }

  /// Half of what two pieces miss each other by counts as error.
  Vector3d joined(std::size_t k) {
    const Vector3d &before = of_.points[k - 1].back(), &after = of_.points[k].front();
    const double missed = (after - before).norm();
    if (!(missed <= join_ + kFitRounding * size_))
      throw InputError(where(k), "begins " + to_text(missed) + " from where the piece before ends",
                       "within " + to_text(join_) + " of it, at " + to_text(of_.times[k]) + " s");
    missed_ = std::max(missed_, 0.5 * missed);
    return 0.5 * (before + after);
  }

  /// Hermite's quintic is within duration^6 / 46080 times the sixth derivative.
  static double sixth(ControlPoints p) {
    for (int i = 0; i < 6; ++i) p = derivative_of(p);
    return most_of(p) / 46080;
  }

  const Piecewise& of_;
  const char* name_;
  double join_;
  double size_ = 0, error_ = 0, missed_ = 0;
};

Quintic quintic_of(const TrackPart& part, double duration) {
  const ControlPoints first = derivative_of(part.points), second = derivative_of(first);
  const double h = duration;
  return quintic({part.first, first.front() / h, second.front() / (h * h)},
                 {part.last, first.back() / h, second.back() / (h * h)}, h);
}

/// A curve's bounds are those of all of it: shorter ones where the largest control point of the second
/// derivative says much more than its values do.
bool even(const ControlPoints& points) {
  constexpr double kLoose = 1.4;
  const ControlPoints second = derivative_of(derivative_of(points));
  const double reached =
      std::max({second.front().norm(), second.back().norm(), value_at(second, 0.5).norm()});
  return most_of(second) <= kLoose * reached;
}

class Fitter {
 public:
  Fitter(const ShapeInTime& shape, const Trajectory& of, double join)
      : of_(of), position_(of.position, "position", join) {
    if (of.turned) turned_.emplace(*of.turned, "turned", join);
    require_turns();
    if (planar(shape)) require_flat();
    Motion start{of.position.points.front().front(), Vector3d::Zero(), rotation(of.position.from())};
    if (turned_) start.rotation = turned_from(of.turned->at(of.position.from())) * start.rotation;
    track_.emplace(shape, start, Orientation::fixed, of.position.from());
  }

  FittedTrack fitted() {
    std::set<double> times(position_.times().begin(), position_.times().end());
    if (turned_)
      for (const double t : turned_->times())
        if (t > of_.position.from() && t < of_.position.to()) times.insert(t);
    for (auto t = times.begin(); std::next(t) != times.end(); ++t)
      divide(*t, *std::next(t), kMostHalvings, 3);
    return {std::move(*track_), position_.error(), turned_ ? turned_->error() : 0};
  }

 private:
  static Matrix3d turned_from(const Vector3d& by) {
    const double angle = by.norm();
    return angle == 0 ? Matrix3d::Identity() : Matrix3d(Eigen::AngleAxisd(angle, by / angle));
  }

  void require_turns() const {
    const std::size_t count = of_.rotation.size();
    if (count != 1 && !(turned_ && count == of_.turned->points.size()))
      throw InputError("rotation", std::to_string(count) + " of them",
                       "one, or one for each piece of turned");
    for (const Matrix3d& r : of_.rotation)
      if (!is_rotation(r)) throw InputError("rotation", "a matrix that is none", "rotations");
    if (!turned_) return;
    if (!(of_.turned->from() <= of_.position.from()) || !(of_.turned->to() >= of_.position.to()))
      throw InputError("turned",
                       "from " + to_text(of_.turned->from()) + " to " + to_text(of_.turned->to()) + " s",
                       "all the time of position, from " + to_text(of_.position.from()) + " to " +
                           to_text(of_.position.to()) + " s");
  }

  void require_flat() const {
    const auto level = [](const Piecewise& p, bool across) {
      for (const ControlPoints& points : p.points)
        for (const Vector3d& x : points)
          if (across ? x.z() != 0 : !(x.head<2>().norm() <= 1e-12)) return false;
      return true;
    };
    if (!level(of_.position, true))
      throw InputError("position", "not in the plane", "z = 0, of a planar body");
    if (turned_ && !level(*of_.turned, false))
      throw InputError("turned", "not about z", "about z, of a planar body");
    for (const Matrix3d& r : of_.rotation)
      if (!(r(2, 2) >= 1 - 1e-12)) throw InputError("rotation", "not about z", "about z, of a planar body");
  }

  [[nodiscard]] const Matrix3d& rotation(double t) const {
    return of_.rotation.size() == 1 ? of_.rotation.front() : of_.rotation[turned_->piece_at(t)];
  }

  void divide(double from, double to, int halvings, int to_be_even) {
    checkpoint();
    const bool frames = of_.rotation.size() > 1;
    const TrackPart position = position_.part(from, to, false);
    const TrackPart turned =
        turned_ ? turned_->part(from, to, frames) : TrackPart{{Vector3d::Zero()}, {}, {}};
    const double middle = 0.5 * (from + to);
    const bool near = position_.near(position) && (!turned_ || turned_->near(turned));
    const bool divided = (!near && halvings > 0) || (to_be_even > 0 && !even(position.points));
    if (divided && from < middle && middle < to) {
      divide(from, middle, halvings - 1, to_be_even - 1);
      divide(middle, to, halvings - 1, to_be_even - 1);
      return;
    }
    position_.take(position);
    Quintic turn{};
    turn.fill(Vector3d::Zero());
    if (turned_) {
      turned_->take(turned);
      turn = quintic_of(turned, to - from);
    }
    track_->append({quintic_of(position, to - from), turn, rotation(from), from, to});
  }

  const Trajectory& of_;
  Cut position_;
  std::optional<Cut> turned_;
  std::optional<Track> track_;
};

}  // namespace

FittedTrack fitted_track(const ShapeInTime& shape, const Trajectory& trajectory, double join) {
  if (!(join >= 0)) throw InputError("join", to_text(join), "not negative (m, rad)");
  return Fitter(shape, trajectory, join).fitted();
}

}  // namespace vericone::simulation
