// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds and meshes written byte by byte as the formats have them, for the tests of the readers.
#pragma once

#include <lzf.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "geometry/files/written_files.h"

namespace vericone::testing {

using Points = std::vector<Eigen::Vector3d>;

template <typename T>
std::string little(T x) {
  return bytes_of(x, std::endian::little);
}

/// Facets of three points each, in a row.
inline std::string to_stl_binary(const Points& corners, std::string title = "solid binary as well") {
  title.resize(80, ' ');
  std::string bytes = title + little(std::uint32_t(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    bytes += little(0.F) + little(0.F) + little(1.F);
    for (std::size_t k = i; k < i + 3; ++k)
      for (const double x : corners[k]) bytes += little(float(x));
    bytes += little(std::uint16_t{0xabcd});
  }
  return bytes;
}

/// A PCD header for fields of the given entries, such as "x y z", "4 4 4", "F F F", "1 1 1".
inline std::string pcd_header(const std::string& names, const std::string& sizes, const std::string& types,
                              const std::string& counts, std::size_t width, std::size_t height,
                              const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + names + "\nSIZE " + sizes +
         "\nTYPE " + types + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(width) + "\nHEIGHT " +
         std::to_string(height) + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(width * height) +
         "\nDATA " + data + "\n";
}

/// The body of a binary_compressed PCD file.
inline std::string pcd_compressed(const std::string& fields) {
  std::string packed(fields.size() + 1000, '\0');
  packed.resize(lzf_compress(fields.data(), unsigned(fields.size()), packed.data(), unsigned(packed.size())));
  return little(std::uint32_t(packed.size())) + little(std::uint32_t(fields.size())) + packed;
}

struct LasFile {
  int minor = 2, format = 0;
  Eigen::Vector3d scale{0.01, 0.01, 0.001}, offset{0, 0, 0};
  std::vector<Eigen::Vector3i> points;
  std::size_t bytes_more = 0;  // of each record

  static std::size_t record_size(int format) {
    constexpr std::array<std::size_t, 11> kSizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    return kSizes[std::size_t(format)];
  }
  static std::size_t header_size(int minor) { return minor == 4 ? 375 : minor == 3 ? 235 : 227; }

  std::string bytes() const {
    const std::size_t header = header_size(minor), record = record_size(format) + bytes_more, gap = 54;
    std::string s(header + gap, '\0');
    const auto put = [&](std::size_t at, const std::string& b) { s.replace(at, b.size(), b); };
    const bool is_old = format < 6;
    put(0, "LASF");
    put(24, {'\x01', char(minor)});
    put(94, little(std::uint16_t(header)));
    put(96, little(std::uint32_t(header + gap)));
    put(104, {char(format)});
    put(105, little(std::uint16_t(record)));
    if (is_old) put(107, little(std::uint32_t(points.size())));
    for (std::size_t i = 0; i < 3; ++i) {
      put(131 + 8 * i, little(scale(Eigen::Index(i))));
      put(155 + 8 * i, little(offset(Eigen::Index(i))));
    }
    if (minor == 4) put(247, little(std::uint64_t(points.size())));
    for (const auto& p : points) {
      std::string r;
      for (const int x : p) r += little(std::int32_t(x));
      r.resize(record, '\x55');
      s += r;
    }
    return s;
  }
};

inline std::string graph_vector(const std::vector<double>& v) {
  std::string s = little(std::int32_t(v.size()));
  for (const double x : v) s += little(x);
  return s;
}

struct Scan {
  Points points;
  std::vector<double> position, quaternion;  // w x y z
};

inline std::string to_scan_graph(const std::vector<Scan>& scans, int edges = 0) {
  std::string s = little(std::uint32_t(scans.size()));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    s += little(std::uint32_t(scans[i].points.size()));
    for (const auto& p : scans[i].points) s += graph_vector({p.x(), p.y(), p.z()});
    s += graph_vector(scans[i].position) + graph_vector(scans[i].quaternion) + little(std::uint32_t(i));
  }
  s += little(std::uint32_t(edges));
  for (int e = 0; e < edges; ++e)
    s += little(0U) + little(0U) + graph_vector({0, 0, 0}) + graph_vector({1, 0, 0, 0}) + little(1.0);
  return s;
}

}  // namespace vericone::testing
