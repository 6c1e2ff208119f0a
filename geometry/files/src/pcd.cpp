// SPDX-License-Identifier: BSD-3-Clause
//
// PCD, ascii, binary and binary_compressed. An own reader, with liblzf for the compression: PCL, whose format
// it is, needs 225 MB of packages.
#include <lzf.h>
#include <vericone/geometry/error.h>

#include <limits>

#include "binary.h"
#include "pcd_header.h"
#include "text.h"

namespace vericone::files {
namespace {

double value(const char* at, const PcdField& field) {
  switch (field.type) {
    case 'F':
      return field.size == 4 ? double(little_endian<float>(at)) : little_endian<double>(at);
    case 'I':
      return field.size == 1   ? double(little_endian<std::int8_t>(at))
             : field.size == 2 ? double(little_endian<std::int16_t>(at))
             : field.size == 4 ? double(little_endian<std::int32_t>(at))
                               : double(little_endian<std::int64_t>(at));
    default:
      return field.size == 1   ? double(little_endian<std::uint8_t>(at))
             : field.size == 2 ? double(little_endian<std::uint16_t>(at))
             : field.size == 4 ? double(little_endian<std::uint32_t>(at))
                               : double(little_endian<std::uint64_t>(at));
  }
}

/// Writers that map the file into memory leave zeros up to the end of a page.
std::size_t trailing_bytes(std::string_view rest) {
  return rest.find_first_not_of('\0') == std::string_view::npos ? 0 : rest.size();
}

void read_ascii(const Source& source, const PcdHeader& header, Parsed& parsed) {
  // Two bytes are the least that a value takes, and three coordinates are the least that a point has.
  const std::size_t left = source.bytes.size() - header.size;
  if (header.points > (left + 1) / 6)
    source.refuse("a header with " + std::to_string(header.points) + " points",
                  "a count that the " + std::to_string(left) + " bytes after it can hold");
  std::size_t values = 0;
  std::array<std::size_t, 3> columns{};
  for (std::size_t f = 0; f < header.fields.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i)
      if (header.coordinates[i] == f) columns[i] = values;
    values += header.fields[f].count;
  }
  parsed.points.reserve(header.points);
  Lines lines(source, header.size, header.lines);
  for (std::size_t n = 0; n < header.points; ++n) {
    if (!lines.next())
      source.refuse("end of file after " + std::to_string(n) + " points",
                    "a file with the " + std::to_string(header.points) + " points that its header claims");
    Words words(lines.text());
    Eigen::Vector3d p;
    std::size_t k = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++k)
      for (std::size_t i = 0; i < 3; ++i)
        if (columns[i] == k) p(Eigen::Index(i)) = lines.number(word);
    if (k != values)
      source.refuse(lines.where() + ": " + std::to_string(k) + " values",
                    std::to_string(values) + " values, as its header claims");
    parsed.points.push_back(p);
  }
  if (lines.next())
    source.refuse(lines.where() + ": " + in_quotes(lines.text()),
                  "the end of the file, after " + std::to_string(header.points) + " points");
}

/// Point after point.
void read_binary(const Source& source, const PcdHeader& header, Parsed& parsed) {
  std::array<std::size_t, 3> offset{};
  std::size_t stride = 0;
  for (std::size_t f = 0; f < header.fields.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i)
      if (header.coordinates[i] == f) offset[i] = stride;
    stride += header.fields[f].size * header.fields[f].count;
  }
  // There are x, y and z at least, so the stride is not zero.
  const std::string_view body = std::string_view(source.bytes).substr(header.size);
  if (stride == 0 || header.points > body.size() / stride)
    source.refuse(
        "a header with " + std::to_string(header.points) + " points of " + std::to_string(stride) + " bytes",
        "a count that the " + std::to_string(body.size()) + " bytes after it can hold");
  parsed.trailing_bytes = trailing_bytes(body.substr(header.points * stride));
  parsed.points.resize(header.points);
  const char* at = body.data();
  std::size_t read = 0;
  for (Eigen::Vector3d& p : parsed.points) {
    if (++read % 4096 == 0) checkpoint();
    for (std::size_t i = 0; i < 3; ++i)
      p(Eigen::Index(i)) = value(at + offset[i], header.fields[header.coordinates[i]]);
    at += stride;
  }
}

/// Field after field: of each, the values of all points; all that compressed.
void read_compressed(const Source& source, const PcdHeader& header, Parsed& parsed) {
  std::string_view body = std::string_view(source.bytes).substr(header.size);
  if (body.size() < 8) source.refuse("end of file after the header", "the sizes of the compressed data");
  const std::size_t packed = little_endian<std::uint32_t>(body.data()),
                    size = little_endian<std::uint32_t>(body.data() + 4), stride = header.stride();
  body.remove_prefix(8);
  if (packed > body.size())
    source.refuse(std::to_string(packed) + " bytes of compressed data",
                  "no more than the " + std::to_string(body.size()) + " bytes left");
  if (size / stride != header.points || size % stride != 0)
    source.refuse(
        std::to_string(size) + " bytes of data",
        "the size of " + std::to_string(header.points) + " points of " + std::to_string(stride) + " bytes");
  // The densest code of LZF makes 264 bytes of three.
  if (size / 88 > packed)
    source.refuse(std::to_string(packed) + " bytes of compressed data",
                  "more, to hold the " + std::to_string(size) + " bytes that are claimed");
  parsed.trailing_bytes = trailing_bytes(body.substr(packed));
  std::string data(size, '\0');
  if (size > 0 && lzf_decompress(body.data(), static_cast<unsigned>(packed), data.data(),
                                 static_cast<unsigned>(size)) != size)
    source.refuse("compressed data that does not unfold",
                  "LZF data of " + std::to_string(size) + " bytes, as claimed");
  parsed.points.resize(header.points);
  std::size_t at = 0;
  for (std::size_t f = 0; f < header.fields.size(); ++f) {
    const PcdField& field = header.fields[f];
    for (std::size_t i = 0; i < 3; ++i)
      if (header.coordinates[i] == f)
        for (std::size_t n = 0; n < header.points; ++n)
          parsed.points[n](Eigen::Index(i)) = value(data.data() + at + n * field.size, field);
    at += header.points * field.size * field.count;
  }
}

}  // namespace

bool looks_like_pcd(std::string_view bytes) { return bytes.starts_with("# .PCD"); }

Parsed parse_pcd(const Source& source) {
  const PcdHeader header = read_pcd_header(source);
  Parsed parsed;
  if (header.height > 1) {
    parsed.width = header.width;
    parsed.height = header.height;
  }
  switch (header.data) {
    case PcdHeader::Data::ascii:
      parsed.format = "PCD ascii";
      read_ascii(source, header, parsed);
      break;
    case PcdHeader::Data::binary:
      parsed.format = "PCD binary";
      read_binary(source, header, parsed);
      break;
    case PcdHeader::Data::binary_compressed:
      parsed.format = "PCD binary_compressed";
      read_compressed(source, header, parsed);
      break;
  }
  return parsed;
}

}  // namespace vericone::files
