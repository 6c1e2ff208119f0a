// SPDX-License-Identifier: BSD-3-Clause
//
// Scans of surveyors: LAZ, compressed by an encoder of the tests' own and by other programs; PTX.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "geometry/files/refused_files.h"
#include "geometry/files/written_files.h"
#include "support/random.h"

namespace vericone::files::surveys_test {
namespace {

using Eigen::Vector3d;
using testing::BadFile, testing::bytes_of, testing::Random, testing::TemporaryDirectory;

template <typename T>
std::string little(T x) {
  return bytes_of(x, std::endian::little);
}

// An encoder, of what the decoder undoes.

struct Model {
  std::vector<std::uint32_t> counts;
  std::uint32_t total = 0, until, cycle;
  explicit Model(std::uint32_t n) : counts(n, 1), total(n), until((n + 6) / 2), cycle(until) {}

  std::uint32_t below(std::uint32_t symbol) const {
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < symbol; ++i) sum += shares[i];
    return scale * sum >> 16;
  }
  void add(std::uint32_t symbol) {
    ++counts[symbol];
    if (--until > 0) return;
    if ((total += cycle) > 32768) {
      total = 0;
      for (auto& count : counts) total += count = (count + 1) / 2;
    }
    shares = counts;
    scale = 0x80000000U / total;
    cycle = std::min(5 * cycle / 4, 8 * (std::uint32_t(counts.size()) + 6));
    until = cycle;
  }
  std::vector<std::uint32_t> shares = counts;  // as they were when last renewed
  std::uint32_t scale = 0x80000000U / total;
};

struct ModelOfBits {
  std::uint32_t zeros = 1, total = 2, share = 4096, cycle = 4, until = 4;
  void add(bool one) {
    zeros += !one;
    if (--until > 0) return;
    if ((total += cycle) > 8192) {
      total = (total + 1) / 2;
      zeros = (zeros + 1) / 2;
      total += zeros == total;
    }
    share = zeros * (0x80000000U / total) >> 18;
    until = cycle = std::min(5 * cycle / 4, 64U);
  }
};

/// The interval of all that was coded, as a number of so many bytes that grows at its end, and its length.
class Encoder {
 public:
  void symbol(Model& model, std::uint32_t x) {
    const std::uint32_t unit = length_ >> 15, low = model.below(x) * unit;
    const bool last = x + 1 == model.counts.size();
    take(low, (last ? length_ : model.below(x + 1) * unit) - low);
    model.add(x);
  }
  void bit(ModelOfBits& model, bool one) {
    const std::uint32_t zero = model.share * (length_ >> 13);
    one ? take(zero, length_ - zero) : take(0, zero);
    model.add(one);
  }
  void bits(std::uint32_t x, std::uint32_t count) {
    if (count > 19) {
      bits(x & 0xffff, 16);
      return bits(x >> 16, count - 16);
    }
    take(x * (length_ >> count), length_ >> count);
  }
  /// A number within the interval.
  std::string bytes() {
    take(length_ >> 1, length_ >> 9);
    return bytes_ + std::string(4, '\0');
  }

