// SPDX-License-Identifier: BSD-3-Clause
//
// What defines the values that are no records: by it they compare, print and pickle, bit for bit.
#include <vericone/cones/opening/opening.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/world_body.h>
#include <cmath>
#include <utility>

#include "call.h"

namespace vericone::python {
namespace {

template <class... T>
PyObject* state_of(const T&... part) {
  return tuple_of({to_python(part)...});
}

void require_parts(PyObject* state, Py_ssize_t count) {
  if (PyTuple_GET_SIZE(state) != count)
    throw WrongType{"pickled by another version: " + std::to_string(count) + " parts are needed"};
}

template <class... T>
std::tuple<T...> parts(PyObject* state) {
  require_parts(state, sizeof...(T));
  Py_ssize_t i = 0;
  const auto next = [&](auto* kind) {
    using P = std::remove_pointer_t<decltype(kind)>;
    const Py_ssize_t at = i++;
    return Convert<P>::from(PyTuple_GET_ITEM(state, at), {nullptr, "state", at});
  };
  return std::tuple<T...>{next(static_cast<T*>(nullptr))...};  // in this order: braces
}

template <class T, class State, class Restore>
void describe_value(const char* names, State, Restore) {
  TypeInfo& info = type_of<T>();
  info.state_names = names;
  info.state = [](const void* value) { return State{}(*static_cast<const T*>(value)); };
  info.restore = [](PyObject* state) -> std::shared_ptr<void> { return own(new T(Restore{}(state))); };
}

/// An ellipsoid of the numbers that it had, bit for bit: those of a body, as the library stores them.
template <int D>
BasicEllipsoid<D> stored(const Eigen::Matrix<double, D, 1>& center, const Eigen::Matrix<double, D, D>& shape,
                         const Eigen::Matrix<double, D, D>& factor, bool by_factor) {
  bool sound = center.allFinite() && shape.allFinite() && factor.allFinite();
  // shape = factor * its transpose, to the rounding of another machine, entry by entry.
  for (int i = 0; i < D && sound; ++i)
    for (int j = 0; j < D && sound; ++j)
      sound = shape(i, i) > 0 && shape(i, j) == shape(j, i) &&
              std::abs(factor.row(i).dot(factor.row(j)) - shape(i, j)) <=
                  1e-12 * factor.row(i).norm() * factor.row(j).norm();
  const auto body = BasicEllipsoid<D>::trusted(center, shape, factor, by_factor);
  if (!sound || !exact::positive_definite<D>(exact::defining_shape<D>(body)))
    throw InputError("state", "numbers that are no ellipsoid's", "as an ellipsoid was pickled");
  return body;
}

template <int D>
BasicCombined<D> stored(const BasicEllipsoid<D>& ellipsoid, std::vector<Delimiter<D>> delimiters) {
  for (const Delimiter<D>& d : delimiters)
    if (!d.matrix.allFinite() || !std::isfinite(d.level))
      throw InputError("state", "numbers that are no delimiter's", "as a body was pickled");
  return BasicCombined<D>::trusted(ellipsoid, std::move(delimiters));
}

template <int D>
void describe_dimension() {
  using V = Eigen::Matrix<double, D, 1>;
  using M = Eigen::Matrix<double, D, D>;
  using Q = Eigen::Matrix<double, D + 1, D + 1>;
  describe_value<BasicEllipsoid<D>>(
      "center shape factor defined_by_factor",
      [](const auto& x) { return state_of(x.center(), x.shape(), x.factor(), x.defined_by_factor()); },
      [](PyObject* state) {
        return std::apply([](const auto&... part) { return stored<D>(part...); },
                          parts<V, M, M, bool>(state));
      });
  describe_value<BasicQuadric<D>>(
      "matrix", [](const auto& x) { return state_of(x.matrix()); },
      [](PyObject* state) { return BasicQuadric<D>(std::get<0>(parts<Q>(state))); });
  describe_value<BasicCombined<D>>(
      "ellipsoid delimiters", [](const auto& x) { return state_of(x.ellipsoid(), x.delimiters()); },
      [](PyObject* state) {
        return std::apply([](const auto&... part) { return stored<D>(part...); },
                          parts<BasicEllipsoid<D>, std::vector<Delimiter<D>>>(state));
      });
}

PyObject* assembly_state(const Assembly& x) {
  if (x.kind() == PieceKind::convex) {
    std::vector<Convex> pieces;
    for (std::size_t i = 0; i < x.size(); ++i) pieces.push_back(x.convex_piece(i));
    return tuple_of({to_python(x.kind()), to_python(x.radius()), to_python(pieces)});
  }
  // The pieces in their order: by slot they lie as the tree has them, which is made again.
  const std::size_t n = x.size();
  if (x.kind() == PieceKind::hull || x.kind() == PieceKind::box || x.kind() == PieceKind::ball ||
      x.kind() == PieceKind::triangle) {
    std::vector<HullBody> pieces;
    if (x.kind() == PieceKind::hull) {
      for (std::size_t i = 0; i < n; ++i) pieces.push_back(x.piece(i));
      return tuple_of({to_python(x.kind()), to_python(x.radius()), to_python(pieces)});
    }
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < n; ++i) {
      const HullBody piece = x.piece(i);
      if (x.kind() == PieceKind::box) {
        Eigen::Vector3d low = piece.points().front(), high = low;
        for (const auto& p : piece.points()) {
          low = low.cwiseMin(p);
          high = high.cwiseMax(p);
        }
        points.push_back(low);
        points.push_back(high);
      } else {
        points.insert(points.end(), piece.points().begin(), piece.points().end());
      }
    }
    return tuple_of({to_python(x.kind()), to_python(x.radius()), to_python(points)});
  }
  throw WrongType{"an assembly of pieces of a new kind"};
}

Assembly restored_assembly(PyObject* state) {
  require_parts(state, 3);
  const auto kind = Convert<PieceKind>::from(PyTuple_GET_ITEM(state, 0), {nullptr, "kind"});
  PyObject* pieces = PyTuple_GET_ITEM(state, 2);
  if (kind == PieceKind::hull)
    return Assembly::polyhedra(Convert<std::vector<HullBody>>::from(pieces, {nullptr, "pieces"}));
  if (kind == PieceKind::convex)
    return Assembly::convexes(Convert<std::vector<Convex>>::from(pieces, {nullptr, "pieces"}));
  const auto points = Convert<std::vector<Eigen::Vector3d>>::from(pieces, {nullptr, "pieces"});
  if (kind == PieceKind::ball)
    return Assembly::cloud(points, Convert<double>::from(PyTuple_GET_ITEM(state, 1), {nullptr, "radius"}));
  if (kind == PieceKind::box) {
    std::vector<Box> boxes(points.size() / 2);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].low = points[2 * i];
      boxes[i].high = points[2 * i + 1];
    }
    return Assembly::boxes(std::move(boxes));
  }
  std::vector<Assembly::Triangle> triangles(points.size() / 3);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
  return Assembly::mesh(points, std::move(triangles));
}

