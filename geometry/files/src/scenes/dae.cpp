// SPDX-License-Identifier: BSD-3-Clause
//
// COLLADA (.dae) 1.4 and 1.5: the polygons of a scene, placed by its nodes, in metres and with z up, as its
// <unit> and <up_axis> say. An own reader on the XML of robots: assimp keeps floats, and cuts, joins and
// drops polygons its own way.
#include <vericone/geometry/error.h>
#include <vericone/internal/files/xml.h>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "../source.h"
#include "../text.h"
#include "placed_mesh.h"

namespace vericone::files {
namespace {

using Eigen::Vector3d, xml::Element, xml::refuse;

std::vector<double> dae_numbers(const Element& element) {
  std::vector<double> all;
  Words words(element.text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (all.size() % 4096 == 0) checkpoint();
    const auto x = to_number(word);
    if (!x)
      refuse(element.line, "<" + element.name + "> with " + in_quotes(word),
             "numbers in the range of double");
    all.push_back(*x);
  }
  return all;
}

/// As many as its kind has.
std::vector<double> dae_numbers(const Element& element, std::size_t count) {
  std::vector<double> all = dae_numbers(element);
  bool finite = all.size() == count;
  for (const double x : all) finite = finite && std::isfinite(x);
  if (!finite)
    refuse(element.line, "<" + element.name + "> of " + std::to_string(all.size()),
           std::to_string(count) + " finite numbers");
  return all;
}

std::vector<std::size_t> dae_indices(const Element& element) {
  std::vector<std::size_t> all;
  Words words(element.text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (all.size() % 4096 == 0) checkpoint();
    const auto x = to_integer(word);
    if (!x || *x < 0)
      refuse(element.line, "<" + element.name + "> with " + in_quotes(word), "whole numbers from 0");
    all.push_back(std::size_t(*x));
  }
  return all;
}

const std::string& dae_attribute(const Element& element, const char* attribute) {
  const std::string* given = element.attribute(attribute);
  if (!given)
    refuse(element.line, "<" + element.name + ">", std::string("one with ") + attribute + "=\"...\"");
  return *given;
}

std::size_t whole_of(const Element& element, const char* attribute, std::optional<std::size_t> otherwise) {
  const std::string* given = element.attribute(attribute);
  if (!given && otherwise) return *otherwise;
  const auto x = to_integer(dae_attribute(element, attribute));
  constexpr std::int64_t kMost = 1'000'000'000;
  if (!x || *x < 0 || *x > kMost)
    refuse(element.line, std::string(attribute) + "=" + in_quotes(*given), "a whole number from 0");
  return std::size_t(*x);
}

/// The points of a geometry and its polygons.
struct DaeMesh {
  std::vector<Vector3d> points;
  std::vector<Face> faces;
};

class DaeReader {
 public:
  explicit DaeReader(const Source& source)
      : root_(xml::parse(source.bytes)), mesh_(source, source.bytes.size()) {}

  Parsed read() {
    if (root_.name != "COLLADA") refuse(root_.line, "<" + root_.name.substr(0, 40) + ">", "<COLLADA>");
    gather(root_);
    const Placement upright = upright_placement();
    if (const Element* scene = visual_scene())
      for (const Element& one : scene->children) {
        if (one.name == "node") add_node(one, upright, 1);
      }
    else
      for (const Element& library : root_.children)
        if (library.name == "library_geometries")
          for (const Element& geometry : library.children)
            if (geometry.name == "geometry") add_geometry(geometry, upright);
    Parsed parsed = mesh_.take();
    const std::string* version = root_.attribute("version");
    parsed.format = "COLLADA" + (version ? " " + version->substr(0, 10) : "");
    return parsed;
  }

 private:
  static constexpr int kMostLevels = 64;

  void gather(const Element& element) {
    if (const std::string* id = element.attribute("id"))
      if (const auto [found, is_new] = by_id_.emplace(std::pair(element.name, *id), &element); !is_new)
        found->second = nullptr;  // which is meant cannot be said
    for (const Element& child : element.children) gather(child);
  }

  /// What a url or a source names: "#ID" of this file.
  const Element& named(const Element& by, const char* attribute, const char* kind) const {
    const std::string& url = dae_attribute(by, attribute);
    const auto found =
        url.starts_with('#') ? by_id_.find(std::pair(std::string(kind), url.substr(1))) : by_id_.end();
    if (found == by_id_.end() || !found->second)
      refuse(by.line, std::string(attribute) + "=" + in_quotes(url),
             std::string("#ID of one <") + kind + "> of this file");
    return *found->second;
  }

  Placement upright_placement() const {
    Placement result;
    const Element* asset = root_.child("asset");
    const Element* up = asset ? asset->child("up_axis") : nullptr;
    const std::string_view axis = up ? Words(up->text).next() : "Y_UP";
    if (axis == "Y_UP")
      result.linear << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    else if (axis == "X_UP")
      result.linear << 0, -1, 0, 0, 0, -1, 1, 0, 0;  // to the right is -y, towards the viewer z
    else if (axis != "Z_UP")
      refuse(up->line, "<up_axis> " + in_quotes(axis), "X_UP, Y_UP or Z_UP");
    if (const Element* unit = asset ? asset->child("unit") : nullptr)
      if (const std::string* meter = unit->attribute("meter")) {
        const auto x = to_number(*meter);
        if (!x || !(*x > 0) || !std::isfinite(*x))
          refuse(unit->line, "meter=" + in_quotes(*meter), "a positive number of metres");
        result.linear *= *x;
      }
    return result;
  }

