// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/body_numbers.h>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

class Writer {
 public:
  explicit Writer(std::vector<double>& to) : to_(to) {}

  void operator()(double x) { to_.push_back(x); }
  template <int Columns>
  void operator()(const Eigen::Matrix<double, 3, Columns>& x) {
    to_.insert(to_.end(), x.data(), x.data() + x.size());
  }
  template <typename T>
  void operator()(const std::vector<T>& list) {
    (*this)(double(list.size()));
    for (const T& one : list) (*this)(one);
  }
  void operator()(const Delimiter<3>& one) {
    (*this)(one.matrix);
    (*this)(one.level);
  }
  void operator()(const CombinedEllipsoid& body) {
    const Ellipsoid& e = body.ellipsoid();
    (*this)(e.center());
    (*this)(e.shape());
    (*this)(e.factor());
    (*this)(double(e.defined_by_factor()));
    (*this)(body.delimiters());
  }
  void operator()(const HullBody& hull) { (*this)(hull.points()); }
  void operator()(const Convex::Piece& piece) {
    (*this)(piece.center);
    (*this)(piece.factor);
    (*this)(double(piece.rank));
    (*this)(double(piece.shape.has_value()));
    if (piece.shape) (*this)(*piece.shape);
  }
  void operator()(const Convex& body) {
    (*this)(body.pieces());
    (*this)(body.margin());
  }
  void operator()(const std::array<Vector3d, 3>& triangle) {
    for (const Vector3d& corner : triangle) (*this)(corner);
  }
  void operator()(const Box& box) {
    (*this)(box.low);
    (*this)(box.high);
  }
  void operator()(const Assembly& body) {
    (*this)(double(body.kind()));
    (*this)(body.radius());
    const Assembly::Storage& storage = body.by_slot();
    switch (body.kind()) {
      case PieceKind::triangle:
        return in_order(body, storage.triangles);
      case PieceKind::ball:
        return in_order(body, storage.balls);
      case PieceKind::box:
        return in_order(body, storage.boxes);
      case PieceKind::hull:
        return in_order(body, storage.hulls);
      case PieceKind::convex:
        return in_order(body, storage.convexes);
    }
  }

 private:
  /// As they were given, so that the same tree is built of them.
  template <typename T>
  void in_order(const Assembly& body, const std::vector<T>& by_slot) {
    const auto& order = body.hierarchy().order();
    std::vector<const T*> given(by_slot.size());
    for (std::size_t slot = 0; slot < by_slot.size(); ++slot) given[order[slot]] = &by_slot[slot];
    (*this)(double(given.size()));
    for (const T* one : given) (*this)(*one);
  }

  std::vector<double>& to_;
};

class Reader {
 public:
  explicit Reader(std::span<const double> from) : from_(from) {}

  Body body() {
    Body found = of_shape(whole(4));
    if (at_ != from_.size()) refuse(at_, "the end: a body is complete before");
    return found;
  }

