// SPDX-License-Identifier: BSD-3-Clause
//
// LAS 1.0 to 1.4. An own reader of the coordinates, which stand at the start of every kind of record: Debian
// 12 has neither libLAS nor PDAL nor LASzip.
#include <algorithm>
#include <array>
#include <cmath>

#include <vericone/geometry/error.h>

#include "../binary.h"
#include "../source.h"
#include "las_header.h"

namespace vericone::files {
namespace {

/// Fewest bytes of a record, by point format.
constexpr std::array<std::size_t, 11> kRecordSize = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// Places in the header.
constexpr std::size_t kMajor = 24, kMinor = 25, kHeaderSize = 94, kOffsetToPoints = 96, kFormat = 104,
                      kRecordLength = 105, kLegacyCount = 107, kScale = 131, kOffset = 155, kPointCount = 247;

LasHeader read_las_header(const Source& source) {
  const std::string& bytes = source.bytes;
  const char* head = bytes.data();
  const auto need = [&](std::size_t size) {
    if (bytes.size() < size)
      source.refuse("end of file inside the header, after " + std::to_string(bytes.size()) + " bytes",
                    "a LAS file, whose header takes " + std::to_string(size) + " bytes");
  };
  need(227);
  LasHeader h;
  const int major = std::uint8_t(head[kMajor]);
  h.minor = std::uint8_t(head[kMinor]);
  if (major != 1 || h.minor > 4)
    source.refuse("LAS version " + std::to_string(major) + "." + std::to_string(h.minor),
                  "version 1.0 to 1.4");
  const std::size_t size = h.minor >= 4 ? 375 : h.minor == 3 ? 235 : 227;
  need(size);
  h.header_size = little_endian<std::uint16_t>(head + kHeaderSize);
  h.points_at = little_endian<std::uint32_t>(head + kOffsetToPoints);
  if (h.header_size < size || h.points_at < h.header_size || h.points_at > bytes.size())
    source.refuse("a header of " + std::to_string(h.header_size) + " bytes and points from byte " +
                      std::to_string(h.points_at),
                  "at least " + std::to_string(size) + " bytes of header and points after it in the " +
                      std::to_string(bytes.size()) + " bytes of the file");

  // LASzip marks a compressed file in the upper bits of the format.
  h.is_compressed = (std::uint8_t(head[kFormat]) & 0xc0U) != 0;
  const std::uint8_t format = std::uint8_t(head[kFormat]) & 0x3fU;
  if (format >= kRecordSize.size()) source.refuse("point format " + std::to_string(format), "0 to 10");
  h.point_format = format;
  h.record = little_endian<std::uint16_t>(head + kRecordLength);
  if (h.record < kRecordSize[format])
    source.refuse("records of " + std::to_string(h.record) + " bytes",
                  "at least " + std::to_string(kRecordSize[format]) + " bytes, for point format " +
                      std::to_string(format));

  h.count = little_endian<std::uint32_t>(head + kLegacyCount);
  if (h.minor >= 4) {
    const auto count = little_endian<std::uint64_t>(head + kPointCount);
    if (h.count != 0 && count != h.count)
      source.refuse("two numbers of points, " + std::to_string(h.count) + " and " + std::to_string(count),
                    "one number, or zero in the place of versions before 1.4");
    h.count = count;
  }
  if (h.is_compressed) {
    // Points take some bytes each; what is all alike, less.
    constexpr std::uint64_t kMostPerByte = 16;
    if (h.count > (bytes.size() - h.points_at) * kMostPerByte)
      source.refuse("a header with " + std::to_string(h.count) + " compressed points",
                    "at most " + std::to_string(kMostPerByte) + " for each of the " +
                        std::to_string(bytes.size() - h.points_at) + " bytes after the header");
  } else if (h.count > (bytes.size() - h.points_at) / h.record) {
    source.refuse(
        "a header with " + std::to_string(h.count) + " points of " + std::to_string(h.record) + " bytes",
        "a count that the " + std::to_string(bytes.size() - h.points_at) +
            " bytes after the header can hold");
  }

  for (int i = 0; i < 3; ++i) {
    h.scale(i) = little_endian<double>(head + kScale + 8 * std::size_t(i));
    h.offset(i) = little_endian<double>(head + kOffset + 8 * std::size_t(i));
    if (!std::isfinite(h.scale(i)) || h.scale(i) == 0 || !std::isfinite(h.offset(i)))
      source.refuse("scale " + to_text(h.scale(i)) + " and offset " + to_text(h.offset(i)) +
                        " of coordinate " + std::to_string(i),
                    "finite numbers, the scale not zero");
  }
  return h;
}

}  // namespace

Eigen::Vector3d LasHeader::place(std::int32_t x, std::int32_t y, std::int32_t z) const {
  return {std::fma(double(x), scale(0), offset(0)), std::fma(double(y), scale(1), offset(1)),
          std::fma(double(z), scale(2), offset(2))};
}

bool looks_like_las(std::string_view bytes) { return bytes.starts_with("LASF"); }

Parsed parse_las(const Source& source) {
  if (!looks_like_las(source.bytes))
    source.refuse(in_quotes(std::string_view(source.bytes).substr(0, 4)), "LASF at the start of a LAS file");
  const LasHeader h = read_las_header(source);
  Parsed parsed{.format = (h.is_compressed ? "LAZ 1." : "LAS 1.") + std::to_string(h.minor)};
  if (h.is_compressed) {
    append_laz(source, h, parsed.points);
    return parsed;
  }
  parsed.points.resize(h.count);
  const char* at = source.bytes.data() + h.points_at;
  std::size_t read = 0;
  for (Eigen::Vector3d& p : parsed.points) {
    if (++read % 4096 == 0) checkpoint();
    p = h.place(little_endian<std::int32_t>(at), little_endian<std::int32_t>(at + 4),
                little_endian<std::int32_t>(at + 8));
    at += h.record;
  }
  return parsed;
}

}  // namespace vericone::files
