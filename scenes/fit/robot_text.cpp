// SPDX-License-Identifier: BSD-3-Clause
#include "fit/robot_text.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace vericone::fit {
namespace {

using fitting::Solid, fitting::SolidKind;

/// A tag of a text that is good XML: <name ...>, </name> or <name .../>.
struct Tag {
  std::string name;
  std::size_t begin = 0, end = 0;
  bool closes = false, alone = false;
};

/// The next tag from `at` on, over comments, instructions and CDATA; begin is npos where there is none.
Tag next_tag(const std::string& text, std::size_t at) {
  for (;;) {
    at = text.find('<', at);
    if (at == std::string::npos) return {{}, at, at};
    bool other = false;
    for (const auto& [opens, ends] :
         {std::pair("<!--", "-->"), std::pair("<?", "?>"), std::pair("<![CDATA[", "]]>")})
      if (text.compare(at, std::strlen(opens), opens) == 0) {
        at = text.find(ends, at + std::strlen(opens));
        other = true;
      }
    if (!other) break;
    if (at == std::string::npos) return {{}, at, at};
  }
  Tag tag;
  tag.begin = at;
  tag.closes = text[at + 1] == '/';
  const std::size_t name = at + (tag.closes ? 2 : 1), name_end = text.find_first_of(" \t\r\n/>", name);
  tag.name = text.substr(name, name_end - name);
  char quote = 0;
  for (at = name_end; at < text.size() && (quote || text[at] != '>'); ++at) {
    if (quote)
      quote = text[at] == quote ? char(0) : quote;
    else if (text[at] == '"' || text[at] == '\'')
      quote = text[at];
  }
  tag.end = std::min(at + 1, text.size());
  tag.alone = !tag.closes && text[at - 1] == '/';
  return tag;
}

/// Of `name` in the tag, as it is written; entities stay.
std::string attribute_of(const std::string& text, const Tag& tag, const std::string& name) {
  for (std::size_t at = tag.begin; (at = text.find(name, at)) < tag.end; at += name.size()) {
    if (std::strchr(" \t\r\n", text[at - 1]) == nullptr) continue;
    std::size_t equals = text.find_first_not_of(" \t\r\n", at + name.size());
    if (equals >= tag.end || text[equals] != '=') continue;
    const std::size_t quote = text.find_first_of("\"'", equals);
    return text.substr(quote + 1, text.find(text[quote], quote + 1) - quote - 1);
  }
  return {};
}

/// The end of the element that a tag begins.
std::size_t element_end(const std::string& text, const Tag& first) {
  if (first.alone) return first.end;
  std::size_t at = first.end;
  for (int depth = 1; depth > 0;) {
    const Tag tag = next_tag(text, at);
    if (tag.begin == std::string::npos) return text.size();
    depth += tag.closes ? -1 : tag.alone ? 0 : 1;
    at = tag.end;
  }
  return at;
}

CollisionText collision_of(const std::string& text, const Tag& tag) {
  CollisionText result{attribute_of(text, tag, "name"), tag.begin, element_end(text, tag), {}};
  if (tag.alone) return result;
  for (std::size_t at = tag.end;;) {
    const Tag child = next_tag(text, at);
    if (child.begin == std::string::npos || child.closes) return result;
    at = element_end(text, child);
    if (child.name != "pose" && child.name != "origin" && child.name != "geometry" && child.name != "name")
      result.properties.append(text, child.begin, at - child.begin);
  }
}

std::string numbers_text(const Eigen::Vector3d& x) {
  return to_text(x.x()) + " " + to_text(x.y()) + " " + to_text(x.z());
}

std::string urdf_shape(const Solid& solid) {
  const Eigen::Vector3d& s = solid.sizes;
  const std::string name = fitting::to_string(solid.kind);
  if (solid.kind == SolidKind::box) return R"(<box size=")" + numbers_text(2 * s) + R"("/>)";
  if (solid.kind == SolidKind::sphere) return R"(<sphere radius=")" + to_text(s(0)) + R"("/>)";
  if (solid.kind == SolidKind::ellipsoid)
    throw InputError("--kinds", name, "sphere, cylinder, box or capsule: URDF has no " + name);
  return "<" + name + R"( radius=")" + to_text(s(0)) + R"(" length=")" + to_text(s(1)) + R"("/>)";
}

std::string sdf_shape(const Solid& solid) {
  const Eigen::Vector3d& s = solid.sizes;
  const std::string name = fitting::to_string(solid.kind);
  const auto element = [](const std::string& of, const std::string& value) {
    return "<" + of + ">" + value + "</" + of + ">";
  };
  std::string sizes = element("radius", to_text(s(0)));
  if (solid.kind == SolidKind::box) sizes = element("size", numbers_text(2 * s));
  if (solid.kind == SolidKind::ellipsoid) sizes = element("radii", numbers_text(s));
  if (solid.kind == SolidKind::capsule || solid.kind == SolidKind::cylinder)
    sizes += element("length", to_text(s(1)));
  return element(name, sizes);
}

std::string collision_text(const Solid& solid, bool urdf, const std::string& name,
                           const std::string& properties) {
  const Eigen::Vector3d angles = angles_of(solid.rotation);
  const std::string place =
      urdf ? R"(<origin xyz=")" + numbers_text(solid.center) + R"(" rpy=")" + numbers_text(angles) + R"("/>)"
           : "<pose>" + numbers_text(solid.center) + " " + numbers_text(angles) + "</pose>";
  std::string quoted;
  for (const char c : name) quoted += c == '"' ? "&quot;" : std::string(1, c);
  return R"(<collision name=")" + quoted + R"(">)" + place + "<geometry>" +
         (urdf ? urdf_shape(solid) : sdf_shape(solid)) + "</geometry>" + properties + "</collision>";
}

/// The line break and blanks before a place.
std::string indent_before(const std::string& text, std::size_t at) {
  std::size_t from = at;
  while (from > 0 && (text[from - 1] == ' ' || text[from - 1] == '\t')) --from;
  return from > 0 && text[from - 1] == '\n' ? "\n" + text.substr(from, at - from) : " ";
}

}  // namespace

