// SPDX-License-Identifier: BSD-3-Clause
#include "gltf_document.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "../binary.h"

namespace vericone::files {
namespace {

using nlohmann::json;

constexpr int kMostLevels = 64;
constexpr std::size_t kMostValues = 1'000'000;

/// Types of components, as glTF (and OpenGL) numbers them.
constexpr std::uint64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                        kUnsignedInt = 5125, kFloat = 5126;

std::size_t component_size(const GltfValue& type) {
  switch (type.whole()) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      type.refuse("5120 to 5123, 5125 or 5126");
  }
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string out;
  out.reserve(text.size() / 4 * 3);
  while (text.ends_with('=')) text.remove_suffix(1);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) return std::nullopt;
    bits = bits << 6 | std::uint32_t(value);
    if ((count += 6) >= 8) out += char(bits >> (count -= 8) & 0xff);
  }
  return out;
}

/// With %41 for A.
std::string unescaped(std::string_view text) {
  const auto digit = [](char c) {
    const char l = char(c | 32);
    return c >= '0' && c <= '9' ? c - '0' : l >= 'a' && l <= 'f' ? l - 'a' + 10 : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape =
        text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out += is_escape ? char(digit(text[i + 1]) * 16 + digit(text[i + 2])) : text[i];
    if (is_escape) i += 2;
  }
  return out;
}

}  // namespace

GltfValue GltfValue::operator[](const char* name) const {
  const json* member = nullptr;
  if (value_ && value_->is_object())
    if (const auto found = value_->find(name); found != value_->end()) member = &*found;
  return {*source_, member, where_.empty() ? name : where_ + "." + name};
}

GltfValue GltfValue::operator[](std::size_t i) const {
  const std::size_t count = size();
  GltfValue member(*source_, nullptr, where_ + "[" + std::to_string(i) + "]");
  if (i >= count)
    member.refuse("the number of one of the " + std::to_string(count) + ", counted from 0", "none");
  member.value_ = &(*value_)[i];
  return member;
}

std::size_t GltfValue::size() const {
  if (!value_) return 0;
  if (!value_->is_array()) refuse("an array");
  return value_->size();
}

std::uint64_t GltfValue::whole() const {
  if (!value_ || !value_->is_number_unsigned()) refuse("a whole number from 0");
  return value_->get<std::uint64_t>();
}

double GltfValue::number() const {
  if (!value_ || !value_->is_number()) refuse("a number");
  return value_->get<double>();
}

std::string GltfValue::text() const {
  if (!value_ || !value_->is_string()) refuse("text in quotation marks");
  return value_->get<std::string>();
}

bool GltfValue::flag() const {
  if (!value_) return false;
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

std::vector<double> GltfValue::numbers(std::size_t count) const {
  std::vector<double> all;
  if (!value_) return all;
  if (size() != count) refuse(std::to_string(count) + " numbers");
  for (std::size_t i = 0; i < count; ++i) all.push_back((*this)[i].number());
  return all;
}

void GltfValue::refuse(const std::string& requirement, const std::string& value) const {
  const std::string shown = !value.empty()        ? value
                            : !value_             ? "nothing"
                            : value_->is_object() ? "an object"
                            : value_->is_array()  ? std::to_string(value_->size()) + " values"
                            : value_->is_string() ? in_quotes(value_->get<std::string>())
                                                  : value_->dump();
  source_->refuse((where_.empty() ? "the outermost value" : where_) + ": " + shown, requirement);
}

GltfDocument::GltfDocument(const Source& source) : source_(source), size_(source.bytes.size()) {
  if (looks_like_glb(source.bytes))
    read_binary();
  else
    parse(source.bytes);
  const GltfValue asset = root()["asset"];
  if (!asset["version"].text().starts_with("2."))
    asset["version"].refuse("\"2.0\": of glTF 1.0 other programs make 2.0");
  const GltfValue all = root()["buffers"];
  for (std::size_t i = 0; i < all.size(); ++i) {
    buffers_.push_back(buffer(all[i], i));
    size_ += buffers_.back().size();
  }
}

/// A header of 12 bytes, a chunk of JSON and at most one of bytes.
void GltfDocument::read_binary() {
  is_binary_ = true;
  std::string_view bytes = source_.bytes;
  const auto number = [&](std::size_t at) { return little_endian<std::uint32_t>(bytes.data() + at); };
  if (bytes.size() < 20)
    source_.refuse(std::to_string(bytes.size()) + " bytes", "20 or more, as the header of a GLB file takes");
  if (number(4) != 2) source_.refuse("GLB of version " + std::to_string(number(4)), "version 2");
  const std::size_t length = number(8);
  if (length < 20 || length > bytes.size())
    source_.refuse("a header that says " + std::to_string(length) + " bytes",
                   "no more than the " + std::to_string(bytes.size()) + " bytes of the file, and 20 or more");
  trailing_ = bytes.size() - length;
  bytes = bytes.substr(0, length);
  constexpr std::uint32_t kJson = 0x4e4f534a, kBytes = 0x004e4942;
  std::string_view text;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = number(at);
    const std::uint32_t kind = number(at + 4);
    if (size > bytes.size() - at - 8)
      source_.refuse("a chunk of " + std::to_string(size) + " bytes",
                     "no more than the " + std::to_string(bytes.size() - at - 8) + " bytes left");
    const std::string_view data = bytes.substr(at + 8, size);
    if ((at == 12) != (kind == kJson))
      source_.refuse("a chunk of kind " + std::to_string(kind), "one of JSON, and that the first");
    if (kind == kJson) text = data;
    if (kind == kBytes && !has_chunk_) {
      chunk_ = data;
      has_chunk_ = true;
    }
    at += 8 + size;
  }
  parse(text);
}

