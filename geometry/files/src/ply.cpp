// SPDX-License-Identifier: BSD-3-Clause
//
// PLY, ascii and binary. An own reader: OpenMesh 9.0 and assimp 5.2 read its doubles into floats, and what
// else Debian has (PCL, VTK, Open3D) is out of proportion.
#include "ply_header.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "text.h"

namespace vericone::files {
namespace {

/// The values of an ascii body, in order.
class AsciiValues {
 public:
  AsciiValues(const Source& source, std::string_view body) : source_(source), words_(body) {}

  double real(PlyType type) {
    const std::string_view word = words_.next();
    if (word.empty()) source_.refuse("end of file inside the data", "all the data that the header claims");
    const auto x = to_number(word);
    if (!x || (is_integer(type) && !(*x == std::floor(*x))))
      source_.refuse(in_quotes(word) + " " + position(),
                     is_integer(type) ? "an integer" : "a number in the range of double");
    return *x;
  }

  /// Fewest bytes that `count` values take: one digit each and what parts them.
  static std::size_t fewest_bytes(std::size_t, std::size_t count) { return 2 * count; }
  std::size_t bytes_left() const { return words_.rest().size() + 1; }

  /// No word may come after the data.
  std::size_t end() {
    const std::string_view word = words_.next();
    if (!word.empty())
      source_.refuse(in_quotes(word) + " " + position(), "the end of the file, by its header");
    return 0;
  }

 private:
  std::string position() const {
    const auto last = source_.bytes.begin() + std::ptrdiff_t(source_.bytes.size() - words_.rest().size());
    return "in line " + std::to_string(1 + std::count(source_.bytes.begin(), last, '\n'));
  }

  const Source& source_;
  Words words_;
};

/// The values of a binary body, in order.
template <std::endian kOrder>
class BinaryValues {
 public:
  BinaryValues(const Source& source, std::string_view body) : source_(source), rest_(body) {}

  double real(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }

  static std::size_t fewest_bytes(std::size_t size, std::size_t count) { return size * count; }
  std::size_t bytes_left() const { return rest_.size(); }

  /// How many bytes come after the data.
  std::size_t end() const { return rest_.size(); }

