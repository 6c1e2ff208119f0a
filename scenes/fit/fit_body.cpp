// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_body.h"

#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "input/planar_body.h"
#include "input/spatial_body.h"
#include "json/json_value.h"

namespace vericone::fit {
namespace {

/// Sheets, semi-axes and rotation of { y^T M y <= level }, whose axis is the eigenvector with the sign that
/// the others have not.
Json hyperboloid_fields(const Delimiter<3>& d, const Eigen::Matrix3d& body, double factor) {
  const auto eigen = symmetric_eigen<3>(d.matrix);
  const int positive = static_cast<int>((eigen.values.array() > 0).count());
  if (!(d.level > 0) || positive == 0 || positive == 3)
    throw std::runtime_error("a piece is delimited by what is no hyperboloid");
  // Eigenvalues increase: of two sheets the last, of one sheet the first is alone.
  const int axis = positive == 1 ? 2 : 0;
  Eigen::Matrix3d turn;
  Eigen::Vector3d semi_axes;
  for (int i = 0; i < 3; ++i) {
    const int k = (axis + i) % 3;
    turn.col(i) = eigen.vectors.col(k);
    semi_axes(i) = factor * std::sqrt(d.level / std::abs(eigen.values(k)));
  }
  if (turn.determinant() < 0) turn.col(2) = -turn.col(2);
  return {{"sheets", positive == 1 ? 2 : 1},
          {"semi_axes", vector_json(semi_axes)},
          {"rotation", matrix_json(Eigen::Matrix3d(body.transpose() * turn))}};
}

/// Of a surface that proofs moved off the ellipsoid nothing is left to say, and scenes refuse it.
bool delimits(const Delimiter<3>& d, const Ellipsoid& ellipsoid) {
  try {
    CombinedEllipsoid(ellipsoid, {d});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Json spatial_fields(const CombinedEllipsoid& body, double factor) {
  Eigen::Matrix3d rotation = body.ellipsoid().axis_directions();
  if (rotation.determinant() < 0) rotation.col(2) = -rotation.col(2);
  Json hyperboloids = Json::array();
  for (const Delimiter<3>& d : body.delimiters())
    if (delimits(d, body.ellipsoid())) hyperboloids.push_back(hyperboloid_fields(d, rotation, factor));
  return {{"center", vector_json(body.center())},
          {"semi_axes", vector_json(Eigen::Vector3d(factor * body.ellipsoid().semi_axes()))},
          {"rotation", matrix_json(rotation)},
          {"hyperboloids", hyperboloids}};
}

Json planar_fields(const Ellipse& footprint, double factor) {
  const Eigen::Vector2d x = footprint.axis_directions().col(0);
  return {{"center", vector_json(footprint.center())},
          {"semi_axes", vector_json(Eigen::Vector2d(factor * footprint.semi_axes()))},
          {"rotation", std::atan2(x.y(), x.x())}};
}

/// What a scene makes of the fields.
class SceneBody {
 public:
  explicit SceneBody(const Json& fields) : planar_(fields["center"].size() == 2) {
    if (planar_) {
      footprint_ = input::read_planar_body(fields, "footprint");
    } else {
      body_ = input::read_spatial_body(fields, "body");
    }
  }

  bool contains(const Eigen::Vector3d& x) const {
    const Sign s = planar_ ? side<2>(footprint_, Eigen::Vector2d(x.head<2>())) : side<3>(body_, x);
    return s != Sign::positive;
  }

 private:
  bool planar_;
  CombinedEllipsoid body_;
  CombinedEllipse footprint_;
};

bool contain(const std::vector<Json>& fields, const std::vector<Eigen::Vector3d>& points) {
  std::vector<SceneBody> bodies;
  for (const Json& body : fields) bodies.emplace_back(body);
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& x) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const SceneBody& b) { return b.contains(x); });
  });
}

std::string yaml(const Json& body, const std::string& indent) {
  std::string text;
  for (const auto& [field, value] : body.items()) {
    if (field != "hyperboloids") {
      text += indent + field + ": " + value.dump() + "\n";
      continue;
    }
    if (value.empty()) continue;
    text += indent + "hyperboloids:\n";
    for (const Json& h : value) {
      std::string lead = indent + "  - ";
      for (const auto& [name, of] : h.items()) {
        text += lead + name + ": " + of.dump() + "\n";
        lead = indent + "    ";
      }
    }
  }
  return text;
}

}  // namespace

Json body_fields(const fitting::Piece& piece, double factor) {
  return piece.footprint ? planar_fields(*piece.footprint, factor) : spatial_fields(piece.body, factor);
}

std::vector<Json> enclosing_body_fields(const std::vector<fitting::Piece>& pieces,
                                        const std::vector<Eigen::Vector3d>& inside) {
  const auto all = [&](double factor) {
    std::vector<Json> fields;
    for (const fitting::Piece& piece : pieces) fields.push_back(body_fields(piece, factor));
    return fields;
  };
  if (inside.empty()) return all(1);
  for (int exponent = 50; exponent >= 20; exponent -= 2) {
    std::vector<Json> fields = all(1 + std::ldexp(1.0, -exponent));
    if (contain(fields, inside)) return fields;
  }
  throw std::runtime_error("the fields of a piece do not contain the points that its quadrics contain");
}

std::vector<Eigen::Vector3d> points_inside(const std::vector<fitting::Piece>& pieces,
                                           const fitting::Sample& sample) {
  std::vector<Eigen::Vector3d> inside;
  for (const std::uint32_t i : fitting::used_points(sample)) {
    const Eigen::Vector3d& x = sample.points[i];
    if (std::any_of(pieces.begin(), pieces.end(), [&](const fitting::Piece& piece) {
          return side<3>(std::span<const Quadric>(piece.quadrics), x) != Sign::positive;
        }))
      inside.push_back(x);
  }
  return inside;
}

std::string body_yaml(const std::vector<Json>& fields, const std::string& comment) {
  std::string text = "# " + comment + "\n";
  if (fields.size() == 1) return text + "obstacle:\n" + yaml(fields.front(), "  ");
  text += "pieces:  # each is a body\n";
  for (const Json& body : fields) {
    std::string piece = yaml(body, "    ");
    piece.replace(2, 1, "-");
    text += piece;
  }
  return text;
}

}  // namespace vericone::fit