void GltfDocument::parse(std::string_view text) {
  std::size_t values = 0;
  const auto count = [&](int depth, json::parse_event_t, const json&) {
    if (depth > kMostLevels) source_.refuse("more levels of JSON", "at most " + std::to_string(kMostLevels));
    if (++values % 4096 == 0) checkpoint();
    if (values > kMostValues)
      source_.refuse("more values of JSON",
                     "at most " + std::to_string(kMostValues) + ": points belong into a buffer");
    return true;
  };
  try {
    json_ = json::parse(text, count);
  } catch (const json::parse_error& e) {
    const std::size_t at = e.byte > 0 ? std::min(e.byte - 1, text.size()) : 0;
    source_.refuse("byte " + std::to_string(at) + " of the JSON: " +
                       (at < text.size() ? in_quotes(text.substr(at)) : std::string("its end")),
                   "JSON, as glTF is");
  } catch (const json::exception&) {
    source_.refuse("a number of the JSON that is too large", "numbers in the range of double");
  }
}

std::string GltfDocument::buffer(const GltfValue& one, std::size_t number) const {
  const GltfValue uri = one["uri"];
  const std::uint64_t length = one["byteLength"].whole();
  std::string bytes;
  if (!uri.there()) {
    if (number != 0 || !has_chunk_)
      uri.refuse("a file's name, data:...;base64,... or, of a GLB file's first buffer, its chunk of bytes");
    bytes = chunk_;
  } else if (const std::string text = uri.text(); text.starts_with("data:")) {
    const std::size_t comma = text.find(";base64,");
    std::optional<std::string> decoded;
    if (comma != std::string::npos) decoded = from_base64(std::string_view(text).substr(comma + 8));
    if (!decoded) uri.refuse("data:...;base64, and what is base 64");
    bytes = std::move(*decoded);
  } else {
    // Beside the file or in folders beside it: what is fetched, and what stands elsewhere, is not its own.
    const std::string name = unescaped(text);
    const auto within = std::filesystem::path(name).lexically_normal();
    if (name.empty() || name.find(':') != std::string::npos || name.find('\0') != std::string::npos ||
        within.is_absolute() || *within.begin() == "..")
      uri.refuse("a file in the same folder, or in folders of it");
    try {
      bytes = load(std::filesystem::path(source_.path).parent_path() / within).bytes;
    } catch (const InputError& e) {
      uri.refuse(e.requirement(), in_quotes(text) + ", " + e.value());
    }
  }
  if (length > bytes.size())
    one["byteLength"].refuse("no more than the " + std::to_string(bytes.size()) + " bytes that it has");
  return bytes;
}

std::string_view GltfDocument::view(const GltfValue& view_number, std::uint64_t offset, std::size_t count,
                                    std::size_t element, std::size_t& stride) const {
  const GltfValue view = root()["bufferViews"][view_number.whole()];
  const std::uint64_t number = view["buffer"].whole(), from = view["byteOffset"].whole_or(0),
                      length = view["byteLength"].whole();
  root()["buffers"][number];  // is there
  const std::string_view bytes = buffers_[number];
  if (from > bytes.size() || length > bytes.size() - from)
    view["byteLength"].refuse("no more than the buffer's " + std::to_string(bytes.size()) + " bytes after " +
                              std::to_string(from));
  stride = view["byteStride"].whole_or(element);
  if (stride < element || stride > 252) view["byteStride"].refuse(std::to_string(element) + " to 252");
  const std::uint64_t needed = count == 0 ? 0 : std::uint64_t(count - 1) * stride + element;
  if (count > bytes.size() || offset > length || needed > length - offset)
    view["byteLength"].refuse("enough for " + std::to_string(count) + " elements of " +
                              std::to_string(element) + " bytes, " + std::to_string(stride) +
                              " apart, from byte " + std::to_string(offset) + " of the view");
  return bytes.substr(from + offset, needed);
}

