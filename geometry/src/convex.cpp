// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/convex.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/rotation.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Piece = Convex::Piece;

void require_length(const std::string& field, double x) {
  if (!(std::isfinite(x) && x >= 0)) throw InputError(field, to_text(x), "a finite number >= 0 (m)");
}

void require_point(const std::string& field, const Vector3d& x) {
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(x(k)))
      throw InputError(field + "[" + std::to_string(k) + "]", to_text(x(k)), "a finite number (m)");
}

Piece point_at(const Vector3d& at) { return {at, Matrix3d::Zero(), 0, {}}; }

/// An upright ellipse about a point of the z axis; a segment or a point where a semi-axis is 0.
void add_ellipse(std::vector<Piece>& pieces, double a, double b, double z) {
  const Vector3d center(0, 0, z);
  if (a > 0 && b > 0) {
    Piece ellipse{center, Matrix3d::Zero(), 2, {}};
    ellipse.factor(0, 0) = a;
    ellipse.factor(1, 1) = b;
    pieces.push_back(ellipse);
    return;
  }
  pieces.push_back(point_at(center + Vector3d(a, b, 0)));
  pieces.push_back(point_at(center - Vector3d(a, b, 0)));
}

Piece piece_of(const Ellipsoid& body) {
  Piece piece{body.center(), body.factor(), 3, {}};
  if (!body.defined_by_factor()) piece.shape = body.shape();
  return piece;
}

/// The radius of a piece that is a ball, written without rounding; 0 of others.
double ball_radius(const Piece& piece) {
  if (piece.rank != 3) return 0;
  const Matrix3d& m = piece.shape ? *piece.shape : piece.factor;
  const double size = m.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    int large = 0;
    for (int j = 0; j < 3; ++j) {
      if (std::abs(m(i, j)) == size)
        ++large;
      else if (m(i, j) != 0)
        return 0;
    }
    if (large != 1) return 0;
  }
  if (!piece.shape) return size;
  const double radius = std::sqrt(size);
  return std::fma(radius, radius, -size) == 0 && *piece.shape == size * Matrix3d::Identity() ? radius : 0;
}

/// Whether no unit column combination vanishes, as far as doubles tell.
bool has_rank(const Matrix3d& factor, int rank) {
  for (int k = rank; k < 3; ++k)
    if (!factor.col(k).isZero(0)) return false;
  if (rank == 0) return true;
  const double size = factor.cwiseAbs().maxCoeff();
  if (!(size > 0)) return false;
  const Vector3d values = Eigen::JacobiSVD<Matrix3d>(factor / size).singularValues();
  return values(rank - 1) > 1e-13 * values(0);
}

}  // namespace

Convex::Convex(std::vector<Piece> pieces, double margin, std::string word)
    : margin_(margin), word_(std::move(word)) {
  const double radius = ball_radius(pieces.front());
  // A sum that would be rounded is left as it is.
  const double sum = margin + radius;
  const bool balls = radius > 0 && sum - margin == radius && sum - radius == margin &&
                     std::all_of(pieces.begin(), pieces.end(),
                                 [&](const Piece& piece) { return ball_radius(piece) == radius; });
  if (balls) margin_ = sum;
  pieces_.reserve(pieces.size());
  for (Piece& piece : pieces) {
    if (balls) piece = point_at(piece.center);
    if (std::find(pieces_.begin(), pieces_.end(), piece) == pieces_.end()) pieces_.push_back(piece);
  }
}

Convex Convex::cylinder(double radius, double height) {
  require_length("radius", radius);
  require_length("height", height);
  Convex result = elliptic_cylinder(radius, radius, height);
  result.word_ = "cylinder";
  return result;
}

Convex Convex::elliptic_cylinder(double a, double b, double height) {
  require_length("a", a);
  require_length("b", b);
  require_length("height", height);
  std::vector<Piece> pieces;
  add_ellipse(pieces, a, b, -0.5 * height);
  add_ellipse(pieces, a, b, 0.5 * height);
  return {std::move(pieces), 0, "elliptic cylinder"};
}