 private:
  void take(std::uint32_t low, std::uint32_t length) {
    low_ += low;
    length_ = length;
    for (; length_ < 1U << 24; length_ <<= 8) {
      if (low_ >> 32)  // one more
        for (std::size_t i = bytes_.size(); i-- > 0 && ++bytes_[i] == 0;) {
        }
      low_ &= 0xffffffffU;
      bytes_ += char(low_ >> 24);
      low_ = low_ << 8 & 0xffffffffU;
    }
    if (low_ >> 32) {
      for (std::size_t i = bytes_.size(); i-- > 0 && ++bytes_[i] == 0;) {
      }
      low_ &= 0xffffffffU;
    }
  }
  std::uint64_t low_ = 0;
  std::uint32_t length_ = 0xffffffffU;
  std::string bytes_;
};

struct Number {
  std::vector<Model> sizes, corrections;
  ModelOfBits one;
  std::uint32_t size = 0;
  Number(std::uint32_t bits, std::size_t contexts) : sizes(contexts, Model(bits + 1)) {
    for (std::uint32_t k = 1; k <= bits; ++k) corrections.emplace_back(1U << std::min(k, 8U));
  }
  void write(Encoder& to, std::int32_t prediction, std::int32_t x, std::size_t context) {
    const auto c = std::int64_t(std::int32_t(std::uint32_t(x) - std::uint32_t(prediction)));
    for (size = 0; size < 32 && !(c >= 1 - (1LL << size) && c <= 1LL << size);) ++size;
    to.symbol(sizes[context], size);
    if (size == 0) return to.bit(one, c == 1);
    if (size == 32) return;
    const auto code = std::uint32_t(c < 0 ? c + (1LL << size) - 1 : c - 1);
    to.symbol(corrections[size - 1], size > 8 ? code >> (size - 8) : code);
    if (size > 8) to.bits(code & ((1U << (size - 8)) - 1), size - 8);
  }
};

/// Five numbers, of which the middle one predicts the next.
struct Five {
  std::vector<std::int32_t> all = std::vector<std::int32_t>(5, 0);
  bool high = true;
  void add(std::int32_t x) {
    const std::int32_t middle = all[2];
    all.erase(high ? all.end() - 1 : all.begin());
    all.insert(std::upper_bound(all.begin(), all.end(), x), x);
    if (high ? x >= middle : x <= middle) high = !high;
  }
};

struct Cloud {
  std::vector<std::array<std::int32_t, 3>> places;
  std::vector<std::uint32_t> n, r, channel;
};

/// A walk with leaps; returns of pulses, and sometimes what no pulse has.
Cloud random_cloud(Random& random, int count, int most_returns, int channels) {
  Cloud cloud;
  std::array<std::int32_t, 3> at{100, -200, 300};
  for (int i = 0; i < count; ++i) {
    const int reach = random.integer(0, 20) == 0 ? 2'000'000'000 : random.integer(0, 3) == 0 ? 70'000 : 90;
    for (std::int32_t& x : at)
      x = std::int32_t(std::uint32_t(x) + std::uint32_t(random.integer(-reach, reach)));
    cloud.places.push_back(at);
    cloud.n.push_back(std::uint32_t(random.integer(0, 2) ? 1 : random.integer(0, most_returns)));
    cloud.r.push_back(std::uint32_t(random.integer(0, 2) ? 1 : random.integer(0, most_returns)));
    cloud.channel.push_back(std::uint32_t(random.integer(0, 3) ? 0 : random.integer(0, channels - 1)));
  }
  return cloud;
}

struct PlacesOut {
  Number x{32, 2}, y{32, 22}, z{32, 20};
  static std::size_t context(std::uint32_t size, std::uint32_t most, bool single) {
    return (size < most ? size / 2 * 2 : most) + single;
  }
  void write(Encoder& flat, Encoder& heights, Five& dx, Five& dy, std::int32_t& height, bool single,
             const std::array<std::int32_t, 3>& before, const std::array<std::int32_t, 3>& at) {
    const auto step = [&](std::size_t k) {
      return std::int32_t(std::uint32_t(at[k]) - std::uint32_t(before[k]));
    };
    x.write(flat, dx.all[2], step(0), single);
    dx.add(step(0));
    y.write(flat, dy.all[2], step(1), context(x.size, 20, single));
    dy.add(step(1));
    z.write(heights, height, at[2], context((x.size + y.size) / 2, 18, single));
    height = at[2];
  }
};

int apart(std::uint32_t n, std::uint32_t r) { return std::min(7, std::abs(int(n) - int(r))); }

/// A chunk of point format 2, with colours, and one byte more; `i` to `end` of the cloud.
std::string stream_chunk(const Cloud& cloud, std::size_t i, std::size_t end, Random& random) {
  // Which differences along x and y are alike, from the number of returns down and which it is across.
  const char* const kAlike[] = {"fedcba98", "e0136aa9", "d1247bba", "c3458ccb",
                                "b6789ddc", "aabcdeed", "9abcdefe", "89abcdef"};
  Encoder out;
  Model changed(64), used(128);
  std::vector<Model> returns(256, Model(256)), classes(256, Model(256)), users(256, Model(256)),
      angles(2, Model(256)), colours(6, Model(256)), extra(1, Model(256));
  Number intensity(16, 4), source(16, 1);
  PlacesOut places;
  std::array<Five, 16> dx, dy;
  std::array<std::int32_t, 8> heights{};
  std::uint32_t byte = cloud.r[i] | cloud.n[i] << 3, last_class = 7, last_user = 9;
  const std::string first = little(cloud.places[i][0]) + little(cloud.places[i][1]) +
                            little(cloud.places[i][2]) + little(std::uint16_t(5)) + char(byte) + '\7' + '\1' +
                            '\x9' + little(std::uint16_t(8)) + std::string(7, '\3');
  for (++i; i < end; ++i) {
    const std::uint32_t n = cloud.n[i], r = cloud.r[i], now = r | n << 3 | (random.integer(0, 1) ? 64U : 0U);
    const std::uint32_t others = std::uint32_t(random.integer(0, 31));
    out.symbol(changed, others | (now != byte ? 32U : 0U));
    if (now != byte) out.symbol(returns[byte], now);
    byte = now;
    const char alike = kAlike[n][r];
    const std::size_t m = std::size_t(alike >= 'a' ? alike - 'a' + 10 : alike - '0');
    if (others & 16) intensity.write(out, 0, random.integer(-3, 3), std::min<std::size_t>(m, 3));
    if (others & 8) {
      const auto x = std::uint32_t(random.integer(0, 255));
      out.symbol(classes[last_class], x);
      last_class = x;
    }
    if (others & 4) out.symbol(angles[byte >> 6 & 1], 3);
    if (others & 2) {
      const auto x = std::uint32_t(random.integer(0, 255));
      out.symbol(users[last_user], x);
      last_user = x;
    }
    if (others & 1) source.write(out, 0, random.integer(-300, 300), 0);
    places.write(out, out, dx[m], dy[m], heights[std::size_t(apart(n, r))], n == 1, cloud.places[i - 1],
                 cloud.places[i]);
    const auto bits = std::uint32_t(random.integer(0, 127));
    out.symbol(used, bits);
    for (const std::size_t k : {0U, 1U, 2U, 4U, 3U, 5U})
      if ((bits >> k & 1) && (k < 2 || (bits & 64))) out.symbol(colours[k], 200);
    out.symbol(extra[0], std::uint32_t(random.integer(0, 255)));
  }
  return first + out.bytes();
}

/// What is kept of one channel of a scanner.
struct ChannelOut {
  std::vector<Model> changed = std::vector<Model>(8, Model(128)), counts = std::vector<Model>(16, Model(16)),
                     which = std::vector<Model>(16, Model(16));
  Model channel{3}, same{13};
  PlacesOut places;
  std::array<Five, 12> dx, dy;
  std::array<std::int32_t, 8> heights{};
  std::array<std::int32_t, 3> at{};
  std::uint32_t n = 0, r = 0;
  bool time = false;
};

/// A chunk of point format 6, of the layers with coordinates; the others are empty.
std::string layered_chunk(const Cloud& cloud, std::size_t i, std::size_t end, Random& random) {
  // From 0 to 5 for each number of returns, down, and which it is, across.
  const char* const kAlike[] = {
      "0123453445555555", "1013333333333333", "2124444444433333", "3345444444444444",
      "4344544444444444", "5344454444444444", "3344445444444444", "4344444544444444",
      "4344444454444444", "5344444445444444", "5344444444544444", "5334444444455444",
      "5334444444455544", "5334444444445554", "5334444444444555", "5334444444444455"};
  Encoder flat, heights;
  std::array<std::unique_ptr<ChannelOut>, 4> channels;
  std::size_t now = cloud.channel[i];
  const auto begin = [&](std::size_t k, const std::array<std::int32_t, 3>& at, std::uint32_t n,
                         std::uint32_t r) {
    channels[k] = std::make_unique<ChannelOut>();
    channels[k]->at = at;
    channels[k]->n = n;
    channels[k]->r = r;
    channels[k]->heights.fill(at[2]);
  };
  begin(now, cloud.places[i], cloud.n[i], cloud.r[i]);
  std::string raw;
  for (const std::int32_t x : cloud.places[i]) raw += little(x);
  raw +=
      little(std::uint16_t(5)) + char(cloud.r[i] | cloud.n[i] << 4) + char(now << 4) + std::string(14, '\1');
  const std::size_t count = end - i;
  for (++i; i < end; ++i) {
    const ChannelOut& last = *channels[now];
    const std::size_t kind = (last.r == 1) + (last.r >= last.n ? 2U : 0U) + (last.time ? 4U : 0U);
    const std::size_t next = cloud.channel[i];
    const bool is_new = !channels[next];
    const ChannelOut& from = is_new ? last : *channels[next];
    const std::uint32_t n = cloud.n[i], r = cloud.r[i], step = (r - from.r) & 15;
    const bool time = random.integer(0, 1) == 1;
    const std::uint32_t change = step == 0 ? 0 : step == 1 ? 1 : step == 15 ? 2 : 3;
    flat.symbol(channels[now]->changed[kind], change | (n != from.n ? 4U : 0U) | (time ? 16U : 0U) |
                                                  (next != now ? 64U : 0U) |
                                                  (random.integer(0, 1) ? 40U : 0U));
    if (next != now) flat.symbol(channels[now]->channel, std::uint32_t(next - now - 1) & 3);
    if (is_new) begin(next, last.at, last.n, last.r);
    ChannelOut& c = *channels[now = next];
    if (n != c.n) flat.symbol(c.counts[c.n], n);
    if (change == 3) time ? flat.symbol(c.which[c.r], r) : flat.symbol(c.same, step - 2);
    c.n = n;
    c.r = r;
    c.time = time;
    const std::size_t m = std::size_t(kAlike[n][r] - '0') * 2 + time;
    c.places.write(flat, heights, c.dx[m], c.dy[m], c.heights[std::size_t(apart(n, r))], n == 1, c.at,
                   cloud.places[i]);
    c.at = cloud.places[i];
  }
  const std::string one = flat.bytes(), two = heights.bytes();
  raw += little(std::uint32_t(count)) + little(std::uint32_t(one.size())) +
         little(std::uint32_t(two.size())) + std::string(28, '\0');
  return raw + one + two;
}

struct LazOptions {
  bool layered = false, variable = false, table_at_end = false;
  std::size_t chunk = 100;
};

std::string laz_of(const Cloud& cloud, const LazOptions& options, Random& random) {
  std::vector<std::string> chunks;
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < cloud.places.size(); i += counts.back()) {
    const std::size_t wanted = options.variable ? std::size_t(random.integer(1, 60)) : options.chunk;
    counts.push_back(std::min(wanted, cloud.places.size() - i));
    chunks.push_back((options.layered ? layered_chunk : stream_chunk)(cloud, i, i + counts.back(), random));
  }
  Encoder table;
  Number numbers(32, 2);
  std::int32_t count = 0, size = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (options.variable) numbers.write(table, count, std::int32_t(counts[i]), 0);
    count = std::int32_t(counts[i]);
    numbers.write(table, size, std::int32_t(chunks[i].size()), 1);
    size = std::int32_t(chunks[i].size());
  }
  const auto part = [](int kind, int bytes, int version) {
    return little(std::uint16_t(kind)) + little(std::uint16_t(bytes)) + little(std::uint16_t(version));
  };
  const std::string parts =
      options.layered ? part(10, 30, 3) : part(6, 20, 2) + part(8, 6, 2) + part(0, 1, 2);
  std::string own = little(std::uint16_t(options.layered ? 3 : 2)) + std::string(10, '\0') +
                    little(options.variable ? 0xffffffffU : std::uint32_t(options.chunk)) +
                    std::string(16, '\xff') + little(std::uint16_t(parts.size() / 6)) + parts;
  own = std::string(2, '\0') + std::string("laszip encoded\0\0", 16) + little(std::uint16_t(22204)) +
        little(std::uint16_t(own.size())) + std::string(32, '\0') + own;
  std::string header(375, '\0');
  const auto put = [&](std::size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
  put(0, "LASF");
  put(24, "\1\4");
  put(94, little(std::uint16_t(375)));
  put(96, little(std::uint32_t(375 + own.size())));
  put(100, little(std::uint32_t(1)));
  put(104, std::string(1, char(options.layered ? 128 + 6 : 128 + 2)));
  put(105, little(std::uint16_t(options.layered ? 30 : 27)));
  for (std::size_t k = 0; k < 3; ++k) put(131 + 8 * k, little(0.25));
  put(247, little(std::uint64_t(cloud.places.size())));
  std::string data;
  for (const std::string& chunk : chunks) data += chunk;
  const std::string place = little(std::int64_t(375 + own.size() + 8 + data.size()));
  return header + own + (options.table_at_end ? std::string(8, '\xff') : place) + data +
         little(std::uint32_t(0)) + little(std::uint32_t(chunks.size())) + table.bytes() +
         (options.table_at_end ? place : "");
}

