// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/hull.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "middle.h"
#include "proof/homes.h"
#include "proof/piece_check.h"

namespace vericone::fitting {
namespace {

constexpr std::size_t kMostTouching = 20;
constexpr double kTouching = -1e-9;

/// What is known of a point and one piece.
enum class Place : char { unasked, inside, outside, unsure, inside_exactly, outside_exactly };

bool is_inside(Place p) { return p == Place::inside || p == Place::inside_exactly; }
bool is_exact(Place p) { return p == Place::inside_exactly || p == Place::outside_exactly; }

/// Two rounds over the pieces: by intervals, and exactly for what no piece certainly contains.
class Checking {
 public:
  Checking(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample, double margin)
      : sample_(sample),
        used_(used_points(sample)),
        home_(sample.points.size(), -1),
        triangle_home_(sample.triangles.size(), -1),
        ball_(margin > 0 ? sample.points.size() : 0, 0),
        point_exact_(sample.points.size(), 0),
        triangle_exact_(sample.triangles.size(), 0),
        margin_(margin) {
    const Eigen::Vector3d near = middle(sample, used_);
    for (const auto& quadrics : pieces) pieces_.emplace_back(quadrics, near);
  }

  void run() {
    for (const bool exactly : {false, true})
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        place_.assign(sample_.points.size(), Place::unasked);
        ask_points(k, exactly);
        ask_triangles(k, exactly);
        if (!exactly && margin_ > 0) ask_balls(k);
      }
  }

  Assignment homes() const { return {home_, triangle_home_}; }

  Certificate certificate() const {
    Certificate c;
    c.points = used_.size();
    c.points_inside = used_.size() - static_cast<std::size_t>(std::count_if(
                                         used_.begin(), used_.end(), [&](auto i) { return home_[i] < 0; }));
    c.triangles = sample_.triangles.size();
    const auto count = [](const std::vector<char>& flags) {
      return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
    };
    c.triangles_inside = static_cast<std::size_t>(
        std::count_if(triangle_home_.begin(), triangle_home_.end(), [](int home) { return home >= 0; }));
    c.margin = margin_;
    c.margins_inside = margin_ > 0 ? count(ball_) : c.points_inside;
    c.by_exact = count(point_exact_) + count(triangle_exact_);
    c.touching = touching();
    return c;
  }

 private:
  Place place(std::size_t piece, std::uint32_t point, bool exactly) {
    checkpoint();
    Place& p = place_[point];
    const Eigen::Vector3d& x = sample_.points[point];
    if (p == Place::unasked) {
      const Known k = pieces_[piece].contains(x);
      p = k == Known::yes ? Place::inside : k == Known::no ? Place::outside : Place::unsure;
    }
    if (exactly && p == Place::unsure)
      p = pieces_[piece].contains_exactly(x) ? Place::inside_exactly : Place::outside_exactly;
    return p;
  }

  void ask_points(std::size_t piece, bool exactly) {
    for (const std::uint32_t i : used_) {
      if (home_[i] >= 0) continue;
      const Place p = place(piece, i, exactly);
      if (is_exact(p)) point_exact_[i] = 1;
      if (is_inside(p)) home_[i] = static_cast<int>(piece);
    }
  }

  void ask_triangles(std::size_t piece, bool exactly) {
    for (std::size_t t = 0; t < sample_.triangles.size(); ++t) {
      if (triangle_home_[t] >= 0) continue;
      bool inside = true;
      for (const std::uint32_t i : sample_.triangles[t]) {
        if (!inside) break;
        const Place p = place(piece, i, exactly);
        if (is_exact(p)) triangle_exact_[t] = 1;
        inside = is_inside(p);
      }
      if (!inside) continue;
      if (!pieces_[piece].convex()) {
        const auto& [a, b, c] = sample_.triangles[t];
        const PieceCheck::Corners corners{sample_.points[a], sample_.points[b], sample_.points[c]};
        const Known k = pieces_[piece].contains(corners);
        inside = k == Known::yes;
        if (exactly && k == Known::unsure) {
          triangle_exact_[t] = 1;
          inside = pieces_[piece].contains_exactly(corners);
        }
      }
      if (inside) triangle_home_[t] = static_cast<int>(piece);
    }
  }

  void ask_balls(std::size_t piece) {
    for (const std::uint32_t i : used_) {
      checkpoint();
      if (!ball_[i]) ball_[i] = pieces_[piece].contains_ball(sample_.points[i], margin_);
    }
  }

  std::vector<std::size_t> touching() const {
    std::vector<std::pair<double, std::size_t>> near;
    for (const std::uint32_t i : used_) {
      if (home_[i] < 0) continue;
      double value = pieces_[static_cast<std::size_t>(home_[i])].value(sample_.points[i]);
      // Where pieces overlap the one in which it is deepest counts.
      for (std::size_t k = 0; k < pieces_.size() && value > kTouching; ++k)
        value = std::min(value, pieces_[k].value(sample_.points[i]));
      if (value > kTouching) near.emplace_back(-value, i);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > kMostTouching) near.resize(kMostTouching);
    std::vector<std::size_t> indices;
    for (const auto& [depth, i] : near) indices.push_back(i);
    return indices;
  }

  const Sample& sample_;
  std::vector<PieceCheck> pieces_;
  std::vector<std::uint32_t> used_;
  std::vector<int> home_, triangle_home_;  // the first piece that was seen to contain it, or -1
  std::vector<char> ball_, point_exact_, triangle_exact_;
  std::vector<Place> place_;  // of the piece at hand
  double margin_;
};

void require(const std::vector<std::vector<Quadric>>& pieces, double margin) {
  if (pieces.empty()) throw InputError("pieces", "none", "one piece or more");
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (pieces[k].empty())
      throw InputError("pieces[" + std::to_string(k) + "]", "no quadric", "one quadric or more");
  if (!(margin >= 0) || !std::isfinite(margin))
    throw InputError("margin", to_text(margin), "finite and not negative (metres)");
}

}  // namespace

Certificate check(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample, double margin) {
  require(pieces, margin);
  Checking checking(pieces, sample, margin);
  checking.run();
  return checking.certificate();
}

Assignment homes_of(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample) {
  require(pieces, 0);
  Checking checking(pieces, sample, 0);
  checking.run();
  return checking.homes();
}

}  // namespace vericone::fitting
