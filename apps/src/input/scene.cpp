// SPDX-License-Identifier: BSD-3-Clause
#include "input/scene.h"

#include <yaml-cpp/yaml.h>

#include <vericone/geometry/error.h>
#include <charconv>
#include <filesystem>
#include <set>

#include "json_value.h"

namespace vericone::input {
namespace {

/// A plain scalar by the YAML core schema; quoted ones stay text.
Json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text.empty() || text == "~" || text == "null") return nullptr;
  if (text == "true") return true;
  if (text == "false") return false;
  const char* first = text.data() + (text.front() == '+' ? 1 : 0);
  double number = 0;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
  // from_chars also takes "inf" and "nan", which are not numbers here, and reports overflow by its error.
  const bool digit = std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (error == std::errc() && end == text.data() + text.size() && digit) return number;
  return text;
}

Json to_json(const YAML::Node& node, const std::string& path, int depth) {
  if (depth > 20) throw InputError(path, "more than 20 levels", "nested less deeply");
  switch (node.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null:
      return nullptr;
    case YAML::NodeType::Scalar:
      return scalar(node);
    case YAML::NodeType::Sequence: {
      Json list = Json::array();
      for (std::size_t i = 0; i < node.size(); ++i)
        list.push_back(to_json(node[i], path + "[" + std::to_string(i) + "]", depth + 1));
      return list;
    }
    case YAML::NodeType::Map: {
      Json object = Json::object();
      for (const auto& entry : node) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
        const std::string field = path.empty() ? key : path + "." + key;
        if (object.contains(key)) throw InputError(field, "given twice", "given once");
        object[key] = to_json(entry.second, field, depth + 1);
      }
      return object;
    }
  }
  return nullptr;
}

}  // namespace

Json read_scene_fields(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw InputError(path, "no such file", "a scene file (YAML)");
  YAML::Node root;
  try {
    root = YAML::LoadFile(path);
  } catch (const YAML::Exception& e) {
    throw InputError(path + ":" + std::to_string(e.mark.line + 1), e.msg, "valid YAML");
  }
  return to_json(root, "", 0);
}

AnyEngagement read_scene(const std::string& path) {
  return read_engagement(read_scene_fields(path), Velocities::optional, {"name", "lidars", "pose_error"},
                         std::filesystem::path(path).parent_path());
}

}  // namespace vericone::input