TEST(Laz, HasThePointsThatWereCompressed) {
  Random random(81);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  for (int k = 0; k < testing::share(80); ++k) {
    LazOptions options{k % 2 == 1, random.integer(0, 1) == 1, random.integer(0, 1) == 1, 100};
    const Cloud cloud = random_cloud(random, random.integer(1, 600), options.layered ? 15 : 7, 4);
    const PointFile file = read_points(directory.write("a.laz", laz_of(cloud, options, random)));
    EXPECT_EQ(file.format, "LAZ 1.4");
    ASSERT_EQ(file.points.size(), cloud.places.size());
    for (std::size_t i = 0; i < cloud.places.size(); ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(file.points[i](c), 0.25 * cloud.places[i][std::size_t(c)]) << k << ", " << i;
  }
}

/// Compressed by other programs, beside what they were made of: *.laz and *.las of the same names.
TEST(Laz, OfOtherProgramsEqualsItsLas) {
  const char* given = std::getenv("VERICONE_DATA_DIR");
  const auto folder = std::filesystem::path(given ? given : VERICONE_DEFAULT_DATA_DIR) / "laz";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "laz is not here; set VERICONE_DATA_DIR to the folder with it";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".laz") continue;
    const auto las = std::filesystem::path(entry.path()).replace_extension(".las");
    if (!std::filesystem::exists(las)) continue;
    const PointFile one = read_points(entry.path()), other = read_points(las);
    EXPECT_EQ(one.format.substr(0, 3), "LAZ");
    EXPECT_EQ(other.format.substr(0, 3), "LAS");
    EXPECT_EQ(one.points, other.points) << entry.path();
  }
}

