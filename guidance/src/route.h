// SPDX-License-Identifier: BSD-3-Clause
//
// A way among bodies at rest, by cells: where the straight one is blocked, the point to go to next. What it
// says is a wish; whether a course is safe is judged by others.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <queue>
#include <unordered_map>
#include <vector>

namespace vericone::guidance::courses {

/// What is known of cells, in blocks that are kept when it is cleared: a table of single cells would be gone
/// over as a whole, now and then, and one call in some hundred would take a hundred times as long.
class Cells {
 public:
  using Index = Eigen::Matrix<int, 3, 1>;
  struct Cell {
    double cost = 0;  // m, from the start
    std::uint64_t before = 0;
    bool known = false, done = false, blocked = false;
  };

  [[nodiscard]] static std::uint64_t key_of(const Index& at);
  [[nodiscard]] static Index at_of(std::uint64_t key);
  /// Not known the first time. Stays where it is until clear().
  [[nodiscard]] Cell& at(const Index& at);
  void clear();

  std::size_t known = 0;

 private:
  std::unordered_map<std::uint64_t, std::size_t> where_;  // of blocks
  std::deque<std::array<Cell, 64>> blocks_;               // 4 x 4 x 4 cells
  std::size_t used_ = 0;
};

class Route {
 public:
  /// Whether the agent goes straight from one point to another, nothing nearer than it is to keep; and so
  /// does one whose radius is some metres more.
  using Clear = std::function<bool(const Eigen::Vector3d&, const Eigen::Vector3d&, double)>;

  /// The point to go to now, metres: the goal, where it is in sight; else the farthest on the way to it that
  /// is; else, while the way is looked for, the goal. `radius`: m, of the agent with what it is to keep.
  /// Looks at a few hundred cells a call at most.
  [[nodiscard]] Eigen::Vector3d towards(const Eigen::Vector3d& goal, const Eigen::Vector3d& position,
                                        double radius, bool planar, double time, const Clear& clear);

 private:
  using Index = Cells::Index;
  struct Open {
    double total;
    std::uint64_t key;
    bool operator<(const Open& other) const {
      return total != other.total ? total > other.total : key > other.key;
    }
  };

  void start(const Eigen::Vector3d& goal, const Eigen::Vector3d& position, double cell);
  void advance(bool planar, const Clear& clear);
  void finish(std::uint64_t last, bool arrived);
  [[nodiscard]] bool is_fine() const;
  [[nodiscard]] Eigen::Vector3d center(const Index& at) const { return from_ + cell_ * at.cast<double>(); }
  [[nodiscard]] double left(const Index& at) const { return (goal_ - center(at)).norm(); }

  Eigen::Vector3d goal_ = Eigen::Vector3d::Zero(), from_ = Eigen::Vector3d::Zero();
  double radius_ = 0;   // m
  double cell_ = 0;     // m, the width of cells
  double more_ = 0;     // m: of two cells beside each other that are free with it, all between is
  double started_ = 0;  // s
  bool sought_ = false, looking_ = false;
  Cells cells_;
  std::priority_queue<Open> open_;
  std::uint64_t nearest_ = 0;
  std::vector<Eigen::Vector3d> way_;
  std::size_t at_ = 0;  // of the way, where it goes now
};

}  // namespace vericone::guidance::courses
