// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of many pieces: groups of them that one plane keeps apart, or a pair that meets.
#pragma once

#include <vector>

#include "certificate/pieces.h"

namespace vericone::certificates {

class Groups {
 public:
  explicit Groups(const Question& question);

  /// All pairs of pieces out; or, with `touching`, out or on.
  bool prove_out(Text& proof, bool touching);
  /// One pair of pieces in.
  bool prove_in(Text& proof);

 private:
  using Set = std::vector<std::uint32_t>;  // of pieces, in rising order

  /// A body's pieces, as bounds of doubles read them.
  struct Side {
    const Stated& body;
    std::vector<Piece> pieces;
    std::vector<Eigen::Vector3d> middles;
    Eigen::Vector3d reach = Eigen::Vector3d::Zero();  // the largest |coordinate| of corners along each axis
    bool convex = false;                              // some have flat, round and straight parts
    explicit Side(const Stated& stated);
  };
  /// Of a leaf of the search: some pieces of the obstacle, or a proof of one of them.
  struct Leaf {
    Set set;
    std::string proof;
  };

  [[nodiscard]] PairOfPieces pair(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] std::optional<Plane> plane_of(const Set& a, const Set& b) const;
  [[nodiscard]] std::optional<Plane> plane_of_convex(const Set& a, const Set& b) const;
  [[nodiscard]] bool holds(const Plane& plane, const Set& a, const Set& b) const;
  static std::pair<Set, Set> halves(const Side& side, const Set& set);
  bool cover(const Set& a, const Set& b, bool divide_agent, std::vector<Leaf>& leaves);
  bool prove_all(const Set& a, const Set& b, Text& proof);
  bool find_in(const Set& a, const Set& b, Text& proof);

  const Question& question_;
  Side a_, b_;
  bool touching_ = false;
};

}  // namespace vericone::certificates
