// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/decimate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "json/json_value.h"
#include "pieces/convex_mesh.h"

namespace vericone {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

constexpr std::size_t kMostTriangles = 24'000, kMostPoints = 30'000;
constexpr double kColumns = 420;  // of the view from above

Json triangle_json(const Triangle& t) {
  Json numbers = Json::array();
  for (const Eigen::Vector3d& x : t)
    for (int k = 0; k < 3; ++k) numbers.push_back(x(k));
  return numbers;
}

/// Corners in one cell of a grid of `cells` along the longest side become their mean; triangles that keep
/// three corners stay, once.
std::vector<Triangle> clustered(const std::vector<Triangle>& triangles, const Box& bounds, double cells) {
  struct Cell {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
  };
  const double size = 2 * bounds.half_widths().maxCoeff() / cells;
  std::unordered_map<std::uint64_t, Cell> grid;
  const auto key = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector3d at = ((x - bounds.low) / size).array().floor();
    return (static_cast<std::uint64_t>(at.x()) << 42) | (static_cast<std::uint64_t>(at.y()) << 21) |
           static_cast<std::uint64_t>(at.z());
  };
  for (const Triangle& t : triangles)
    for (const Eigen::Vector3d& x : t) {
      Cell& cell = grid[key(x)];
      cell.sum += x;
      cell.count += 1;
    }
  std::set<std::array<std::uint64_t, 3>> seen;
  std::vector<Triangle> kept;
  for (const Triangle& t : triangles) {
    const std::array<std::uint64_t, 3> corners{key(t[0]), key(t[1]), key(t[2])};
    std::array<std::uint64_t, 3> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] == sorted[1] || sorted[1] == sorted[2] || !seen.insert(sorted).second) continue;
    Triangle& mean = kept.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) mean[k] = grid[corners[k]].sum / grid[corners[k]].count;
  }
  return kept;
}

Json shown_triangles(const Assembly& pieces, const Pose& pose) {
  const auto& all = pieces.by_slot().triangles;
  std::vector<Triangle> shown(all.begin(), all.end());
  for (double cells = 160; shown.size() > kMostTriangles && cells > 20; cells *= 0.8)
    shown = clustered({all.begin(), all.end()}, pieces.bounds(), cells);
  Json list = Json::array();
  for (Triangle& t : shown) {
    for (Eigen::Vector3d& x : t) x = pose.to_world(x);
    list.push_back(triangle_json(t));
  }
  return {{"triangles", list}, {"thinned", shown.size() < all.size()}};
}

Json shown_points(const Assembly& pieces, const Pose& pose) {
  const auto& all = pieces.by_slot().balls;
  const std::size_t step = (all.size() + kMostPoints - 1) / kMostPoints;
  Json list = Json::array();
  for (std::size_t i = 0; i < all.size(); i += step) list.push_back(vector_json(pose.to_world(all[i])));
  return {{"points", list}, {"radius", pieces.radius()}, {"thinned", step > 1}};
}

Json shown_boxes(const Assembly& pieces, const Pose& pose) {
  const auto& all = pieces.by_slot().boxes;
  const std::size_t step = (all.size() + kMostPoints - 1) / kMostPoints;
  Json list = Json::array();
  for (std::size_t i = 0; i < all.size(); i += step) {
    Json box = vector_json(pose.to_world(all[i].center()));
    box.push_back(all[i].half_widths().maxCoeff());
    list.push_back(box);
  }
  return {{"boxes", list}, {"thinned", step > 1}};
}

Json shown_hulls(const Assembly& pieces, const Pose& pose) {
  Json list = Json::array();
  for (const HullBody& hull : pieces.by_slot().hulls) {
    Json points = Json::array();
    for (const Eigen::Vector3d& x : hull.points()) points.push_back(vector_json(pose.to_world(x)));
    list.push_back(points);
  }
  return {{"hulls", list}, {"thinned", false}};
}

Json shown_convexes(const Assembly& pieces, const Pose& pose) {
  // Coarser where there are many.
  const int rings = pieces.size() <= 20 ? 24 : pieces.size() <= 200 ? 8 : 4;
  Json list = Json::array();
  for (const Convex& body : pieces.by_slot().convexes)
    for (const Triangle& t : convex_mesh(body, pose, rings)) list.push_back(triangle_json(t));
  return {{"triangles", list}, {"thinned", false}};
}