Convex Convex::capsule(double radius, double length) {
  require_length("radius", radius);
  require_length("length", length);
  return {{point_at({0, 0, -0.5 * length}), point_at({0, 0, 0.5 * length})}, radius, "capsule"};
}

Convex Convex::cone(double radius, double height) {
  require_length("radius", radius);
  require_length("height", height);
  Convex result = frustum(radius, 0, height);
  result.word_ = "cone";
  return result;
}

Convex Convex::frustum(double bottom, double top, double height) {
  require_length("bottom", bottom);
  require_length("top", top);
  require_length("height", height);
  std::vector<Piece> pieces;
  add_ellipse(pieces, bottom, bottom, -0.5 * height);
  add_ellipse(pieces, top, top, 0.5 * height);
  return {std::move(pieces), 0, "frustum"};
}

Convex Convex::disc(double radius) {
  require_length("radius", radius);
  Convex result = ellipse(radius, radius);
  result.word_ = "disc";
  return result;
}

Convex Convex::ellipse(double a, double b) {
  require_length("a", a);
  require_length("b", b);
  std::vector<Piece> pieces;
  add_ellipse(pieces, a, b, 0);
  return {std::move(pieces), 0, "ellipse"};
}

Convex Convex::box(const Vector3d& half_widths) {
  for (int k = 0; k < 3; ++k) require_length("half_widths[" + std::to_string(k) + "]", half_widths(k));
  Convex result = rounded(HullBody::box(-half_widths, half_widths), 0);
  result.word_ = "box";
  return result;
}

Convex Convex::point(const Vector3d& at) {
  require_point("at", at);
  return {{point_at(at)}, 0, "point"};
}

Convex Convex::segment(const Vector3d& from, const Vector3d& to) {
  require_point("from", from);
  require_point("to", to);
  return {{point_at(from), point_at(to)}, 0, "segment"};
}

Convex Convex::rounded(const HullBody& hull, double margin) {
  require_length("margin", margin);
  std::vector<Piece> pieces;
  pieces.reserve(hull.size());
  for (const Vector3d& x : hull.points()) pieces.push_back(point_at(x));
  return {std::move(pieces), margin, "convex"};
}

Convex Convex::rounded(const Ellipsoid& ellipsoid, double margin) {
  require_length("margin", margin);
  return {{piece_of(ellipsoid)}, margin, "convex"};
}

Convex Convex::hull_of(const Ellipsoid& first, const Ellipsoid& second) {
  return {{piece_of(first), piece_of(second)}, 0, "convex"};
}

Convex Convex::of_pieces(std::vector<Piece> pieces, double margin) {
  if (pieces.empty()) throw InputError("pieces", "none", "one piece or more");
  require_length("margin", margin);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string field = "pieces[" + std::to_string(i) + "]";
    const Piece& piece = pieces[i];
    if (piece.rank != 0 && piece.rank != 2 && piece.rank != 3)
      throw InputError(field + ".rank", std::to_string(piece.rank), "0, 2 or 3");
    require_point(field + ".center", piece.center);
    if (!piece.factor.allFinite()) throw InputError(field + ".factor", "not finite", "finite numbers (m)");
    if (!has_rank(piece.factor, piece.rank))
      throw InputError(field + ".factor", "columns of another rank",
                       "as many independent columns as the rank says, then zeros");
    if (piece.shape &&
        (piece.rank != 3 || !piece.shape->allFinite() || *piece.shape != piece.shape->transpose()))
      throw InputError(field + ".shape", "not that of an ellipsoid", "symmetric, with rank 3");
  }
  return {std::move(pieces), margin, "convex"};
}

Convex Convex::called(std::string word) const {
  Convex result = *this;
  result.word_ = std::move(word);
  return result;
}

bool Convex::is_hull() const {
  return margin_ == 0 &&
         std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.rank == 0; });
}