const char* const kPtx =
    "2\n3\n10 20 30\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"
    "1 0 0 0.5\n0 2 0 0.5\n0 0 0 0.5\n0 0 3 0.5\n1 1 1 0.5\n0 0 0 0.5\n";

TEST(Ptx, StandsWhereItsScannerStood) {
  const TemporaryDirectory directory;
  const PointFile one = read_points(directory.write("a.ptx", kPtx));
  EXPECT_EQ(one.format, "PTX");
  // The scanner's x points along y: rows of the matrix are where its axes point.
  EXPECT_EQ(one.points, (std::vector<Vector3d>{{10, 21, 30}, {8, 20, 30}, {10, 20, 33}, {9, 21, 31}}));
  EXPECT_EQ(one.dropped_points, 2U);  // nothing came back
  EXPECT_EQ(one.width, 3U);
  EXPECT_EQ(one.height, 2U);
  const PointFile two = read_points(directory.write(
      "b.ptx",
      kPtx + std::string("1\r\n1\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n1 0 0 0\r\n0 1 0 0\r\n0 0 1 0\r\n"
                         "0 0 0 1\r\n5 6 7 0.1 255 0 0\r\n")));
  EXPECT_EQ(two.points.size(), 5U);
  EXPECT_EQ(two.points.back(), Vector3d(5, 6, 7));
  EXPECT_EQ(two.width, 0U);
}