/// Around the image of a box of the body's frame.
Box in_world(const Box& box, const Pose& pose) {
  const Eigen::Vector3d center = pose.to_world(box.center());
  const Eigen::Vector3d half = pose.rotation.cwiseAbs() * box.half_widths();
  return {center - half, center + half};
}

class Columns {
 public:
  Columns(const Box& bounds, double low, double high) : bounds_(bounds), low_(low), high_(high) {
    const Eigen::Vector3d size = 2 * bounds.half_widths();
    cell_ = std::max({size.x(), size.y(), 1e-12}) / kColumns;
    width_ = static_cast<int>(size.x() / cell_) + 1;
    rows_.assign(static_cast<std::size_t>(size.y() / cell_) + 1,
                 std::string(static_cast<std::size_t>(width_), '.'));
  }

  void mark(const Box& box) {
    const char mark = box.low.z() <= high_ && box.high.z() >= low_ ? '#' : '+';
    const int x0 = column(box.low.x() - bounds_.low.x(), width_),
              x1 = column(box.high.x() - bounds_.low.x(), width_);
    const int height = static_cast<int>(rows_.size());
    const int y0 = column(box.low.y() - bounds_.low.y(), height),
              y1 = column(box.high.y() - bounds_.low.y(), height);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (char& at = rows_[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]; at != '#') at = mark;
  }

  void mark(const Triangle& t) {
    const double longest = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
    const int n = static_cast<int>(std::min(2 * longest / cell_ + 1, 1000.0));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Eigen::Vector3d x = t[0] + (t[1] - t[0]) * i / n + (t[2] - t[0]) * j / n;
        mark(Box{x, x});
      }
  }

  Json json() const {
    return {{"low", {bounds_.low.x(), bounds_.low.y()}}, {"cell", cell_}, {"rows", rows_}};
  }

 private:
  int column(double distance, int count) const {
    return std::clamp(static_cast<int>(distance / cell_), 0, count - 1);
  }

  Box bounds_;
  double low_, high_, cell_ = 1;
  int width_ = 1;
  std::vector<std::string> rows_;
};

}  // namespace

Json shown_convex(const Convex& body, const Pose& pose) {
  Json list = Json::array();
  for (const Triangle& t : convex_mesh(body, pose)) list.push_back(triangle_json(t));
  return {{"triangles", list}, {"thinned", false}};
}

Json shown_pieces(const Assembly& pieces, const Pose& pose) {
  switch (pieces.kind()) {
    case PieceKind::triangle:
      return shown_triangles(pieces, pose);
    case PieceKind::ball:
      return shown_points(pieces, pose);
    case PieceKind::box:
      return shown_boxes(pieces, pose);
    case PieceKind::hull:
      return shown_hulls(pieces, pose);
    case PieceKind::convex:
      return shown_convexes(pieces, pose);
  }
  return nullptr;
}

Json top_view(const Assembly& pieces, const Pose& pose, double low, double high) {
  Columns columns(in_world(pieces.bounds(), pose), low, high);
  const Assembly::Storage& all = pieces.by_slot();
  const Eigen::Vector3d radius = Eigen::Vector3d::Constant(pieces.radius());
  for (const Box& box : all.boxes) columns.mark(in_world(box, pose));
  for (const Eigen::Vector3d& x : all.balls)
    columns.mark(Box{pose.to_world(x) - radius, pose.to_world(x) + radius});
  for (Triangle t : all.triangles) {
    for (Eigen::Vector3d& x : t) x = pose.to_world(x);
    columns.mark(t);
  }
  for (const HullBody& hull : all.hulls) {
    Box box{hull.points().front(), hull.points().front()};
    for (const Eigen::Vector3d& x : hull.points()) box.include({x, x});
    columns.mark(in_world(box, pose));
  }
  for (const Convex& body : all.convexes) columns.mark(in_world(body.bounds(), pose));
  return columns.json();
}

}  // namespace vericone
