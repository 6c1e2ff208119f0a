// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/body_numbers.h>
#include <utility>
#include <vector>

#include "common.h"

using namespace vericone;
using namespace vericone::c;

namespace {

std::vector<Vector3d> points_of(const double* points, std::size_t count) {
  if (count > 0) given(points, "points");
  std::vector<Vector3d> list;
  list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(points + 3 * i);
  return list;
}

vericone_body* body_of(Body body) { return new vericone_body{std::move(body)}; }

Ellipsoid ellipsoid(const double* center, const double* semi_axes, const double* rotation) {
  return Ellipsoid::from_axes(vector(center, "center"), vector(semi_axes, "semi_axes"),
                              rotation_of(rotation));
}

Body union_of(const vericone_body* const* bodies, std::size_t count) {
  if (count > 0) given(bodies, "bodies");
  std::vector<CombinedEllipsoid> quadrics;
  std::vector<HullBody> hulls;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "bodies[" + std::to_string(i) + "]";
    const Body& body = given(bodies[i], name.c_str()).body;
    if (const auto* one = body.quadric())
      quadrics.push_back(*one);
    else if (const auto* hull = body.hull())
      hulls.push_back(*hull);
    else
      throw InputError(name, to_string(body.kind()), "an ellipsoid, a combined body or a hull");
    if (!quadrics.empty() && !hulls.empty())
      throw InputError(name, to_string(body.kind()),
                       "of the kind of those before it: ellipsoids and combined bodies, or hulls");
  }
  return hulls.empty() ? Body::pieces(std::move(quadrics)) : Body(Assembly::polyhedra(std::move(hulls)));
}

}  // namespace

extern "C" {

vericone_body* vericone_body_ellipsoid(const double center[3], const double semi_axes[3],
                                       const double rotation[9]) {
  return answered([&] { return body_of(ellipsoid(center, semi_axes, rotation)); });
}

vericone_body* vericone_body_combined(const double center[3], const double semi_axes[3],
                                      const double rotation[9], const vericone_hyperboloid* hyperboloids,
                                      size_t count) {
  return answered([&] {
    const Ellipsoid whole = ellipsoid(center, semi_axes, rotation);
    if (count > 0) given(hyperboloids, "hyperboloids");
    std::vector<Delimiter<3>> delimiters;
    for (std::size_t i = 0; i < count; ++i) {
      const vericone_hyperboloid& one = hyperboloids[i];
      try {
        delimiters.push_back(hyperboloid(one.sheets, Vector3d(one.semi_axes),
                                         rotation_of(rotation) * rotation_in(one.rotation)));
      } catch (const InputError& e) {
        throw e.within("hyperboloids[" + std::to_string(i) + "]");
      }
    }
    return body_of(CombinedEllipsoid(whole, std::move(delimiters)));
  });
}

vericone_body* vericone_body_hull(const double* points, size_t count) {
  return answered([&] { return body_of(HullBody(points_of(points, count))); });
}

vericone_body* vericone_body_box(const double low[3], const double high[3]) {
  return answered([&] { return body_of(HullBody::box(vector(low, "low"), vector(high, "high"))); });
}

vericone_body* vericone_body_mesh(const double* points, size_t count, const uint32_t* triangles,
                                  size_t triangle_count) {
  return answered([&] {
    if (triangle_count > 0) given(triangles, "triangles");
    std::vector<Assembly::Triangle> list(triangle_count);
    for (std::size_t i = 0; i < triangle_count; ++i) std::copy_n(triangles + 3 * i, 3, list[i].data());
    return body_of(Assembly::mesh(points_of(points, count), std::move(list)));
  });
}

vericone_body* vericone_body_cloud(const double* points, size_t count, double radius) {
  return answered([&] { return body_of(Assembly::cloud(points_of(points, count), radius)); });
}

vericone_body* vericone_body_boxes(const double* boxes, size_t count) {
  return answered([&] {
    if (count > 0) given(boxes, "boxes");
    std::vector<Box> list;
    for (std::size_t i = 0; i < count; ++i)
      list.push_back({Vector3d(boxes + 6 * i), Vector3d(boxes + 6 * i + 3)});
    return body_of(Assembly::boxes(std::move(list)));
  });
}

vericone_body* vericone_body_union(const vericone_body* const* bodies, size_t count) {
  return answered([&] { return body_of(union_of(bodies, count)); });
}

void vericone_body_free(vericone_body* body) { delete body; }

int32_t vericone_body_kind(const vericone_body* body) {
  return answered([&] { return int32_t(given(body, "body").body.kind()); });
}

int32_t vericone_body_bounds(const vericone_body* body, double low[3], double high[3]) {
  return answered([&] {
    const Box box = given(body, "body").body.bounds();
    write(box.low, low);
    write(box.high, high);
    return int32_t{VERICONE_OK};
  });
}

double vericone_body_support(const vericone_body* body, const double n[3]) {
  return answered([&] { return given(body, "body").body.support(vector(n, "n")); });
}

int32_t vericone_body_containing_ellipsoid(const vericone_body* body, double center[3], double shape[9]) {
  return answered([&] {
    const Ellipsoid& around = given(body, "body").body.containing_ellipsoid();
    write(around.center(), center);
    if (shape) std::copy_n(around.shape().data(), 9, shape);  // symmetric
    return int32_t{VERICONE_OK};
  });
}

int64_t vericone_body_numbers(const vericone_body* body, double* numbers, size_t capacity) {
  return answered([&] {
    const std::vector<double> all = body_numbers(given(body, "body").body);
    if (capacity > 0) std::copy_n(all.begin(), std::min(capacity, all.size()), &given(numbers, "numbers"));
    return int64_t(all.size());
  });
}

vericone_body* vericone_body_of_numbers(const double* numbers, size_t count) {
  return answered([&] {
    if (count > 0) given(numbers, "numbers");
    return body_of(body_of_numbers({numbers, count}));
  });
}

}  // extern "C"