  /// Null where none is named, or there.
  const Element* visual_scene() const {
    if (const Element* scene = root_.child("scene")) {
      if (const Element* instance = scene->child("instance_visual_scene"))
        return &named(*instance, "url", "visual_scene");
    }
    const Element* library = root_.child("library_visual_scenes");
    return library ? library->child("visual_scene") : nullptr;
  }

  static Placement local_placement(const Element& step) {
    Placement local;
    if (step.name == "matrix") {
      const auto m = dae_numbers(step, 16);  // by rows
      if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
        refuse(step.line, "<matrix> with another last row", "0 0 0 1");
      local.linear << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
      local.shift << m[3], m[7], m[11];
    } else if (step.name == "translate") {
      local.shift = Vector3d(dae_numbers(step, 3).data());
    } else if (step.name == "scale") {
      local.linear = Vector3d(dae_numbers(step, 3).data()).asDiagonal();
    } else if (step.name == "rotate") {
      const auto x = dae_numbers(step, 4);
      const Vector3d axis(x[0], x[1], x[2]);
      const double length = axis.stableNorm();
      // Quarters of a turn as they are meant: pi is rounded.
      const double quarters = x[3] / 90;
      if (x[3] != 0 && !(length > 0)) refuse(step.line, "<rotate> about no axis", "an axis and degrees");
      if (x[3] != 0) local.linear = turn_about(axis / length, quarters);
    } else if (step.name == "lookat" || step.name == "skew") {
      refuse(step.line, "<" + step.name + ">", "matrix, translate, rotate or scale");
    }
    return local;
  }

  /// Exact by whole quarters of a turn about the axes.
  static Eigen::Matrix3d turn_about(const Vector3d& axis, double quarters) {
    double sine = std::sin(quarters * std::numbers::pi / 2),
           cosine = std::cos(quarters * std::numbers::pi / 2);
    if (const double rest = std::fmod(quarters, 4); rest == std::floor(rest)) {
      constexpr double kSines[] = {0, 1, 0, -1};
      const int whole = (int(rest) + 4) % 4;
      sine = kSines[whole];
      cosine = kSines[(whole + 1) % 4];
    }
    Eigen::Matrix3d across;
    across << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
    return cosine * Eigen::Matrix3d::Identity() + sine * across + (1 - cosine) * axis * axis.transpose();
  }

  void add_node(const Element& node, const Placement& in, int level) {
    if (level > kMostLevels)
      refuse(node.line, "more levels of nodes", "at most " + std::to_string(kMostLevels) + ", in no circle");
    mesh_.count(1);
    Placement here = in;
    for (const Element& one : node.children) here = here * local_placement(one);
    for (const Element& one : node.children) {
      if (one.name == "node") add_node(one, here, level + 1);
      if (one.name == "instance_node") add_node(named(one, "url", "node"), here, level + 1);
      if (one.name == "instance_geometry") add_geometry(named(one, "url", "geometry"), here);
      if (one.name == "instance_controller")
        refuse(one.line, "<instance_controller>", "left out: a mesh that bones move has no one shape");
    }
  }

  void add_geometry(const Element& geometry, const Placement& here) {
    auto [found, is_new] = meshes_.try_emplace(&geometry);
    DaeMesh& mesh = found->second;
    if (is_new) {
      if (geometry.child("convex_mesh"))
        refuse(geometry.line, "<convex_mesh>", "<mesh>, of the hull that is meant");
      if (const Element* content = geometry.child("mesh")) read_mesh(*content, mesh);
    }
    std::size_t corners = mesh.points.size();
    for (const Face& face : mesh.faces) corners += face.size();
    mesh_.count(corners);
    mesh_.add(mesh.points, mesh.faces, here);
  }

  void read_mesh(const Element& content, DaeMesh& mesh) {
    std::map<const Element*, std::size_t> first;  // of a source's points
    for (const Element& part : content.children) {
      const bool is_part = part.name == "triangles" || part.name == "polylist" || part.name == "polygons" ||
                           part.name == "tristrips" || part.name == "trifans";
      if (is_part) read_part(part, mesh, first);
    }
  }

