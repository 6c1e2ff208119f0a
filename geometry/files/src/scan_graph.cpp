// SPDX-License-Identifier: BSD-3-Clause
//
// Scan graphs of OctoMap: scans, each with the pose that it was taken from. An own reader: OctoMap 1.9.7
// rounds the doubles of the file to floats, believes its counts, leaks what it has when the file ends early,
// and drops the last line of a text that does not end in a newline.
#include <Eigen/Geometry>
#include <cmath>

#include <vericone/geometry/error.h>

#include "binary.h"
#include "source.h"
#include "text.h"

namespace vericone::files {
namespace {

/// A vector or quaternion is its dimension (int32) and as many doubles.
constexpr std::size_t kVector = 28, kQuaternion = 36, kPose = kVector + kQuaternion;
/// Two scans, the pose between them, a weight.
constexpr std::size_t kEdge = 8 + kPose + 8;

class BinaryReader {
 public:
  explicit BinaryReader(const Source& source) : source_(source), rest_(source.bytes) {}

  Parsed read() {
    Parsed parsed{.format = "scan graph"};
    for (std::uint64_t n = count("scans", 4 + kPose + 4); n > 0; --n) {
      const std::size_t first = parsed.points.size();
      const std::size_t size = count("points of a scan", kVector);
      parsed.points.reserve(first + size);
      for (std::size_t i = 0; i < size; ++i) parsed.points.push_back(vector<3>());
      need(kPose + 4);
      const Eigen::Vector3d position = vector<3>();
      const Eigen::Vector4d q = vector<4>();
      take<std::uint32_t>();  // the number by which edges name the scan
      if (!position.allFinite() || !(std::abs(q.norm() - 1) < 1e-3))
        source_.refuse("a pose whose quaternion has length " + to_text(q.norm()),
                       "a finite place and a unit quaternion");
      const Eigen::Matrix3d r = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
      for (std::size_t i = first; i < parsed.points.size(); ++i)
        parsed.points[i] = r * parsed.points[i] + position;
    }
    const std::size_t edges = count("edges", kEdge);
    rest_.remove_prefix(edges * kEdge);
    if (!rest_.empty())
      source_.refuse(std::to_string(rest_.size()) + " bytes after the edges", "the end of the file");
    return parsed;
  }

 private:
  void need(std::size_t size) const {
    if (rest_.size() < size)
      source_.refuse("end of file inside the data", "a scan graph with all that its counts claim");
  }

  template <typename T>
  T take() {
    const T x = little_endian<T>(rest_.data());
    rest_.remove_prefix(sizeof(T));
    return x;
  }

  /// A count of things that take `least` bytes each.
  std::size_t count(const char* what, std::size_t least) {
    need(4);
    const std::size_t n = take<std::uint32_t>();
    if (n > rest_.size() / least)
      source_.refuse(std::to_string(n) + " " + what,
                     "a number that the " + std::to_string(rest_.size()) + " bytes left can hold");
    return n;
  }

  template <int D>
  Eigen::Matrix<double, D, 1> vector() {
    if (take<std::int32_t>() != D)
      source_.refuse(
          "a vector of another dimension at byte " + std::to_string(source_.bytes.size() - rest_.size() - 4),
          "points of dimension 3 and quaternions of dimension 4");
    Eigen::Matrix<double, D, 1> v;
    for (double& x : v) x = take<double>();
    return v;
  }

  const Source& source_;
  std::string_view rest_;
};

template <int N>
Eigen::Matrix<double, N, 1> read_numbers(const Source& source, const Lines& lines, Words& words) {
  Eigen::Matrix<double, N, 1> v;
  for (double& x : v) x = lines.number(words.next());
  if (!words.next().empty())
    source.refuse(lines.where() + ": " + in_quotes(lines.text()),
                  N == 3 ? "x y z" : "NODE x y z roll pitch yaw");
  return v;
}

/// "NODE x y z roll pitch yaw", then the points of that scan; and so on.
Parsed parse_text(const Source& source) {
  Parsed parsed{.format = "scan graph text"};
  Lines lines(source);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  while (lines.next()) {
    Words words(lines.text());
    if (Words(lines.text()).next() == "NODE") {
      words.next();
      const auto v = read_numbers<6>(source, lines, words);
      if (!v.allFinite())
        source.refuse(lines.where() + ": " + in_quotes(lines.text()), "a pose of finite numbers");
      using Axis = Eigen::AngleAxisd;
      pose = Eigen::Translation3d(v.head<3>()) * Axis(v(5), Eigen::Vector3d::UnitZ()) *
             Axis(v(4), Eigen::Vector3d::UnitY()) * Axis(v(3), Eigen::Vector3d::UnitX());
    } else {
      parsed.points.push_back(pose * read_numbers<3>(source, lines, words));
    }
  }
  return parsed;
}

}  // namespace

bool looks_like_scan_graph(std::string_view bytes) {
  const Source head{"", std::string(bytes.substr(0, 4096))};
  Lines lines(head);
  return lines.next() && Words(lines.text()).next() == "NODE";
}

Parsed parse_scan_graph(const Source& source) {
  return looks_like_scan_graph(source.bytes) ? parse_text(source) : BinaryReader(source).read();
}

}  // namespace vericone::files
