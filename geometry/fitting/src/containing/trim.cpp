// SPDX-License-Identifier: BSD-3-Clause
#include "containing/trim.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/geometry/decompositions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vericone::fitting {
namespace {

constexpr int kPeels = 30, kConcentrations = 50;

template <int D>
class Trimmer {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  Trimmer(std::vector<Vector> points, std::vector<double> shares, double coverage)
      : points_(std::move(points)), shares_(std::move(shares)), coverage_(coverage) {}

  std::vector<char> best() const {
    const std::vector<char> peeled = by_peeling(), concentrated = by_concentration();
    return volume(concentrated) < volume(peeled) ? concentrated : peeled;
  }

 private:
  std::size_t size() const { return points_.size(); }

  std::vector<Vector> of(const std::vector<char>& kept) const {
    std::vector<Vector> result;
    for (std::size_t i = 0; i < size(); ++i)
      if (kept[i]) result.push_back(points_[i]);
    return result;
  }

  double volume(const std::vector<char>& kept) const {
    try {
      return min_volume_ellipsoid<D>(of(kept)).body.volume();
    } catch (const InputError&) {  // what is left is flat
      return std::numeric_limits<double>::infinity();
    }
  }

  /// Of those in order, the first ones that make up the share.
  std::vector<char> first(const std::vector<std::size_t>& order) const {
    std::vector<char> kept(size(), 0);
    double share = 0;
    for (const std::size_t i : order) {
      if (share >= coverage_ * (1 - 1e-12)) break;
      kept[i] = 1;
      share += shares_[i];
    }
    return kept;
  }

  std::vector<char> by_peeling() const {
    std::vector<char> kept(size(), 1);
    double spare = 1 - coverage_;
    const double portion = spare / kPeels;
    while (true) {
      MinVolumeResult<D> body;
      try {
        body = min_volume_ellipsoid<D>(of(kept));
      } catch (const InputError&) {
        return std::vector<char>(size(), 1);
      }
      // Outside by the most first; the support points are on the surface, so by their weights.
      std::vector<std::size_t> index;
      for (std::size_t i = 0; i < size(); ++i)
        if (kept[i]) index.push_back(i);
      std::vector<std::pair<double, std::size_t>> support;
      for (std::size_t k = 0; k < body.support.size(); ++k)
        support.emplace_back(body.weights[k], index[std::size_t(body.support[k])]);
      std::stable_sort(support.begin(), support.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      double removed = 0;
      for (const auto& [weight, i] : support) {
        if (removed > portion || shares_[i] > spare * (1 + 1e-12)) break;
        kept[i] = 0;
        removed += shares_[i];
        spare -= shares_[i];
      }
      if (removed == 0) return kept;
    }
  }

  std::vector<char> by_concentration() const {
    std::vector<char> kept(size(), 1);
    for (int round = 0; round < kConcentrations; ++round) {
      Vector mean = Vector::Zero();
      double total = 0;
      for (std::size_t i = 0; i < size(); ++i)
        if (kept[i]) {
          mean += shares_[i] * points_[i];
          total += shares_[i];
        }
      mean /= total;
      Eigen::Matrix<double, D, D> second = Eigen::Matrix<double, D, D>::Zero();
      for (std::size_t i = 0; i < size(); ++i)
        if (kept[i]) second += shares_[i] / total * (points_[i] - mean) * (points_[i] - mean).transpose();
      const Cholesky<D> factor = cholesky<D>(second);
      if (!factor.positive) return kept;
      std::vector<double> distance(size());
      for (std::size_t i = 0; i < size(); ++i)
        distance[i] = factor.half_solve(points_[i] - mean).squaredNorm();
      std::vector<std::size_t> order(size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
      std::vector<char> next = first(order);
      if (next == kept) break;
      kept = std::move(next);
    }
    return kept;
  }

  std::vector<Vector> points_;
  std::vector<double> shares_;
  double coverage_;
};

}  // namespace

std::vector<char> trim(const CanonicalSample& sample, double coverage, bool planar) {
  if (!(coverage < 1)) return std::vector<char>(sample.points.size(), 1);
  std::vector<double> shares = sample.weights;
  if (sample.is_mesh()) shares.assign(sample.points.size(), 1 / double(sample.points.size()));
  if (!planar) return Trimmer<3>(sample.points, std::move(shares), coverage).best();
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& y : sample.points) flat.push_back((sample.frame.axes * y).head<2>());
  return Trimmer<2>(std::move(flat), std::move(shares), coverage).best();
}

}  // namespace vericone::fitting
