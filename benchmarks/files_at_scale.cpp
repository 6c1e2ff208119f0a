// SPDX-License-Identifier: BSD-3-Clause
//
// files_at_scale [FOLDER]: writes files of 10 million points, facets or cells into FOLDER (0.5 GB at a time;
// the folder of temporary files by default), reads each in a process of its own, and prints the table of
// docs/reference/files.md.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vericone/files/files.h>
#ifdef VERICONE_HAS_OCTOMAP
#include <vericone/octomap/read_octree.h>
#endif

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::uint32_t kCount = 10'000'000;
/// Rows and columns of a grid on a sphere, whose facets are about as many.
constexpr std::uint32_t kGrid = 2236, kFacets = 2 * kGrid * kGrid;

class Writer {
 public:
  explicit Writer(const std::filesystem::path& path) : out_(path, std::ios::binary) {}

  void text(const std::string& s) { out_ << s; }
  template <typename... T>
  void put(T... x) {  // the machine is little-endian, like the files
    (out_.write(reinterpret_cast<const char*>(&x), sizeof x), ...);
  }
  float random() { return uniform_(engine_); }
  /// Point of the grid on the sphere.
  void grid_point(std::uint32_t i, std::uint32_t j) {
    const double a = 2 * M_PI * (j % kGrid) / kGrid, b = M_PI * (i + 0.5) / (kGrid + 1);
    put(float(std::sin(b) * std::cos(a)), float(std::sin(b) * std::sin(a)), float(std::cos(b)));
  }

 private:
  std::ofstream out_;
  std::mt19937_64 engine_{1};
  std::uniform_real_distribution<float> uniform_{-50, 50};
};

std::string vertex_header(std::size_t vertices) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n";
}

void write_ply(Writer& w) {
  w.text(vertex_header(kCount) + "end_header\n");
  for (std::uint32_t i = 0; i < 3 * kCount; ++i) w.put(w.random());
}

void write_ply_mesh(Writer& w) {
  w.text(vertex_header(std::size_t(kGrid + 1) * kGrid) + "element face " + std::to_string(kFacets) +
         "\nproperty list uchar int vertex_indices\nend_header\n");
  for (std::uint32_t i = 0; i <= kGrid; ++i)
    for (std::uint32_t j = 0; j < kGrid; ++j) w.grid_point(i, j);
  for (std::uint32_t i = 0; i < kGrid; ++i)
    for (std::uint32_t j = 0; j < kGrid; ++j) {
      const std::uint32_t a = i * kGrid + j, b = a + kGrid, d = i * kGrid + (j + 1) % kGrid, c = d + kGrid;
      w.put(std::uint8_t{3}, a, b, c, std::uint8_t{3}, a, c, d);
    }
}

void write_pcd(Writer& w, bool has_nan) {
  w.text(
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
      "4000\n"
      "HEIGHT 2500\nPOINTS 10000000\nDATA binary\n");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::uint32_t i = 0; i < kCount; ++i)
    has_nan&& i % 10 != 0 ? w.put(nan, nan, nan, 1.F) : w.put(w.random(), w.random(), w.random(), 1.F);
}

void write_kitti(Writer& w) {
  for (std::uint32_t i = 0; i < kCount; ++i) w.put(w.random(), w.random(), w.random(), 1.F);
}

void write_las(Writer& w) {
  std::string header(375, '\0');
  const auto put = [&](std::size_t at, auto x) { std::memcpy(&header[at], &x, sizeof x); };
  header.replace(0, 4, "LASF");
  header[24] = 1, header[25] = 4, header[104] = 6;
  put(94, std::uint16_t{375}), put(96, std::uint32_t{375}), put(105, std::uint16_t{30});
  put(247, std::uint64_t{kCount});
  for (std::size_t i = 0; i < 3; ++i) put(131 + 8 * i, 0.001), put(155 + 8 * i, 500000.0);
  w.text(header);
  const std::string rest(18, '\0');
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (int k = 0; k < 3; ++k) w.put(std::int32_t(1000 * w.random()));
    w.text(rest);
  }
}

void write_xyz(Writer& w) {
  for (std::uint32_t i = 0; i < kCount; ++i) {
    char line[64];
    const int length = std::snprintf(line, sizeof line, "%.4f %.4f %.4f\n", double(w.random()),
                                     double(w.random()), double(w.random()));
    w.text({line, std::size_t(length)});
  }
}

void write_stl_facets(Writer& w, std::uint32_t facets, const std::function<void(std::uint32_t)>& corners) {
  w.text(std::string(80, ' '));
  w.put(facets);
  for (std::uint32_t i = 0; i < facets; ++i) {
    w.put(0.F, 0.F, 0.F);
    corners(i);
    w.put(std::uint16_t{0});
  }
}

void write_stl(Writer& w) {
  write_stl_facets(w, kFacets, [&](std::uint32_t n) {
    const std::uint32_t i = n / 2 / kGrid, j = n / 2 % kGrid;
    w.grid_point(i, j);
    w.grid_point(i + 1, n % 2 ? j + 1 : j);
    w.grid_point(n % 2 ? i : i + 1, j + 1);
  });
}

