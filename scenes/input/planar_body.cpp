// SPDX-License-Identifier: BSD-3-Clause
#include "input/planar_body.h"

#include "input/body_kind.h"
#include "json/json_value.h"

namespace vericone::input {
namespace {

/// An error of the library's, its field renamed to what stands in the input.
InputError renamed(const InputError& e, const std::string& from, const std::string& to) {
  if (!e.field().starts_with(from)) return e;
  return {to + e.field().substr(from.size()), e.value(), e.requirement()};
}

using Hyperbola = DelimiterFields<2, double>;

const Fields<Hyperbola>& hyperbola_fields() {
  static const Fields<Hyperbola> fields =
      Fields<Hyperbola>("hyperbolas")
          .row("semi_axes", &Hyperbola::semi_axes, axes<2>(),
               "`[a, b]`: x²/a² - y²/b² = 1 cuts dents at both ends of its x axis.",
               required("[a, b] in metres, a along its axis"))
          .row("rotation", &Hyperbola::rotation, number("radians"), "Relative to the body's.",
               absent("not turned"));
  return fields;
}

/// `a_c`, `b_c`, `k` and `phi`: the source's conic (5.5).
struct PlanarFields : QuadricFields<2, double> {
  double a_c = 0, b_c = 0, k = 0, phi = 0;
};

const Fields<PlanarFields>& planar_fields() {
  using P = PlanarFields;
  const auto length = shown_as(number("m"), {{"$ref", "body.schema.json#/$defs/positive"}});
  static const Fields<P> fields = [&] {
    Fields<P> rows("body");
    return with_quadric<2>(rows, shown_as(number("radians"), {{"$ref", "#/$defs/rotation"}}), "hyperbolas",
                           list("hyperbolas, each with semi_axes", mapping("hyperbola", hyperbola_fields())),
                           "With `semi_axes` in the plane: what delimits the ellipse.")
        .row("a_c", &P::a_c, length,
             "The source's conic (5.5), (x'/a_c)² + |(y'/b_c)² - k| = 1, in place of all others; with `b_c`, "
             "`k`, `phi`.",
             alternative())
        .row("b_c", &P::b_c, length, "See `a_c`.", alternative())
        .row("k", &P::k, shown_as(number(), {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}),
             "Of the source's conic, see `a_c`.", alternative())
        .row("phi", &P::phi, number("radians"), "The angle of the conic's x' axis.");
  }();
  return fields;
}

/// Whether the fields are a conic's. What holds of several fields together.
bool check_planar(const Json& value, const std::string& path) {
  planar_fields().require_known(value, path);
  const bool conic =
      value.contains("a_c") || value.contains("b_c") || value.contains("k") || value.contains("phi");
  const int kinds = value.contains("semi_axes") + value.contains("shape") + conic;
  if (kinds != 1)
    throw InputError(path, kinds == 0 ? "no shape" : "more than one shape",
                     "given by exactly one of semi_axes (with rotation), shape, a_c (with b_c, k, phi)");
  for (const char* other : {"rotation", "hyperbolas"})
    if (value.contains(other) && !value.contains("semi_axes"))
      throw InputError(path + "." + other, quoted(value[other]), "left out, or the body given by semi_axes");
  require_field(value, path, "center", "[x, y] in metres");
  if (conic)
    for (const auto& [field, what] :
         {std::pair("a_c", "a length in metres"), std::pair("b_c", "a length in metres"),
          std::pair("k", "a number between 0 and 1")})
      require_field(value, path, field, what);
  return conic;
}

CombinedEllipse dented(const PlanarFields& read) {
  try {
    return dented_conic(*read.center, read.a_c, read.b_c, read.k, read.phi);
  } catch (const InputError& e) {
    throw renamed(renamed(e, "semi_axes[0]", "a_c"), "semi_axes[1]", "b_c");
  }
}

CombinedEllipse by_axes(const PlanarFields& read) {
  const double angle = read.rotation.value_or(0);
  const Ellipse ellipse = Ellipse::from_axes(*read.center, *read.semi_axes, rotation_2d(angle));
  if (read.delimiters.empty()) return ellipse;
  std::vector<Delimiter<2>> delimiters;
  for (const Hyperbola& one : read.delimiters)
    delimiters.push_back(within(at("hyperbolas", delimiters.size()),
                                [&] { return hyperbola(one.semi_axes, angle + one.rotation.value_or(0)); }));
  try {
    return CombinedEllipse(ellipse, std::move(delimiters));
  } catch (const InputError& e) {
    std::string requirement = e.requirement();
    if (const auto at = requirement.find("ellipsoid"); at != std::string::npos)
      requirement.replace(at, 9, "ellipse");
    throw InputError(renamed(e, "hyperboloids", "hyperbolas").field(), "a curve that misses the ellipse",
                     requirement);
  }
}

}  // namespace

CombinedEllipse read_planar_body(const Json& value, const std::string& path) {
  require_object(value, path);
  const bool conic = check_planar(value, path);
  PlanarFields read;
  planar_fields().read_known(value, path, read);
  return within(path, [&]() -> CombinedEllipse {
    if (conic) return dented(read);
    if (read.shape) return Ellipse::from_shape(*read.center, *read.shape);
    return by_axes(read);
  });
}

Json planar_schema() { return planar_fields().schema(); }
Json hyperbola_schema() { return hyperbola_fields().schema(); }

}  // namespace vericone::input