template <class T>
PyObject* copy_of(const T* value) {
  return to_python(*value);
}

}  // namespace

/// Of the types of _core, after they are made.
void describe_values() {
  describe_dimension<2>();
  describe_dimension<3>();
  describe_value<Interval>(
      "mid rad", [](const auto& x) { return state_of(x.mid(), x.rad()); },
      [](PyObject* state) { return std::make_from_tuple<Interval>(parts<double, double>(state)); });
  describe_value<HullBody>(
      "points", [](const auto& x) { return state_of(x.points()); },
      [](PyObject* state) { return HullBody(std::get<0>(parts<std::vector<Eigen::Vector3d>>(state))); });
  describe_value<Convex>(
      "pieces margin word", [](const auto& x) { return state_of(x.pieces(), x.margin(), x.word()); },
      [](PyObject* state) {
        auto [pieces, margin, word] = parts<std::vector<Convex::Piece>, double, std::string>(state);
        return Convex::of_pieces(std::move(pieces), margin).called(std::move(word));
      });
  describe_value<Assembly>(
      "kind radius pieces", [](const auto& x) { return assembly_state(x); },
      [](PyObject* state) { return restored_assembly(state); });
  describe_value<Body>(
      "shape", [](const auto& x) { return state_of(x.shape()); },
      [](PyObject* state) {
        require_parts(state, 1);
        PyObject* shape = PyTuple_GET_ITEM(state, 0);
        const Place place{nullptr, "shape"};
        if (PyList_Check(shape))
          return Body::pieces(Convert<std::vector<CombinedEllipsoid>>::from(shape, place));
        return Convert<Body>::from(shape, place);
      });
  describe_value<Placed>(
      "body pose", [](const auto& x) { return state_of(x.body, x.pose); },
      [](PyObject* state) { return std::make_from_tuple<Placed>(parts<Body, Pose>(state)); });
  describe_value<WorldBody>(
      "body",
      [](const auto& x) {
        return tuple_of({x.flat()      ? copy_of(x.flat())
                         : x.quadric() ? copy_of(x.quadric())
                         : x.hull()    ? copy_of(x.hull())
                                       : copy_of(x.placed())});
      },
      [](PyObject* state) {
        require_parts(state, 1);
        return Convert<WorldBody>::from(PyTuple_GET_ITEM(state, 0), {nullptr, "body"});
      });
  describe_value<ErrorSet>(
      "radius factors segments",
      [](const auto& x) { return state_of(x.radius(), x.factors(), x.segments()); },
      [](PyObject* state) {
        return std::apply(&ErrorSet::sum,
                          parts<double, std::vector<Eigen::Matrix3d>, std::vector<Eigen::Vector3d>>(state));
      });
  describe_value<Opening>(
      "semi_axes vertices", [](const auto& x) { return state_of(x.semi_axes(), x.vertices()); },
      [](PyObject* state) {
        const auto [axes, vertices] = parts<Eigen::Vector2d, std::vector<Eigen::Vector2d>>(state);
        return vertices.empty() ? Opening::ellipse(axes) : Opening::polygon(vertices);
      });
  describe_value<Pair>(
      "agent obstacle",
      [](const auto& x) { return state_of(x.agent(), x.obstacle(), x.guarantee().tolerance); },
      [](PyObject* state) {
        auto [agent, obstacle, tolerance] = parts<Placed, Placed, double>(state);
        PairOptions options;
        if (tolerance > 0) options.tolerance = tolerance;
        return Pair(std::move(agent), std::move(obstacle), options);
      });
}

}  // namespace vericone::python