void write_stl_soup(Writer& w) {
  write_stl_facets(w, kCount, [&](std::uint32_t) {
    for (int k = 0; k < 9; ++k) w.put(w.random());
  });
}

/// Three points of a line each.
void write_stl_flat(Writer& w) {
  write_stl_facets(w, kCount, [&](std::uint32_t n) {
    const float a = 0.125F * float(n % 3000), b = 0.125F * float(n / 3000);
    for (int k = 0; k < 3; ++k) w.put(a + 0.125F * float(k), b + 0.125F * float(k), a - b);
  });
}

/// Eight full levels under eight of one child each: 8^8 leaves, occupied and free by turns.
void write_octree(Writer& w) {
  std::uint64_t nodes = 9;
  for (std::uint64_t level = 1, power = 8; level <= 8; ++level, power *= 8) nodes += power;
  w.text("# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(nodes) + "\nres 0.05\ndata\n");
  for (int i = 0; i < 8; ++i) w.put(std::uint16_t{0xc000});
  const std::function<void(int)> level = [&](int depth) {
    w.put(std::uint16_t(depth == 1 ? 0x6699 : 0xffff));
    for (int i = 0; i < 8 && depth > 1; ++i) level(depth - 1);
  };
  level(8);
}

double cpu_seconds() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

struct Kind {
  std::string what, name;
  std::function<void(Writer&)> write;
};

/// One row of the table.
void read(const Kind& kind, const std::filesystem::path& path) {
  std::string content, mesh = "-";
  const double start = cpu_seconds();
  double seconds = 0;
#ifdef VERICONE_HAS_OCTOMAP
  if (path.extension() == ".bt") {
    const auto octree = vericone::octomap::read_octree(path);
    seconds = cpu_seconds() - start;
    content = std::to_string(octree.nodes) + " nodes";
    const auto boxes = vericone::octomap::obstacle_boxes(octree, {});
    char text[80];
    std::snprintf(text, sizeof text, "%zu boxes in %.1f s", boxes.size(), cpu_seconds() - start - seconds);
    mesh = text;
  } else
#endif
  {
    auto file = vericone::files::read_points(path);
    seconds = cpu_seconds() - start;
    content = std::to_string(file.points.size()) + " points";
    if (file.dropped_points > 0) content += ", " + std::to_string(file.dropped_points) + " dropped";
    if (!file.faces.empty()) {
      content += ", " + std::to_string(file.faces.size()) + " faces";
      const double before = cpu_seconds();
      const auto report = vericone::files::triangle_mesh(std::move(file)).report;
      char text[120];
      std::snprintf(text, sizeof text, "%.1f s; %zu without area, %zu edges, %zu of the border",
                    cpu_seconds() - before, report.degenerate_triangles, report.edges, report.boundary_edges);
      mesh = text;
    }
  }
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  std::printf("| %s | %.0f MB | %s | %.1f s | %s | %.0f MB |\n", kind.what.c_str(),
              double(std::filesystem::file_size(path)) / 1e6, content.c_str(), seconds, mesh.c_str(),
              1.024e-3 * double(use.ru_maxrss));
}

}  // namespace

int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : std::filesystem::temp_directory_path().string();
  std::vector<Kind> kinds = {
      {"PLY binary", "cloud.ply", write_ply},
      {"PCD binary", "cloud.pcd", [](Writer& w) { write_pcd(w, false); }},
      {"PCD binary, nine tenths NaN", "nan.pcd", [](Writer& w) { write_pcd(w, true); }},
      {"KITTI", "cloud.bin", write_kitti},
      {"LAS 1.4", "cloud.las", write_las},
      {"XYZ text", "cloud.xyz", write_xyz},
      {"PLY binary mesh", "mesh.ply", write_ply_mesh},
      {"STL binary", "mesh.stl", write_stl},
      {"STL binary, no common points", "soup.stl", write_stl_soup},
      {"STL binary, no area", "flat.stl", write_stl_flat},
  };
#ifdef VERICONE_HAS_OCTOMAP
  kinds.push_back({"octree .bt", "map.bt", write_octree});
#endif
  std::printf(
      "| file | size | content | read | mesh with report, or obstacles | peak memory |\n"
      "|---|---|---|---|---|---|\n");
  for (const Kind& kind : kinds) {
    const auto path = folder / ("vericone_" + std::to_string(::getpid()) + "_" + kind.name);
    {
      Writer writer(path);
      kind.write(writer);
    }
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      try {
        read(kind, path);
      } catch (const std::exception& e) {
        std::printf("| %s | - | %s | - | - | - |\n", kind.what.c_str(), e.what());
      }
      std::fflush(stdout);
      _exit(0);
    }
    int status = 0;
    if (child > 0) waitpid(child, &status, 0);
    std::filesystem::remove(path);
    if (child < 0 || status != 0) return 1;
  }
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