  void read_part(const Element& part, DaeMesh& mesh, std::map<const Element*, std::size_t>& first) {
    const Element* positions = nullptr;
    std::size_t offset = 0, stride = 0;
    for (const Element& input : part.children) {
      if (input.name != "input") continue;
      const std::size_t at = whole_of(input, "offset", std::nullopt);
      stride = std::max(stride, at + 1);
      if (dae_attribute(input, "semantic") != "VERTEX") continue;
      offset = at;
      for (const Element& inner : named(input, "source", "vertices").children)
        if (inner.name == "input" && dae_attribute(inner, "semantic") == "POSITION")
          positions = &named(inner, "source", "source");
    }
    const bool has_corners = part.child("p") || part.child("ph");
    if (!positions) {
      if (!has_corners) return;
      refuse(part.line, "<" + part.name + "> without VERTEX and its POSITION", "one with places");
    }
    const auto [known, is_new] = first.try_emplace(positions, mesh.points.size());
    if (is_new) append_points(*positions, mesh.points);
    const std::size_t begin = known->second, count = count_of_[positions];
    // The corner's index of each group of `stride`.
    const auto corners = [&](const Element& p) {
      const std::vector<std::size_t> all = dae_indices(p);
      if (all.size() % stride != 0)
        refuse(p.line, "<p> of " + std::to_string(all.size()) + " indices",
               "a multiple of " + std::to_string(stride) + ", as the inputs take");
      Face face;
      for (std::size_t i = offset; i < all.size(); i += stride) {
        if (all[i] >= count)
          refuse(p.line, "index " + std::to_string(all[i]),
                 "below " + std::to_string(count) + ", as there are points");
        face.push_back(std::uint32_t(begin + all[i]));
      }
      return face;
    };
    append_faces(part, corners, mesh.faces);
  }

  template <typename Corners>
  static void append_faces(const Element& part, const Corners& corners, std::vector<Face>& faces) {
    std::vector<std::size_t> sizes;
    if (const Element* given = part.child("vcount")) sizes = dae_indices(*given);
    for (const Element& p : part.children) {
      if (p.name == "ph")
        refuse(p.line, "<ph>, a polygon with holes", "polygons without holes: triangulated when exported");
      if (p.name != "p") continue;
      const Face all = corners(p);
      if (part.name == "polygons") {
        faces.push_back(all);
      } else if (part.name == "polylist") {
        std::size_t at = 0;
        for (const std::size_t size : sizes) {
          if (size > all.size() - at)
            refuse(p.line, "<p> that is shorter", "the corners that <vcount> counts");
          faces.emplace_back(all.begin() + std::ptrdiff_t(at), all.begin() + std::ptrdiff_t(at + size));
          at += size;
        }
        if (at != all.size()) refuse(p.line, "<p> that is longer", "the corners that <vcount> counts");
      } else if (part.name == "triangles") {
        if (all.size() % 3 != 0)
          refuse(p.line, "<p> of " + std::to_string(all.size()) + " corners", "three for each triangle");
        for (std::size_t i = 0; i < all.size(); i += 3) faces.push_back({all[i], all[i + 1], all[i + 2]});
      } else {
        for (std::size_t i = 0; i + 2 < all.size(); ++i) {
          const std::size_t odd = i % 2;
          faces.push_back(part.name == "tristrips" ? Face{all[i], all[i + 1 + odd], all[i + 2 - odd]}
                                                   : Face{all[0], all[i + 1], all[i + 2]});
        }
      }
    }
  }

  void append_points(const Element& source, std::vector<Vector3d>& points) {
    const Element* technique = source.child("technique_common");
    const Element* accessor = technique ? technique->child("accessor") : nullptr;
    if (!accessor) refuse(source.line, "<source> without <accessor>", "one with it");
    const std::vector<double> all = dae_numbers(named(*accessor, "source", "float_array"));
    const std::size_t count = whole_of(*accessor, "count", std::nullopt),
                      offset = whole_of(*accessor, "offset", 0), stride = whole_of(*accessor, "stride", 1);
    std::vector<std::size_t> places;  // of those that have a name
    std::size_t place = 0;
    for (const Element& param : accessor->children)
      if (param.name == "param") {
        const std::string* name = param.attribute("name");
        if ((name && !name->empty()) || param.attribute("sid")) places.push_back(place);
        ++place;
      }
    if (place == 0) places = {0, 1, 2};
    if (places.size() != 3 || places.back() >= stride)
      refuse(accessor->line,
             "an accessor of " + std::to_string(places.size()) + " params, stride " + std::to_string(stride),
             "X, Y and Z");
    if (count > all.size() || offset > all.size() || (count > 0 && stride > (all.size() - offset) / count))
      refuse(accessor->line, "count=" + std::to_string(count) + " of " + std::to_string(stride),
             "what the " + std::to_string(all.size()) + " numbers hold");
    count_of_[&source] = count;
    for (std::size_t i = 0; i < count; ++i) {
      const double* at = all.data() + offset + i * stride;
      points.emplace_back(at[places[0]], at[places[1]], at[places[2]]);
    }
  }

  Element root_;
  PlacedMesh mesh_;
  std::map<std::pair<std::string, std::string>, const Element*> by_id_;  // by kind; null: several
  std::map<const Element*, DaeMesh> meshes_;
  std::map<const Element*, std::size_t> count_of_;
};

}  // namespace

Parsed parse_dae(const Source& source) {
  try {
    return DaeReader(source).read();
  } catch (const InputError& e) {
    if (!e.field().starts_with("line ")) throw;
    source.refuse(e.field() + ": " + e.value(), e.requirement());
  }
}

}  // namespace vericone::files
