// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/files/extensions.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

namespace vericone::files {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;
static_assert(std::endian::native == std::endian::little);

std::string at(const char* field, std::size_t i, std::size_t k) {
  return std::string(field) + "[" + std::to_string(i) + "][" + std::to_string(k) + "]";
}

template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// What the file holds, made as a whole.
class Content {
 public:
  Content(std::span<const Vector3d> points, std::span<const Triangle> triangles)
      : points_(points), triangles_(triangles) {}

  std::string of(const std::string& extension, const std::filesystem::path& path) {
    if (extension == ".ply") return ply();
    if (extension == ".obj") return obj();
    if (extension == ".off") return off();
    if (extension == ".stl") return stl();
    if (extension == ".pcd") return pcd();
    if (extension == ".xyz") return xyz();
    throw InputError("path", path.string(), "a name with .ply, .obj, .off, .stl, .pcd or .xyz");
  }

 private:
  /// Now and then in loops over points and triangles.
  void step() {
    if (++steps_ % 4096 == 0) checkpoint();
  }
  void require_cloud(const char* format) const {
    if (!triangles_.empty())
      throw InputError("triangles", std::to_string(triangles_.size()),
                       std::string("none: ") + format + " has points alone");
  }
  std::string counted(const char* what, std::size_t count, const char* end) const {
    return what + std::to_string(count) + end;
  }

  void add_points_as_text(const char* before) {
    for (const Vector3d& p : points_) {
      step();
      text_ += before;
      for (int k = 0; k < 3; ++k) text_.append(to_text(p(k))).append(k < 2 ? " " : "\n");
    }
  }
  void add_triangles_as_text(const char* before, std::uint32_t first) {
    for (const Triangle& t : triangles_) {
      step();
      text_ += before;
      for (const std::uint32_t i : t) text_.append(" ").append(std::to_string(i + std::uint64_t{first}));
      text_ += '\n';
    }
  }
  void add_points() {
    for (const Vector3d& p : points_) {
      step();
      for (int k = 0; k < 3; ++k) append(text_, p(k));
    }
  }

  std::string ply() {
    text_ = "ply\nformat binary_little_endian 1.0\n" + counted("element vertex ", points_.size(), "\n") +
            "property double x\nproperty double y\nproperty double z\n";
    if (!triangles_.empty())
      text_ += counted("element face ", triangles_.size(), "\nproperty list uchar uint vertex_indices\n");
    text_ += "end_header\n";
    add_points();
    for (const Triangle& t : triangles_) {
      step();
      append(text_, std::uint8_t{3});
      for (const std::uint32_t i : t) append(text_, i);
    }
    return std::move(text_);
  }

  std::string obj() {
    add_points_as_text("v ");
    add_triangles_as_text("f", 1);
    return std::move(text_);
  }

  std::string off() {
    text_ = "OFF\n" + std::to_string(points_.size()) + " " + counted("", triangles_.size(), " 0\n");
    add_points_as_text("");
    add_triangles_as_text("3", 0);
    return std::move(text_);
  }

  std::string stl() {
    if (triangles_.empty())
      throw InputError("triangles", "none", "one or more: .stl has no points of their own");
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (double(float(points_[i](k))) != points_[i](k))
          throw InputError(at("points", i, std::size_t(k)), to_text(points_[i](k)),
                           "a float: .stl would round it");
    text_.assign(80, ' ');
    append(text_, static_cast<std::uint32_t>(triangles_.size()));
    for (const Triangle& t : triangles_) {
      step();
      for (int k = 0; k < 3; ++k) append(text_, 0.0F);  // readers take the normal from the corners
      for (const std::uint32_t i : t)
        for (int k = 0; k < 3; ++k) append(text_, float(points_[i](k)));
      append(text_, std::uint16_t{0});
    }
    return std::move(text_);
  }

  std::string pcd() {
    require_cloud(".pcd");
    text_ = "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n" +
            counted("WIDTH ", points_.size(), "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n") +
            counted("POINTS ", points_.size(), "\nDATA binary\n");
    add_points();
    return std::move(text_);
  }

  std::string xyz() {
    require_cloud(".xyz");
    add_points_as_text("");
    return std::move(text_);
  }

  std::span<const Vector3d> points_;
  std::span<const Triangle> triangles_;
  std::string text_;
  std::size_t steps_ = 0;
};

void require_valid(std::span<const Vector3d> points, std::span<const Triangle> triangles) {
  if (points.empty()) throw InputError("points", "none", "one or more");
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(points[i](k)))
        throw InputError(at("points", i, std::size_t(k)), to_text(points[i](k)), "a finite number");
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles[i][k] >= points.size())
        throw InputError(at("triangles", i, k), std::to_string(triangles[i][k]),
                         "the index of one of the " + std::to_string(points.size()) + " points");
}

}  // namespace

std::filesystem::path partial_path(const std::filesystem::path& path) {
  static std::atomic<std::uint64_t> writers = 0;
  std::filesystem::path partial = path;
  partial += ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(++writers);
  return partial;
}

void write_points(const std::filesystem::path& path, std::span<const Vector3d> points,
                  std::span<const Triangle> triangles) {
  require_valid(points, triangles);
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string bytes = Content(points, triangles).of(extension, path);
  const std::filesystem::path partial = partial_path(path);
  errno = 0;
  std::ofstream out(partial, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  std::error_code failure;
  if (!out) failure = {errno ? errno : EIO, std::generic_category()};
  if (out) std::filesystem::rename(partial, path, failure);
  if (failure) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw std::system_error(failure, "could not write " + path.string());
  }
}

void write_points(const std::filesystem::path& path, std::span<const Vector3d> points) {
  write_points(path, points, {});
}

}  // namespace vericone::files
