// SPDX-License-Identifier: BSD-3-Clause
#include "glb/glb_file.h"

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace vericone::glb {
namespace {

// Numbers of the specification (glTF 2.0, 3.6 and 5).
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;
constexpr int kPoints = 0, kLineStrip = 3, kTriangles = 4;

float as_float(double x) {
  const float rounded = static_cast<float>(x);
  if (!std::isfinite(rounded))
    throw InputError("--glb", to_text(x), "asked for where coordinates are below 3.4e38 m");
  return rounded;
}

void append_vector(std::vector<float>& to, const Eigen::Vector3d& x) {
  for (int k = 0; k < 3; ++k) to.push_back(as_float(x(k)));
}

Eigen::Vector4f quaternion_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  return q.coeffs().cast<float>().normalized();  // x, y, z, w, as glTF has them
}

Json json_of(std::span<const float> numbers) {
  Json list = Json::array();
  for (const float x : numbers) list.push_back(double(x));
  return list;
}

void append_number(std::string& text, std::uint32_t number) {  // little endian
  for (int k = 0; k < 4; ++k) text += static_cast<char>(number >> (8 * k) & 0xff);
}

void append_chunk(std::string& file, const char* kind, std::string content, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  append_number(file, static_cast<std::uint32_t>(content.size()));
  file.append(kind, 4).append(content);
}

}  // namespace

Color color_of(std::size_t i) {
  // Of Okabe and Ito, told apart by nearly everybody, as linear light.
  constexpr std::array<Color, 8> kColors{Color{0.00, 0.168, 0.445},  Color{0.665, 0.112, 0.000},
                                         Color{0.000, 0.342, 0.171}, Color{0.791, 0.347, 0.00},
                                         Color{0.604, 0.191, 0.386}, Color{0.093, 0.456, 0.815},
                                         Color{0.871, 0.776, 0.05},  Color{0.10, 0.10, 0.10}};
  return kColors[i % kColors.size()];
}

GlbFile::GlbFile(Json extras) : extras_(std::move(extras)) {
  // z up becomes glTF's y up: a quarter turn about x.
  nodes_.push_back({{"name", "world, z up"},
                    {"rotation", json_of(std::array{-std::sqrt(0.5F), 0.F, 0.F, std::sqrt(0.5F)})},
                    {"children", Json::array()}});
}

int GlbFile::view(const void* from, std::size_t size, int target) {
  Json one{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
  if (target > 0) one["target"] = target;
  views_.push_back(std::move(one));
  buffer_.append(static_cast<const char*>(from), size);  // of machines with the low byte first, as glTF
  return static_cast<int>(views_.size()) - 1;
}

int GlbFile::floats(const std::vector<float>& numbers, int width, bool bounds, int target) {
  const auto columns = std::size_t(width);
  Json one{{"bufferView", view(numbers.data(), numbers.size() * sizeof(float), target)},
           {"componentType", kFloat},
           {"count", numbers.size() / columns},
           {"type", width == 1 ? "SCALAR" : "VEC" + std::to_string(width)}};
  if (bounds) {
    std::vector<float> least(columns, std::numeric_limits<float>::max()), most(columns, -least[0]);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      least[i % columns] = std::min(least[i % columns], numbers[i]);
      most[i % columns] = std::max(most[i % columns], numbers[i]);
    }
    one["min"] = json_of(least);
    one["max"] = json_of(most);
  }
  accessors_.push_back(std::move(one));
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbFile::indices(const Drawn& drawn) {
  const std::size_t count = 3 * drawn.triangles.size();
  const int in = view(drawn.triangles.data(), count * sizeof(std::uint32_t), kIndices);
  accessors_.push_back(
      {{"bufferView", in}, {"componentType", kUnsignedInt}, {"count", count}, {"type", "SCALAR"}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbFile::mesh(const std::string& name, const Drawn& drawn, const Color& color) {
  std::vector<float> numbers;
  for (const Eigen::Vector3d& x : drawn.points) append_vector(numbers, x);
  Json primitive{{"attributes", {{"POSITION", floats(numbers, 3, true, kVertices)}}},
                 {"material", materials_.size()},
                 {"mode", drawn.line ? kLineStrip : kPoints}};
  if (!drawn.triangles.empty()) {
    primitive["indices"] = indices(drawn);
    primitive["mode"] = kTriangles;
  }
  Json material{{"name", name},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {color.red, color.green, color.blue, color.alpha}},
                  {"metallicFactor", 0},
                  {"roughnessFactor", 0.8}}},
                {"doubleSided", true}};
  if (color.alpha < 1) material["alphaMode"] = "BLEND";
  materials_.push_back(std::move(material));
  meshes_.push_back({{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
  return static_cast<int>(meshes_.size()) - 1;
}

int GlbFile::node(const std::string& name, int mesh, const Pose& pose, const Json& extras) {
  std::vector<float> place;
  append_vector(place, pose.position);
  const Eigen::Vector4f turn = quaternion_of(pose.rotation);
  Json one{{"name", name},
           {"mesh", mesh},
           {"translation", json_of(place)},
           {"rotation", json_of({turn.data(), 4})}};
  if (!extras.is_null()) one["extras"] = extras;
  nodes_[0]["children"].push_back(nodes_.size());
  nodes_.push_back(std::move(one));
  return static_cast<int>(nodes_.size()) - 1;
}

void GlbFile::animate(int node, const std::vector<double>& times, const std::vector<Pose>& poses) {
  std::vector<float> at, places, turns;
  Eigen::Vector4f before = Eigen::Vector4f::Zero();
  for (std::size_t i = 0; i < times.size(); ++i) {
    const float t = as_float(times[i]);
    if (!at.empty() && t <= at.back()) continue;
    at.push_back(t);
    append_vector(places, poses[i].position);
    Eigen::Vector4f turn = quaternion_of(poses[i].rotation);
    if (turn.dot(before) < 0) turn = -turn;  // the shorter way
    turns.insert(turns.end(), turn.data(), turn.data() + 4);
    before = turn;
  }
  const int input = floats(at, 1, true, 0);
  for (const auto& [path, output] : {std::pair("translation", floats(places, 3, false, 0)),
                                     std::pair("rotation", floats(turns, 4, false, 0))}) {
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
  }
}

std::string GlbFile::bytes() const {
  Json file{{"asset", {{"version", "2.0"}, {"generator", "vericone"}, {"extras", {{"vericone", extras_}}}}},
            {"scene", 0},
            {"scenes", Json::array({{{"name", "vericone"}, {"nodes", {0}}}})},
            {"nodes", nodes_},
            {"meshes", meshes_},
            {"materials", materials_},
            {"accessors", accessors_},
            {"bufferViews", views_},
            {"buffers", Json::array({{{"byteLength", buffer_.size()}}})}};
  if (!channels_.empty())
    file["animations"] = Json::array({{{"name", "run"}, {"samplers", samplers_}, {"channels", channels_}}});
  std::string content;
  append_chunk(content, "JSON", file.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
  append_chunk(content, "BIN", buffer_, '\0');
  std::string bytes = "glTF";
  append_number(bytes, 2);
  append_number(bytes, static_cast<std::uint32_t>(12 + content.size()));
  return bytes + content;
}

}  // namespace vericone::glb