std::vector<LinkText> links_of(const std::string& text) {
  std::vector<LinkText> links;
  struct Open {
    std::string name, named;
  };
  std::vector<Open> open;
  for (std::size_t at = 0;;) {
    const Tag tag = next_tag(text, at);
    if (tag.begin == std::string::npos) return links;
    at = tag.end;
    if (tag.closes) {
      if (!open.empty()) open.pop_back();
    } else if (tag.name == "collision" && !open.empty() && open.back().name == "link") {
      std::string name;
      for (const Open& above : open)
        if (above.name == "model") name += above.named + "::";
      name += open.back().named;
      if (links.empty() || links.back().name != name) links.push_back({name, {}});
      links.back().collisions.push_back(collision_of(text, tag));
      at = links.back().collisions.back().end;
    } else if (!tag.alone) {
      open.push_back({tag.name, attribute_of(text, tag, "name")});
    }
  }
}

std::string with_collisions(const std::string& text, bool urdf,
                            const std::vector<Replacement>& replacements) {
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Edit> edits;
  for (const Replacement& r : replacements) {
    if (r.gone.empty()) continue;
    const CollisionText& first = r.link.collisions[r.gone.front()];
    const std::string base = first.name.empty() ? r.link.name.substr(r.link.name.rfind(':') + 1) : first.name;
    std::string all;
    for (std::size_t k = 0; k < r.solids.size(); ++k)
      all += (k > 0 ? indent_before(text, first.begin) : "") +
             collision_text(r.solids[k], urdf, base + "_fit_" + std::to_string(k), first.properties);
    edits.push_back({first.begin, first.end, all});
    for (std::size_t k = 1; k < r.gone.size(); ++k) {
      const CollisionText& gone = r.link.collisions[r.gone[k]];
      const std::string before = indent_before(text, gone.begin);
      edits.push_back({gone.begin - (before[0] == '\n' ? before.size() : 0), gone.end, ""});
    }
  }
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  std::string result = text;
  for (const Edit& edit : edits) result.replace(edit.begin, edit.end - edit.begin, edit.text);
  return result;
}

Eigen::Vector3d angles_of(const Eigen::Matrix3d& r) {
  const double across = std::hypot(r(0, 0), r(1, 0)), pitch = std::atan2(-r(2, 0), across);
  if (across > 1e-6) return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
  return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0};  // roll and yaw turn about one axis
}

}  // namespace vericone::fit
