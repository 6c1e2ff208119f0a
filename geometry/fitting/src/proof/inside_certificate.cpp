// SPDX-License-Identifier: BSD-3-Clause
//
// The certificate of a fit as text (docs/reference/certificates.md): `inside`, by the rule `vertices`.
#include <vericone/fitting/hull.h>
#include <vericone/internal/fitting/canonical.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "proof/homes.h"
#include "proof/inside_text.h"

namespace vericone::fitting {
namespace {

/// The shortest decimals that mean the same double.
void write(std::string& text, double x) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, x == 0 ? 0.0 : x).ptr);
}

void write(std::string& text, std::uint32_t index) { text += std::to_string(index); }

void write(std::string& text, const Eigen::Vector3d& x) {
  for (int i = 0; i < 3; ++i) write(text += i == 0 ? "[" : ", ", x(i));
  text += "]";
}

template <typename List>
void write_list(std::string& text, const List& list) {
  const char* between = "[";
  for (const auto& item : list) {
    text += between;
    if constexpr (
        requires { item.begin(); } && !requires { item.rows(); })
      write_list(text, item);
    else
      write(text, item);
    between = ", ";
  }
  text += "]";
}

void write_sample(std::string& text, const Sample& sample) {
  text += sample.is_mesh() ? R"({"kind": "mesh", "points": )" : R"({"kind": "cloud", "points": )";
  write_list(text, sample.points);
  if (sample.is_mesh())
    write_list(text += ", \"triangles\": ", sample.triangles);
  else
    text += ", \"radius\": 0";
  text += "}";
}

void write_piece(std::string& text, const std::vector<Quadric>& quadrics) {
  std::string_view between = R"({"kind": "quadrics", "matrices": [)";
  for (const Quadric& q : quadrics) {
    text += between;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) write(text += j > 0 ? ", " : i > 0 ? "], [" : "[[", q.matrix()(i, j));
    text += "]]";
    between = ", ";
  }
  text += "]}";
}

void write_hull(std::string& text, const std::vector<std::vector<Quadric>>& pieces) {
  if (pieces.size() == 1) return write_piece(text, pieces.front());
  std::string_view between = R"({"kind": "union", "pieces": [)";
  for (const auto& piece : pieces) {
    write_piece(text += between, piece);
    between = ", ";
  }
  text += "]}";
}

/// Which piece contains which points or triangles, in their order; a group for each piece that has some.
void write_proof(std::string& text, const std::vector<int>& homes, std::size_t pieces) {
  const auto vertices = [&](std::size_t piece) {
    text += R"({"rule": "vertices", "obstacle_piece": )" + std::to_string(piece) + "}";
  };
  const auto first = static_cast<std::size_t>(homes.front());
  if (pieces == 1) {
    text += R"({"rule": "vertices"})";
    return;
  }
  if (std::all_of(homes.begin(), homes.end(), [&](int home) { return home == homes.front(); }))
    return vertices(first);
  std::vector<int> group(pieces, -1);
  int groups = 0;
  const char* between = R"({"rule": "groups", "of": "agent", "proofs": [)";
  for (const int home : homes) {
    int& own = group[static_cast<std::size_t>(home)];
    if (own >= 0) continue;
    own = groups++;
    text += between;
    vertices(static_cast<std::size_t>(home));
    between = ", ";
  }
  between = R"(], "runs": [[)";
  for (std::size_t i = 0, next = 0; i < homes.size(); i = next) {
    while (next < homes.size() && homes[next] == homes[i]) ++next;
    text += between + std::to_string(group[static_cast<std::size_t>(homes[i])]) + ", " +
            std::to_string(next - i) + "]";
    between = ", [";
  }
  text += "]}";
}

}  // namespace

InsideCertificate inside_text(const Sample& sample, const Assignment& homes, std::size_t pieces,
                              const std::function<void(std::string&)>& write_pieces) {
  const std::vector<std::uint32_t> used = used_points(sample);
  if (used.empty()) return {{}, "there is no point"};
  const auto outside = static_cast<std::size_t>(
      std::count_if(used.begin(), used.end(), [&](auto i) { return homes.points[i] < 0; }));
  if (outside > 0)
    return {{}, std::to_string(outside) + " of " + std::to_string(used.size()) + " points are outside"};
  if (const auto count = std::count(homes.triangles.begin(), homes.triangles.end(), -1); count > 0)
    return {{},
            std::to_string(count) + " of " + std::to_string(homes.triangles.size()) +
                " triangles are in no piece as a whole"};
  std::string text = R"({"format": "vericone-certificate", "version": 1, "claim": {"says": "inside")";
  write_sample(text += ", \"agent\": ", sample);
  write_pieces(text += ", \"obstacle\": ");
  write_proof(text += "}, \"proof\": ", sample.is_mesh() ? homes.triangles : homes.points, pieces);
  return {text + "}", {}};
}

InsideCertificate inside_certificate(const std::vector<std::vector<Quadric>>& pieces, const Sample& sample) {
  return inside_text(sample, homes_of(pieces, sample), pieces.size(),
                     [&](std::string& text) { write_hull(text, pieces); });
}

}  // namespace vericone::fitting