class MalformedSurveys : public ::testing::TestWithParam<BadFile> {};

TEST_P(MalformedSurveys, AreRefusedInOneLine) {
  testing::expect_refused(GetParam(), [](const auto& path) { (void)read_points(path); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}
/// A sound file in which these bytes stand at a place.
std::string laz_with(std::size_t at, const std::string& bytes, bool layered = false) {
  Random random(82);
  std::string laz = laz_of(random_cloud(random, 250, 7, 4), {layered, false, false, 100}, random);
  return laz.replace(at, bytes.size(), bytes);
}
constexpr std::size_t kOwn = 375 + 54;

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedSurveys,
    ::testing::Values(
        BadFile{"ptx_columns", "a.ptx", replaced(kPtx, "2\n3", "2 3"), "line 1: \"2 3\"", "columns"},
        BadFile{"ptx_rows", "a.ptx", replaced(kPtx, "3\n", "-3\n"), "line 2: \"-3\"", "rows"},
        BadFile{"ptx_many", "a.ptx", replaced(kPtx, "2\n3", "9000000000\n9000000000"), "9000000000 points",
                "bytes left"},
        BadFile{"ptx_place", "a.ptx", replaced(kPtx, "10 20 30", "10 20"), "line 3: \"10 20\"",
                "three numbers"},
        BadFile{"ptx_matrix", "a.ptx", replaced(kPtx, "0 1 0 0", "0 1 0 1"), "line 7", "the last of them 0"},
        BadFile{"ptx_infinite", "a.ptx", replaced(kPtx, "0 1 0 0", "0 inf 0 0"), "line 7", "finite"},
        BadFile{"ptx_word", "a.ptx", replaced(kPtx, "1 1 1", "1 one 1"), "\"one\"", "number"},
        BadFile{"ptx_five", "a.ptx", replaced(kPtx, "1 1 1", "1 1 1 1"), "line 15", "3, 4 or 7"},
        BadFile{"ptx_cut", "a.ptx", std::string(kPtx, std::strlen(kPtx) - 10), "after 5 points", "6 points"},
        BadFile{"ptx_more", "a.ptx", kPtx + std::string("1 2 3 4\n"), "line 17", "columns"},
        BadFile{"laz_record", "a.laz", laz_with(375 + 2, "lesson"), "without LASzip's record", "compressed"},
        BadFile{"laz_compressor", "a.laz", laz_with(kOwn, "\7"), "compressor 7", "1, 2 or 3"},
        BadFile{"laz_parts", "a.laz", laz_with(kOwn + 32, "\x77"), "record of LASzip", "6 for each part"},
        BadFile{"laz_old", "a.laz", laz_with(kOwn + 38, "\1"), "version 1", "today's version"},
        BadFile{"laz_size", "a.laz", laz_with(105, "\x1c"), "parts of 27 bytes", "28 bytes"},
        BadFile{"laz_format", "a.laz", laz_with(104, "\x86"), "records of 27 bytes", "at least 30"},
        BadFile{"laz_many", "a.laz", laz_with(247, little(std::uint64_t(1) << 40)), "compressed points",
                "16"},
        BadFile{"laz_fewer", "a.laz", laz_with(247, little(std::uint64_t(150))), "chunk", "left"},
        BadFile{"laz_more", "a.laz", laz_with(247, little(std::uint64_t(301))), "chunks of", "301"},
        BadFile{"laz_table", "a.laz", laz_with(kOwn + 52, little(std::int64_t(1) << 50)), "table of chunks",
                "to"},
        BadFile{"laz_no_table", "a.laz", laz_with(kOwn + 52, little(std::int64_t(-2))), "at byte -2", "to"},
        BadFile{"laz_layer", "a.laz", laz_with(kOwn + 40 + 8 + 30 + 4, little(0x7fffffffU), true),
                "longer than their chunk", "LASzip"}),
    [](const auto& instance) { return instance.param.name; });

TEST(DamagedSurveys, NeverCrashTheReader) {
  Random random(83);
  SCOPED_TRACE(random.trace());
  const TemporaryDirectory directory;
  const std::pair<std::string, std::string> sound[] = {
      {"a.ptx", kPtx}, {"a.laz", laz_with(0, "LASF")}, {"b.laz", laz_with(0, "LASF", true)}};
  int refused = 0;
  for (const auto& [name, bytes] : sound) {
    ASSERT_FALSE(read_points(directory.write(name, bytes)).points.empty()) << name;
    for (int k = 0; k < testing::share(400); ++k) {
      std::string damaged = bytes;
      if (k % 4 == 0) damaged.resize(std::size_t(random.integer(0, int(bytes.size()) - 1)));
      for (int n = random.integer(1, 8); n > 0 && !damaged.empty(); --n)
        damaged[std::size_t(random.integer(0, int(damaged.size()) - 1))] = char(random.integer(0, 255));
      try {
        EXPECT_LE(read_points(directory.write(name, damaged)).points.size(), 16 * bytes.size());
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, testing::share(200));
}

}  // namespace
}  // namespace vericone::files::surveys_test
