// SPDX-License-Identifier: BSD-3-Clause
#include "input/scene.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "input/assembly_body.h"
#include "input/field_table.h"
#include "input/file_body.h"
#include "input/text_source.h"
#include "json/json_value.h"
#include "json/plain_text.h"
#include "units/geographic.h"

namespace vericone::input {
namespace {

/// A plain scalar by the YAML core schema; quoted ones stay text.
Json scalar(const std::string& tag, const std::string& text) {
  if (tag == "!") return text;
  if (text == "true") return true;
  if (text == "false") return false;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
  // from_chars also takes "inf" and "nan", which are not numbers here, and reports overflow by its error.
  const bool digit = std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (error == std::errc() && end == text.data() + text.size() && digit) return number;
  return text;
}

[[noreturn]] void refuse_values(const std::string& where) {
  throw InputError(where, "more than " + std::to_string(kMostValues) + " values",
                   "a scene of fewer, aliases counted wherever they stand");
}

/// Builds the value while the document is read, so that every limit holds before memory is taken: few lines
/// of aliases can stand for more values than there are bytes.
class Builder : public YAML::EventHandler {
 public:
  Json take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { put({nullptr, 1, 0}, anchor, "?"); }
  void OnScalar(const YAML::Mark&, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    check_text(text);
    put({scalar(tag, text), 1, 0}, anchor, text);
  }
  void OnAlias(const YAML::Mark&, YAML::anchor_t anchor) override {
    const auto named = anchored_.find(anchor);
    if (named == anchored_.end())
      throw InputError(path(), "an alias of what it stands in", "without aliases of itself");
    const Built& same = named->second;
    const bool text = same.value.is_string();
    put(same, 0, text ? same.value.get<std::string>() : "?");
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Json::array(), anchor);
  }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Json::object(), anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Built {
    Json value;
    std::size_t values;  // it and all within
    int levels;          // of lists and mappings
  };
  struct Open {
    Built built;
    YAML::anchor_t anchor;
    std::optional<std::string> key;  // that waits for its value
  };

  /// Of what comes next.
  std::string path() const {
    std::string path;
    for (const Open& level : open_) {
      if (level.built.value.is_array())
        path = at(path, level.built.value.size());
      else if (level.key)
        path += (path.empty() ? "" : ".") + *level.key;
    }
    return path.empty() ? "scene" : path;
  }

  void check_text(const std::string& text) const {
    const auto refuse = [&](const char* requirement) {
      throw InputError(path(), "\"" + plain_text(text.substr(0, 60)) + "\"", requirement);
    };
    if (!is_utf8(text)) refuse("text in UTF-8");
    if (has_control_characters(text)) refuse("text on one line, without control characters");
  }

  void check_levels(int more) const {
    if (int(open_.size()) + more > kMostLevels)
      throw InputError(path(), "more than " + std::to_string(kMostLevels) + " levels", "nested less deeply");
  }

  void count(std::size_t values) {
    values_ += values;
    if (values_ > kMostValues) refuse_values(path() + ", up to here");
  }

  void open(Json empty, YAML::anchor_t anchor) {
    check_levels(1);
    open_.push_back({{std::move(empty), 1, 1}, anchor, {}});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    values_ -= done.built.values - 1;  // counted when they were put
    put(std::move(done.built), done.anchor, "?");
  }

  /// `key`: what the value is where a mapping expects a key.
  void put(Built built, YAML::anchor_t anchor, const std::string& key) {
    check_levels(built.levels);
    count(built.values);
    if (anchor != 0) anchored_[anchor] = built;
    if (open_.empty()) {
      root_ = std::move(built.value);
      return;
    }
    Open& top = open_.back();
    top.built.values += built.values;
    top.built.levels = std::max(top.built.levels, built.levels + 1);
    Json& value = top.built.value;
    if (value.is_array()) {
      value.push_back(std::move(built.value));
    } else if (top.key) {
      value[*top.key] = std::move(built.value);
      top.key.reset();
    } else {
      top.key = key;
      if (value.contains(key)) throw InputError(path(), "given twice", "given once");
      if (value.size() == kMostFields)
        throw InputError(path(), "field " + std::to_string(kMostFields + 1) + " of a mapping",
                         "one of at most " + std::to_string(kMostFields));
    }
  }