bool Convex::is_flat() const {
  if (margin_ > 0) return false;
  // Solid where four of its corners span a volume that rounding does not explain.
  const std::vector<Vector3d> all = corners();
  Matrix3d spread = Matrix3d::Zero();
  for (const Vector3d& x : all) spread += (x - all.front()) * (x - all.front()).transpose();
  const Vector3d values = Eigen::JacobiSVD<Matrix3d>(spread).singularValues();
  double size = 0;
  for (const Vector3d& x : all) size = std::max(size, x.squaredNorm());
  return !(values(2) > 1e-12 * (values(0) + size));
}

double Convex::support(const Vector3d& n) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_)
    most = std::max(most, n.dot(piece.center) + (piece.factor.transpose() * n).norm());
  return margin_ > 0 ? most + margin_ * n.norm() : most;
}

Vector3d Convex::support_point(const Vector3d& n) const {
  const Piece* best = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  Vector3d back = Vector3d::Zero();
  for (const Piece& piece : pieces_) {
    const Vector3d seen = piece.factor.transpose() * n;
    const double value = n.dot(piece.center) + seen.norm();
    if (best && !(value > most)) continue;
    best = &piece;
    most = value;
    back = seen;
  }
  Vector3d x = best->center;
  if (const double length = back.norm(); length > 0) x += best->factor * (back / length);
  if (const double length = n.norm(); length > 0) x += n * (margin_ / length);
  return x;
}

Box Convex::bounds() const {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.high(k) = support(Vector3d::Unit(k));
    box.low(k) = -support(-Vector3d::Unit(k));
  }
  if (is_hull()) return box;  // nothing was rounded
  const double slack = 0x1p-48 * (box.low.cwiseAbs().maxCoeff() + box.high.cwiseAbs().maxCoeff());
  box.low.array() -= slack;
  box.high.array() += slack;
  return box;
}

std::vector<Vector3d> Convex::corners() const {
  std::vector<Vector3d> all;
  for (const Piece& piece : pieces_) {
    const Matrix3d axes = piece.factor * (1 + 1e-12);
    for (int i = 0; i < 1 << piece.rank; ++i) {
      Vector3d x = piece.center;
      for (int k = 0; k < piece.rank; ++k) x += (i >> k & 1 ? 1 : -1) * axes.col(k);
      all.push_back(x);
    }
  }
  return all;
}

Vector3d Convex::middle() const {
  Vector3d sum = Vector3d::Zero();
  for (const Piece& piece : pieces_) sum += piece.center / static_cast<double>(pieces_.size());
  return sum;
}

Convex Convex::swollen(double by) const {
  require_length("margin", by);
  require_length("margin", margin_ + by);
  Convex result = *this;
  result.margin_ += by;
  return result;
}

Convex Convex::translated(const Vector3d& by) const {
  std::vector<Piece> moved = pieces_;
  for (Piece& piece : moved) {
    piece.center += by;
    require_point("by", piece.center);
  }
  return {std::move(moved), margin_, word_};
}

Convex Convex::scaled(double scale) const {
  if (!(std::isfinite(scale) && scale > 0))
    throw InputError("scale", to_text(scale), "a positive finite number");
  std::vector<Piece> image = pieces_;
  for (Piece& piece : image) {
    piece.center *= scale;
    piece.factor *= scale;
    if (piece.shape) *piece.shape = (*piece.shape * scale) * scale;
  }
  return {std::move(image), margin_ * scale, word_};
}

Convex in_world(const Convex& body, const Pose& pose) {
  if (is_upright(pose)) return pose.position.isZero(0) ? body : body.translated(pose.position);
  std::vector<Piece> pieces = body.pieces();
  for (Piece& piece : pieces) {
    piece.center = pose.to_world(piece.center);
    piece.factor = pose.rotation * piece.factor;
    if (piece.shape) *piece.shape = turned<3>(pose.rotation, *piece.shape);
  }
  return {std::move(pieces), body.margin(), body.word()};
}

}  // namespace vericone