 private:
  template <typename T>
  T take() {
    std::array<char, sizeof(T)> raw;
    if (rest_.size() < raw.size())
      source_.refuse("end of file inside the data", "all the data that the header claims");
    std::memcpy(raw.data(), rest_.data(), raw.size());
    rest_.remove_prefix(raw.size());
    if constexpr (kOrder != std::endian::native) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

  const Source& source_;
  std::string_view rest_;
};

enum class Role { other, x, y, z, corners, strips };

Role role_of(const PlyElement& element, const PlyProperty& property) {
  const bool list = property.count_type.has_value();
  if (element.name == "vertex" && !list)
    return property.name == "x"   ? Role::x
           : property.name == "y" ? Role::y
           : property.name == "z" ? Role::z
                                  : Role::other;
  if (!list || (property.name != "vertex_indices" && property.name != "vertex_index")) return Role::other;
  return element.name == "face" ? Role::corners : element.name == "tristrips" ? Role::strips : Role::other;
}

/// A strip turns over every other triangle; -1 starts a new one.
void add_strip(const Source& source, const std::vector<std::int64_t>& strip, const std::string& where,
               Parsed& parsed) {
  std::size_t start = 0;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    if (strip[i] == -1) {
      start = i + 1;
    } else if (i >= start + 2) {
      std::vector<std::uint32_t> t = {to_index(source, strip[i - 2], where),
                                      to_index(source, strip[i - 1], where),
                                      to_index(source, strip[i], where)};
      if ((i - start) % 2) std::swap(t[0], t[1]);
      parsed.faces.push_back(std::move(t));
    }
  }
}

template <typename Values>
void read_element(const Source& source, const PlyElement& element, Values& values, Parsed& parsed) {
  std::vector<Role> roles;
  std::size_t fewest = 0;
  for (const PlyProperty& p : element.properties) {
    roles.push_back(role_of(element, p));
    fewest += Values::fewest_bytes(size_of(p.count_type.value_or(p.type)), 1);
    if ((roles.back() == Role::corners || roles.back() == Role::strips) && !is_integer(p.type))
      source.refuse("vertex indices of a floating-point type", "vertex indices of an integer type");
  }
  if (element.properties.empty()) return;
  if (element.count > values.bytes_left() / fewest)
    source.refuse("a header with " + std::to_string(element.count) + " of element " + in_quotes(element.name),
                  "a count that the " + std::to_string(values.bytes_left()) + " bytes left can hold");
  if (element.name == "vertex") {
    for (const Role role : {Role::x, Role::y, Role::z})
      if (std::ranges::count(roles, role) != 1)
        source.refuse("vertices without just one x, y and z", "vertices with properties x, y and z");
    parsed.points.reserve(element.count);
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (i % 4096 == 0) checkpoint();
    const auto where = [&] { return element.name + " " + std::to_string(i); };
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      if (!p.count_type) {
        const double value = values.real(p.type);
        if (roles[k] >= Role::x && roles[k] <= Role::z) point(int(roles[k]) - int(Role::x)) = value;
        continue;
      }
      const double length = values.real(*p.count_type);
      const std::size_t least = Values::fewest_bytes(size_of(p.type), 1);
      const std::size_t most = values.bytes_left() / least;
      if (!(length >= 0) || length > double(most))
        source.refuse(where() + ": a list of length " + to_text(length),
                      "a length that the " + std::to_string(values.bytes_left()) + " bytes left can hold");
      std::vector<std::int64_t> list(roles[k] == Role::other ? 0 : std::size_t(length));
      for (std::size_t n = 0; n < std::size_t(length); ++n) {
        const double value = values.real(p.type);
        if (roles[k] == Role::other) continue;
        if (!(std::abs(value) < 1e15))
          source.refuse(where() + ": vertex index out of range", "a vertex index");
        list[n] = std::int64_t(value);
      }
      if (roles[k] == Role::corners) {
        std::vector<std::uint32_t> face;
        face.reserve(list.size());
        for (const std::int64_t v : list) face.push_back(to_index(source, v, where()));
        parsed.faces.push_back(std::move(face));
      } else if (roles[k] == Role::strips) {
        add_strip(source, list, where(), parsed);
      }
    }
    if (element.name == "vertex") parsed.points.push_back(point);
  }
}

template <typename Values>
Parsed read_body(const Source& source, const PlyHeader& header, std::string format) {
  Parsed parsed{.format = std::move(format)};
  Values values(source, std::string_view(source.bytes).substr(header.size));
  for (const PlyElement& element : header.elements) read_element(source, element, values, parsed);
  parsed.trailing_bytes = values.end();
  return parsed;
}

}  // namespace

bool looks_like_ply(std::string_view bytes) {
  const std::string_view line = bytes.substr(0, bytes.find_first_of("\r\n"));
  return line.size() < bytes.size() && line.substr(0, line.find_last_not_of(" \t") + 1) == "ply";
}

Parsed parse_ply(const Source& source) {
  const PlyHeader header = read_ply_header(source);
  if (std::ranges::find(header.elements, "vertex", &PlyElement::name) == header.elements.end())
    source.refuse("a header without vertices", "a PLY file with an element vertex");
  switch (header.encoding) {
    case PlyHeader::Encoding::little_endian:
      return read_body<BinaryValues<std::endian::little>>(source, header, "PLY binary_little_endian");
    case PlyHeader::Encoding::big_endian:
      return read_body<BinaryValues<std::endian::big>>(source, header, "PLY binary_big_endian");
    case PlyHeader::Encoding::ascii:
      break;
  }
  return read_body<AsciiValues>(source, header, "PLY ascii");
}

}  // namespace vericone::files