  Json root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Built> anchored_;
  std::size_t values_ = 0;
};

struct Words {
  const char *name, *reader;
};

Words words(FileKind kind) {
  switch (kind) {
    case FileKind::scene:
      return {"a scene", "vericone cone reads scenes"};
    case FileKind::scenario:
      return {"a scenario", "vericone simulate reads scenarios"};
    case FileKind::pursuit:
      return {"a pursuit", "vericone pursue reads pursuits"};
    case FileKind::paper:
      return {"figures or claims of a paper",
              "vericone figures and claims read them, by --paper and the folder"};
    case FileKind::body:
      return {"a body", "a scene or a scenario names it, {file: NAME}"};
    case FileKind::cases:
      return {"a file of cases, one JSON object a line", "vericone query reads cases"};
    case FileKind::unknown:
      break;
  }
  return {"", ""};
}

}  // namespace

FileKind kind_of_file(const Json& fields) {
  if (!fields.is_object()) return FileKind::unknown;
  const auto has = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return fields.contains(name); });
  };
  if (has({"figures", "claims"})) return FileKind::paper;
  if (has({"bodies"})) return FileKind::scenario;
  if (has({"uas", "cars", "cameras"})) return FileKind::pursuit;
  if (has({"agent"})) return FileKind::scene;
  if (has({"semi_axes", "shape", "quadric", "a_c", "pieces", "polygon", "stadium"}) || is_pieces_body(fields))
    return FileKind::body;
  return FileKind::unknown;
}

const char* name_of(FileKind kind) { return words(kind).name; }

void require_kind(const Json& fields, FileKind kind, const std::string& path) {
  const FileKind found = kind_of_file(fields);
  if (found == kind || found == FileKind::unknown) return;
  throw InputError(path, words(found).name, std::string(words(kind).name) + "; " + words(found).reader);
}

std::string read_scene_text(const std::string& path) {
  return TextSource(path, "a scene file (YAML)").whole();
}

Json scene_fields(const std::string& text, const std::string& path) {
  // The parser looks ahead as far as lists and mappings may go on.
  const auto opens = [](char c) { return c == '[' || c == '{'; };
  if (std::size_t(std::count_if(text.begin(), text.end(), opens)) > kMostValues) refuse_values(path);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    Builder document;
    if (!parser.HandleNextDocument(document)) return nullptr;
    Builder second;
    if (parser.HandleNextDocument(second))
      throw InputError(path, "more than one document (---)", "a file of one scene");
    return document.take();
  } catch (const YAML::Exception& e) {
    throw InputError(path + ":" + std::to_string(e.mark.line + 1), plain_text(e.msg), "valid YAML");
  }
}

Json read_scene_fields(const std::string& path) { return scene_fields(read_scene_text(path), path); }

const Fields<scenes::Scene>& scene_file_fields() {
  const auto of_scans = [](const char* name) {
    return Json{{"$ref", std::string("scan.schema.json#/properties/") + name}};
  };
  static const Fields<scenes::Scene> fields =
      Fields<scenes::Scene>("scene")
          .special("name", {{"type", "string"}}, {}, "What reports call it.", absent("the file's name"))
          .special("lidars", of_scans("lidars"), {}, "Sensors on the agent, for `vericone scan`.")
          .special("pose_error", of_scans("pose_error"), {},
                   "How well the poses of all LiDARs but the first are known. The scans are then fused by "
                   "ICP.");
  return fields;
}

Scene scene_of(const Json& given, const std::string& path) {
  require_kind(given, FileKind::scene, path);
  Json kept;
  const Json& fields = localized(given, kept);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Scene scene = read_engagement(fields, Velocities::optional, scene_file_fields().names(), folder);
  scene.agent.fields = remembered_fields(fields["agent"], "agent", folder);
  scene.obstacle.fields = remembered_fields(fields["obstacle"], "obstacle", folder);
  return scene;
}

}  // namespace vericone::input
