// SPDX-License-Identifier: BSD-3-Clause
#include "round/last_rung.h"

#include <algorithm>
#include <cmath>

namespace vericone::round {
namespace {

using exact::Integer;

constexpr int kNoGrid = 1 << 20;

/// The coarsest grid that has all the numbers of a body; of a shape matrix, its square has.
int grid_of(const Convex& body, const Eigen::Vector3d& at) {
  int grid = exact::grid_exponent(body.margin(), kNoGrid);
  for (int k = 0; k < 3; ++k) grid = std::min(grid, exact::grid_exponent(at(k), kNoGrid));
  for (const Convex::Piece& piece : body.pieces()) {
    for (int k = 0; k < 3; ++k) grid = std::min(grid, exact::grid_exponent(piece.center(k), kNoGrid));
    for (int k = 0; k < 9; ++k) {
      const double x = piece.shape ? (*piece.shape)(k) : piece.factor(k);
      if (x == 0) continue;
      const int own = exact::grid_exponent(x, kNoGrid);
      grid = std::min(grid, piece.shape ? static_cast<int>(std::floor(own / 2.0)) : own);
    }
  }
  return grid;
}

exact::IntegerMatrix<3> shape_on(const Convex::Piece& piece, int grid) {
  exact::IntegerMatrix<3> shape{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (piece.shape) {
        shape[i][j] = exact::on_grid((*piece.shape)(i, j), 2 * grid);
        continue;
      }
      for (int k = 0; k < piece.rank; ++k)
        shape[i][j] += exact::on_grid(piece.factor(i, k), grid) * exact::on_grid(piece.factor(j, k), grid);
    }
  return shape;
}

ExactBody on_grid(const Convex& body, const Eigen::Vector3d& at, int grid) {
  ExactBody result;
  for (const Convex::Piece& piece : body.pieces()) {
    ExactPiece own{{}, shape_on(piece, grid)};
    for (int k = 0; k < 3; ++k)
      own.center[k] = exact::on_grid(piece.center(k), grid) + exact::on_grid(at(k), grid);
    result.pieces.push_back(std::move(own));
  }
  return result;
}

/// More than each point of the body is from the origin, in units of the grid.
Integer reach(const ExactBody& body) {
  Integer sum = 1;
  for (const ExactPiece& piece : body.pieces)
    for (int k = 0; k < 3; ++k) sum += abs(piece.center[k]) + piece.shape[k][k];
  return sum;
}

/// The hull of a body at two places beside its own.
ExactBody swept(const ExactBody& body, const exact::IntegerVector<3>& first,
                const exact::IntegerVector<3>& last) {
  ExactBody result;
  for (const auto* by : {&first, &last})
    for (ExactPiece piece : body.pieces) {
      for (int k = 0; k < 3; ++k) piece.center[k] += (*by)[k];
      result.pieces.push_back(std::move(piece));
    }
  return result;
}

}  // namespace

LastRung::LastRung(const RoundScene& scene, const Stretch* stretch) {
  int grid =
      std::min(grid_of(scene.given_agent, scene.agent_at), grid_of(scene.given_obstacle, scene.obstacle_at));
  std::optional<exact::Way> first, last;
  const bool ends = stretch == nullptr || std::isfinite(stretch->until);
  if (stretch != nullptr) {
    first.emplace(*stretch, stretch->from);
    last.emplace(*stretch, ends ? stretch->until : 1.0);
    grid = std::min({grid, first->exponent, last->exponent});
  }
  if (grid == kNoGrid) grid = 0;
  agent_ = on_grid(scene.given_agent, scene.agent_at, grid);
  obstacle_ = on_grid(scene.given_obstacle, scene.obstacle_at, grid);
  margin_ =
      exact::on_grid(scene.given_agent.margin(), grid) + exact::on_grid(scene.given_obstacle.margin(), grid);
  if (stretch == nullptr) return;
  // One that never ends goes on until it has passed: by as much as all numbers together.
  const Integer times = ends ? Integer(1) : Integer(reach(agent_) + reach(obstacle_) + margin_);
  exact::IntegerVector<3> begin, end;
  for (int k = 0; k < 3; ++k) {
    begin[k] = first->on(k, grid);
    end[k] = last->on(k, grid) * times;
    if (!ends) end[k] += begin[k];
  }
  agent_ = swept(agent_, begin, end);
}

std::optional<Relation> LastRung::relation() const { return exact_relation(agent_, obstacle_, margin_); }

Membership LastRung::membership(const exact::IntegerVector<3>& w) const {
  const auto answer = exact_membership(agent_, obstacle_, margin_, w);
  if (!answer) throw Undecided{};
  return *answer;
}

}  // namespace vericone::round