double GltfDocument::Elements::operator()(std::size_t element, std::size_t i) const {
  if (!at) return 0;
  const char* from = at + element * stride + i * component;
  const auto scaled = [&](double x, double most) { return normalized ? std::max(x / most, -1.0) : x; };
  switch (type) {
    case kByte:
      return scaled(little_endian<std::int8_t>(from), 127);
    case kUnsignedByte:
      return scaled(little_endian<std::uint8_t>(from), 255);
    case kShort:
      return scaled(little_endian<std::int16_t>(from), 32767);
    case kUnsignedShort:
      return scaled(little_endian<std::uint16_t>(from), 65535);
    case kUnsignedInt:
      return little_endian<std::uint32_t>(from);
    default:
      return little_endian<float>(from);
  }
}

GltfDocument::Elements GltfDocument::elements(const GltfValue& accessor, std::size_t components) const {
  if (accessor["type"].text() != (components == 3 ? "VEC3" : "SCALAR"))
    accessor["type"].refuse(components == 3 ? "\"VEC3\"" : "\"SCALAR\"");
  const GltfValue type = accessor["componentType"];
  Elements result{nullptr,
                  0,
                  component_size(type),
                  components,
                  accessor["count"].whole(),
                  type.whole(),
                  accessor["normalized"].flag()};
  const GltfValue view_number = accessor["bufferView"];
  if (view_number.there()) {
    result.at = view(view_number, accessor["byteOffset"].whole_or(0), result.count,
                     result.component * components, result.stride)
                    .data();
  } else if (!accessor["sparse"].there()) {
    accessor.refuse("an accessor with a bufferView, or sparse", "one of zeros");
  } else if (result.count > size_) {
    accessor["count"].refuse("no more than the file has bytes");
  }
  return result;
}

template <typename Replace>
void GltfDocument::replace_sparse(const GltfValue& accessor, const Elements& like,
                                  const Replace& replace) const {
  const GltfValue sparse = accessor["sparse"];
  if (!sparse.there()) return;
  const std::size_t count = sparse["count"].whole();
  const GltfValue where = sparse["indices"], what = sparse["values"];
  const GltfValue type = where["componentType"];
  Elements numbers{nullptr, 0, component_size(type), 1, count, type.whole(), false};
  numbers.at =
      view(where["bufferView"], where["byteOffset"].whole_or(0), count, numbers.component, numbers.stride)
          .data();
  Elements values = like;
  values.at = view(what["bufferView"], what["byteOffset"].whole_or(0), count,
                   like.component * like.components, values.stride)
                  .data();
  for (std::size_t i = 0; i < count; ++i) {
    const double at = numbers(i, 0);
    if (!(at >= 0 && at < double(like.count) && at == std::floor(at)))
      where.refuse("numbers of the accessor's " + std::to_string(like.count) + " elements", to_text(at));
    replace(std::size_t(at), values, i);
  }
}

std::vector<Eigen::Vector3d> GltfDocument::positions(std::size_t number) const {
  const GltfValue accessor = root()["accessors"][number];
  const Elements all = elements(accessor, 3);
  if (all.type == kUnsignedInt) accessor["componentType"].refuse("float (5126), or 5120 to 5123");
  const auto point = [](const Elements& from, std::size_t i) {
    return Eigen::Vector3d(from(i, 0), from(i, 1), from(i, 2));
  };
  std::vector<Eigen::Vector3d> points(all.count);
  for (std::size_t i = 0; i < all.count; ++i) {
    if (i % 4096 == 0) checkpoint();
    points[i] = point(all, i);
  }
  replace_sparse(accessor, all, [&](std::size_t at, const Elements& values, std::size_t i) {
    points[at] = point(values, i);
  });
  return points;
}

std::vector<std::uint32_t> GltfDocument::indices(std::size_t number) const {
  const GltfValue accessor = root()["accessors"][number];
  const Elements all = elements(accessor, 1);
  if (all.type != kUnsignedByte && all.type != kUnsignedShort && all.type != kUnsignedInt)
    accessor["componentType"].refuse("5121, 5123 or 5125, of numbers from 0");
  std::vector<std::uint32_t> indices(all.count);
  for (std::size_t i = 0; i < all.count; ++i) indices[i] = std::uint32_t(all(i, 0));
  replace_sparse(accessor, all, [&](std::size_t at, const Elements& values, std::size_t i) {
    indices[at] = std::uint32_t(values(i, 0));
  });
  return indices;
}

}  // namespace vericone::files