 private:
  [[noreturn]] void refuse(std::size_t i, const std::string& what) const {
    throw InputError("numbers[" + std::to_string(i) + "]", i < from_.size() ? to_text(from_[i]) : "the end",
                     what);
  }
  double number() {
    if (at_ >= from_.size() || !std::isfinite(from_[at_])) refuse(at_, "a finite number");
    return from_[at_++];
  }
  std::size_t whole(std::size_t most) {
    const double x = number();
    if (!(x >= 0 && x <= double(most) && x == std::floor(x)))
      refuse(at_ - 1, "a whole number, at most " + std::to_string(most));
    return static_cast<std::size_t>(x);
  }
  template <int Columns>
  Eigen::Matrix<double, 3, Columns> matrix() {
    Eigen::Matrix<double, 3, Columns> x;
    for (double& entry : x.reshaped()) entry = number();
    return x;
  }
  Vector3d vector() { return matrix<1>(); }
  Matrix3d square() { return matrix<3>(); }
  /// Each takes `size` numbers at least.
  template <typename F>
  auto list(std::size_t size, F one) {
    const std::size_t count = whole((from_.size() - at_) / size);
    std::vector<decltype(one())> all;
    all.reserve(count);
    for (std::size_t i = 0; i < count; ++i) all.push_back(one());
    return all;
  }
  /// Whether S = F F^T to the rounding of another machine, entry by entry, and of products below the doubles.
  static bool fits(const Matrix3d& shape, const Matrix3d& factor) {
    constexpr double kPart = 1e-12, kLeast = 8 * std::numeric_limits<double>::denorm_min();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (shape(i, j) != shape(j, i) ||
            !(std::abs(factor.row(i).dot(factor.row(j)) - shape(i, j)) <=
              kPart * factor.row(i).stableNorm() * factor.row(j).stableNorm() + kLeast))
          return false;
    return true;
  }
  Ellipsoid ellipsoid() {
    const std::size_t start = at_;
    const Vector3d center = vector();
    const Matrix3d shape = square(), factor = square();
    const bool by_factor = whole(1) == 1;
    const auto body = Ellipsoid::trusted(center, shape, factor, by_factor);
    if (!fits(shape, factor) || !exact::positive_definite<3>(exact::defining_shape<3>(body)))
      refuse(start, "the centre, shape S = F F^T and factor F of an ellipsoid");
    return body;
  }
  CombinedEllipsoid combined() {
    const Ellipsoid whole_body = ellipsoid();
    auto delimiters = list(10, [&] {
      Delimiter<3> one;
      one.matrix = square();
      one.level = number();
      return one;
    });
    if (delimiters.empty()) return whole_body;
    (void)CombinedEllipsoid(whole_body, delimiters);  // each cuts it, or is refused
    return CombinedEllipsoid::trusted(whole_body, std::move(delimiters));
  }
  std::vector<Vector3d> points() {
    return list(3, [&] { return vector(); });
  }
  HullBody hull() { return HullBody(points()); }
  Box box() {
    const Vector3d low = vector();
    return {low, vector()};
  }
  Convex convex() {
    auto pieces = list(14, [&] {
      Convex::Piece piece;
      piece.center = vector();
      piece.factor = square();
      piece.rank = int(whole(3));
      if (whole(1) == 1) piece.shape = square();
      return piece;
    });
    return Convex::of_pieces(std::move(pieces), number());
  }
  Assembly mesh() {
    std::vector<Vector3d> corners;
    std::vector<Assembly::Triangle> triangles;
    for (const Matrix3d& one : list(9, [&] { return square(); })) {
      const auto first = std::uint32_t(corners.size());
      triangles.push_back({first, first + 1, first + 2});
      for (int k = 0; k < 3; ++k) corners.push_back(one.col(k));
    }
    return Assembly::mesh(std::move(corners), std::move(triangles));
  }
  Assembly assembly() {
    const auto kind = PieceKind(whole(4));
    const double radius = number();
    switch (kind) {
      case PieceKind::triangle:
        return mesh();
      case PieceKind::ball:
        return Assembly::cloud(points(), radius);
      case PieceKind::box:
        return Assembly::boxes(list(6, [&] { return box(); }));
      case PieceKind::hull:
        return Assembly::polyhedra(list(4, [&] { return hull(); }));
      case PieceKind::convex:
        break;
    }
    return Assembly::convexes(list(16, [&] { return convex(); }));
  }
  Body of_shape(std::size_t shape) {
    switch (shape) {
      case 0:
        return combined();
      case 1:
        return hull();
      case 2:
        return assembly();
      case 3:
        return Body::pieces(list(23, [&] { return combined(); }));
      default:
        return convex();
    }
  }

  std::span<const double> from_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<double> body_numbers(const Body& body) {
  std::vector<double> numbers{double(body.shape().index())};
  std::visit(Writer(numbers), body.shape());
  return numbers;
}

Body body_of_numbers(std::span<const double> numbers) { return Reader(numbers).body(); }

}  // namespace vericone
