// SPDX-License-Identifier: BSD-3-Clause
#include "containing/least_about_balls.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>

#include <array>
#include <limits>

#include "containing/ball_place.h"

namespace vericone::fitting {
namespace {

constexpr double kTolerance = 1e-10;  // of the squared gauge
constexpr double kConverged = 1e-8;
constexpr int kMostRounds = 100;

template <int D>
class Cutter {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  Cutter(const std::vector<Vector>& centers, double radius) : centers_(centers), radius_(radius) {
    // Towards the faces, edges and corners of a box.
    for (int code = 0; code < (D == 2 ? 9 : 27); ++code) {
      const Vector u =
          D == 2 ? Vector(Eigen::Vector3d(code % 3 - 1, code / 3 - 1, 0).template head<D>())
                 : Vector(Eigen::Vector3d(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1).template head<D>());
      if (u.isZero()) continue;
      std::size_t far = 0;
      for (std::size_t i = 0; i < centers_.size(); ++i)
        if (centers_[i].dot(u) > centers_[far].dot(u)) far = i;
      add(far, radius_ * u.normalized());
    }
  }

  BallEnclosure<D> run() {
    BallEnclosure<D> result;
    double most = 1;
    BasicEllipsoid<D> body;
    for (double before = std::numeric_limits<double>::infinity();; before = result.gap) {
      checkpoint();
      const MinVolumeResult<D> least =
          min_volume_ellipsoid<D>(places_, {.tolerance = 1e-12, .certified = false});
      ++result.rounds;
      body = least.body;
      const std::size_t count = places_.size();
      most = cut(body, least.support);
      result.gap = std::max(most - 1, 0.0);
      // At the limit of rounding rounds add the same places again and again.
      if (result.gap <= kTolerance || places_.size() == count || result.rounds == kMostRounds ||
          (result.gap <= kConverged && result.gap > before / 2))
        break;
    }
    result.converged = result.gap <= kConverged;
    const double grown = std::sqrt(std::max(most, 1.0));
    const Vector center = body.center();
    result.body = body.translated(-center).scaled(grown).translated(center);
    const MinVolumeResult<D> proved = min_volume_ellipsoid<D>(places_);
    result.volume_ratio_bound =
        result.body.volume() / proved.body.volume() * proved.volume_ratio_bound * (1 + 1e-14);
    return result;
  }

 private:
  struct Place {
    double value = 0;  // squared gauge
    std::size_t ball = 0;
    Vector shift = Vector::Zero();  // along the body's axes
  };

  /// Shortened by more than the sum's rounding, so that the place lies in the ball.
  void add(std::size_t ball, const Vector& shift) {
    constexpr double kEps = std::numeric_limits<double>::epsilon();
    const double lost = 8 * kEps + 4 * kEps * centers_[ball].template lpNorm<Eigen::Infinity>() / radius_;
    places_.push_back(centers_[ball] + std::max(0.0, 1 - lost) * shift);
    balls_.push_back(ball);
  }

  /// Adds the places that stick out farthest: of each orthant, and of the balls that hold the body up.
  /// Returns the greatest squared gauge.
  double cut(const BasicEllipsoid<D>& body, const std::vector<Eigen::Index>& support) {
    const auto axes = body.axis_directions();
    const Vector inverse = body.semi_axes().cwiseInverse(), lambda = inverse.cwiseAbs2();
    int thin = 0;
    const double reach = radius_ * inverse.maxCoeff(&thin);
    const auto place_of = [&](std::size_t ball, const Vector& along) {
      Place place{.ball = ball, .shift = greatest_in_ball<D>(lambda, lambda.cwiseProduct(along), radius_)};
      place.value = (along + place.shift).cwiseProduct(inverse).squaredNorm();
      return place;
    };
    std::array<Place, (1 << D)> worst;
    std::vector<Place> all;
    double most = 0;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const Vector along = axes.transpose() * (centers_[i] - body.center());
      int orthant = 0;
      for (int k = 0; k < D; ++k) orthant |= int(along(k) > 0) << k;
      // No more than the triangle inequality allows.
      const double bound = along.cwiseProduct(inverse).norm() + reach;
      if (bound * bound <= worst[std::size_t(orthant)].value) continue;
      const Place place = place_of(i, along);
      if (place.value > worst[std::size_t(orthant)].value) worst[std::size_t(orthant)] = place;
      most = std::max(most, place.value);
    }
    for (const Place& place : worst)
      if (place.value > 0) all.push_back(place);
    for (const Eigen::Index k : support)
      all.push_back(place_of(balls_[std::size_t(k)],
                             axes.transpose() * (centers_[balls_[std::size_t(k)]] - body.center())));
    for (Place& place : all) {
      if (place.value > 1 + kTolerance / 10) add(place.ball, axes * place.shift);
      // A thin body is as near on the other side.
      const Vector along = axes.transpose() * (centers_[place.ball] - body.center());
      place.shift(thin) = -place.shift(thin);
      if ((along + place.shift).cwiseProduct(inverse).squaredNorm() > 1 + kTolerance / 10)
        add(place.ball, axes * place.shift);
    }
    return most;
  }

  const std::vector<Vector>& centers_;
  double radius_;
  std::vector<Vector> places_;
  std::vector<std::size_t> balls_;  // of the places
};

}  // namespace

template <int D>
BallEnclosure<D> least_about_balls(const std::vector<Eigen::Matrix<double, D, 1>>& centers, double radius) {
  return Cutter<D>(centers, radius).run();
}

template BallEnclosure<2> least_about_balls<2>(const std::vector<Eigen::Vector2d>&, double);
template BallEnclosure<3> least_about_balls<3>(const std::vector<Eigen::Vector3d>&, double);

}  // namespace vericone::fitting
