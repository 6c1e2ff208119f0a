// SPDX-License-Identifier: BSD-3-Clause
//
// LAZ (LASzip): an own decoder of what coordinates need, as Debian 12 has none. Points of formats 0 to 3 are
// one stream of all their fields; those of 6 to 10 are coded in layers, of which the first two have the
// coordinates. Chunks of points stand each for itself.
#include <vericone/geometry/error.h>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>

#include "../binary.h"
#include "las_header.h"
#include "laz_coder.h"

namespace vericone::files {
namespace {

using namespace laz;

/// Kinds of the parts of a record, as the file numbers them.
enum class Part {
  bytes = 0,
  point = 6,
  time,
  colour,
  wave,
  point14 = 10,
  colour14,
  infrared14,
  wave14,
  bytes14
};

struct LazPart {
  Part kind;
  std::size_t size;
};

struct Chunk {
  std::uint64_t points;
  std::string_view bytes;
};

/// Models of one for each value of what they depend on, made when first asked for.
class ModelsByValue {
 public:
  ModelsByValue(std::size_t values, std::uint32_t symbols) : models_(values), symbols_(symbols) {}
  SymbolModel& operator[](std::size_t value) {
    if (!models_[value]) models_[value] = std::make_unique<SymbolModel>(symbols_);
    return *models_[value];
  }

 private:
  std::vector<std::unique_ptr<SymbolModel>> models_;
  std::uint32_t symbols_;
};

/// How far apart two numbers of returns are, up to 7.
std::size_t level_of(std::uint32_t n, std::uint32_t r) {
  return std::min<std::size_t>(n > r ? n - r : r - n, 7);
}

/// What is added to a place: along x, then along y as large as along x makes likely, then z.
struct PlaceModels {
  NumberModel x{32, 2}, y{32, 22}, z{32, 20};

  static std::size_t context(std::uint32_t size, std::uint32_t most, bool is_single) {
    return is_single + (size < most ? size & ~1U : most);
  }
  void read_flat(Decoder& from, RunningMedian& dx, RunningMedian& dy, bool is_single,
                 std::array<std::int32_t, 3>& place) {
    const std::int32_t along_x = x.read(from, dx.get(), is_single);
    dx.add(along_x);
    const std::int32_t along_y = y.read(from, dy.get(), context(x.size(), 20, is_single));
    dy.add(along_y);
    place[0] = std::int32_t(std::uint32_t(place[0]) + std::uint32_t(along_x));
    place[1] = std::int32_t(std::uint32_t(place[1]) + std::uint32_t(along_y));
  }
  std::int32_t read_height(Decoder& from, std::int32_t last, bool is_single) {
    return z.read(from, last, context((x.size() + y.size()) / 2, 18, is_single));
  }
};

std::array<std::int32_t, 3> raw_place(const char* record) {
  return {little_endian<std::int32_t>(record), little_endian<std::int32_t>(record + 4),
          little_endian<std::int32_t>(record + 8)};
}

// Points of formats 0 to 3. Only what others depend on is kept of what is not a coordinate.

class Point10 {
 public:
  explicit Point10(const char* record)
      : place_(raw_place(record)),
        returns_(std::uint8_t(record[14])),
        class_(std::uint8_t(record[15])),
        user_(std::uint8_t(record[17])) {}

  const std::array<std::int32_t, 3>& read(Decoder& from) {
    const std::uint32_t changed = from.symbol(changed_);
    if (changed & 32) returns_ = from.symbol(returns_after_[returns_]);
    const std::uint32_t r = returns_ & 7, n = returns_ >> 3 & 7;
    const std::size_t m = kReturns[n][r];
    if (changed & 16) intensity_.read(from, 0, std::min<std::size_t>(m, 3));
    if (changed & 8) class_ = from.symbol(class_after_[class_]);
    if (changed & 4) from.symbol(angle_[returns_ >> 6 & 1]);
    if (changed & 2) user_ = from.symbol(user_after_[user_]);
    if (changed & 1) source_.read(from, 0, 0);
    models_.read_flat(from, dx_[m], dy_[m], n == 1, place_);
    std::int32_t& height = height_[level_of(n, r)];
    place_[2] = height = models_.read_height(from, height, n == 1);
    return place_;
  }

 private:
  /// By the number of returns and which of them; the places that no sensor fills are there too.
  static constexpr std::uint8_t kReturns[8][8] = {
      {15, 14, 13, 12, 11, 10, 9, 8},  {14, 0, 1, 3, 6, 10, 10, 9},   {13, 1, 2, 4, 7, 11, 11, 10},
      {12, 3, 4, 5, 8, 12, 12, 11},    {11, 6, 7, 8, 9, 13, 13, 12},  {10, 10, 11, 12, 13, 14, 14, 13},
      {9, 10, 11, 12, 13, 14, 15, 14}, {8, 9, 10, 11, 12, 13, 14, 15}};

  std::array<std::int32_t, 3> place_;
  std::uint32_t returns_, class_, user_;
  SymbolModel changed_{64};
  ModelsByValue returns_after_{256, 256}, class_after_{256, 256}, user_after_{256, 256}, angle_{2, 256};
  NumberModel intensity_{16, 4}, source_{16, 1};
  PlaceModels models_;
  std::array<RunningMedian, 16> dx_, dy_;
  std::array<std::int32_t, 8> height_{};
};

/// Times of four sequences, as multiples of the last step of each.
class TimeReader {
 public:
  void read(Decoder& from) {
    // A sequence is left for another at most once; more is what no encoder writes.
    for (int tries = 0; tries < 8; ++tries)
      if (!leaves(from)) return;
    throw Damaged{"times that leave their sequence again and again"};
  }

 private:
  static constexpr std::int32_t kMost = 500, kLeast = -10;
  static constexpr std::uint32_t kSame = kMost - kLeast + 1, kNew = kSame + 1;

  /// True where another sequence goes on.
  bool leaves(Decoder& from) {
    if (step_[now_] == 0) {
      const std::uint32_t kind = from.symbol(still_);
      if (kind == 1) {
        step_[now_] = steps_.read(from, 0, 0);
        strange_[now_] = 0;
      } else if (kind == 2) {
        begin(from);
      } else if (kind > 2) {
        now_ = (now_ + kind - 2) & 3;
        return true;
      }
      return false;
    }
    const std::uint32_t kind = from.symbol(multiples_);
    if (kind == kNew) {
      begin(from);
    } else if (kind > kNew) {
      now_ = (now_ + kind - kNew) & 3;
      return true;
    } else if (kind < kSame) {
      read_multiple(from, std::int32_t(kind));
    }
    return false;
  }

  void read_multiple(Decoder& from, std::int32_t kind) {
    const auto step = [&](std::int32_t times, std::size_t context) {
      return steps_.read(from, std::int32_t(std::uint32_t(times) * std::uint32_t(step_[now_])), context);
    };
    if (kind == 1) {
      step(1, 1);
      strange_[now_] = 0;
      return;
    }
    const std::int32_t below = kMost - kind;  // of those beyond the largest
    if (kind == 0)
      learn(steps_.read(from, 0, 7));
    else if (kind < kMost)
      step(kind, kind < 10 ? 2 : 3);
    else if (kind == kMost)
      learn(step(kMost, 4));
    else if (below > kLeast)
      step(below, 5);
    else
      learn(step(kLeast, 6));
  }

  /// After the fourth in a row that is no multiple the step is another.
  void learn(std::int32_t step) {
    if (++strange_[now_] <= 3) return;
    step_[now_] = step;
    strange_[now_] = 0;
  }

  void begin(Decoder& from) {
    newest_ = (newest_ + 1) & 3;
    steps_.read(from, 0, 8);
    from.bits(32);
    now_ = newest_;
    step_[now_] = 0;
    strange_[now_] = 0;
  }

  SymbolModel multiples_{kNew + 4}, still_{6};
  NumberModel steps_{32, 9};
  std::array<std::int32_t, 4> step_{};
  std::array<int, 4> strange_{};
  std::uint32_t now_ = 0, newest_ = 0;
};

class ColourReader {
 public:
  void read(Decoder& from) {
    const std::uint32_t used = from.symbol(used_);
    // Of red both bytes; of the others only where the colour is no grey.
    for (const auto& [bit, model] : {std::pair(0, 0), std::pair(1, 1)})
      if (used >> bit & 1) from.symbol(bytes_[std::size_t(model)]);
    if ((used >> 6 & 1) == 0) return;
    for (const std::size_t i : {2, 4, 3, 5})
      if (used >> i & 1) from.symbol(bytes_[i]);
  }

 private:
  SymbolModel used_{128};
  ModelsByValue bytes_{6, 256};
};

template <typename Take>
void read_stream(const Chunk& chunk, const std::vector<LazPart>& parts, std::size_t record,
                 const Take& take) {
  Point10 point(chunk.bytes.data());
  std::optional<TimeReader> time;
  std::optional<ColourReader> colour;
  std::size_t further = 0;
  for (const LazPart& part : parts) {
    if (part.kind == Part::time) time.emplace();
    if (part.kind == Part::colour) colour.emplace();
    if (part.kind == Part::bytes) further = part.size;
  }
  ModelsByValue bytes(further, 256);
  take(raw_place(chunk.bytes.data()));
  if (chunk.points == 1) return;
  Decoder from(chunk.bytes.substr(record));
  for (std::uint64_t i = 1; i < chunk.points; ++i) {
    take(point.read(from));
    if (time) time->read(from);
    if (colour) colour->read(from);
    for (std::size_t k = 0; k < further; ++k) from.symbol(bytes[k]);
  }
}

// Points of formats 6 to 10: four channels of a scanner, each with models of its own.

struct Channel {
  explicit Channel(const std::array<std::int32_t, 3>& at, std::uint32_t which, std::uint32_t all)
      : place(at), r(which), n(all) {
    height.fill(at[2]);
  }

  std::array<std::int32_t, 3> place;
  std::uint32_t r, n;
  bool time_changed = false;
  ModelsByValue changed{8, 128}, count_after{16, 16}, which_after{16, 16};
  SymbolModel channel{3}, which_of_same{13};
  PlaceModels models;
  std::array<RunningMedian, 12> dx, dy;
  std::array<std::int32_t, 8> height{};
};

class Point14 {
 public:
  explicit Point14(const char* record) : now_(std::uint8_t(record[15]) >> 4 & 3) {
    const auto returns = std::uint8_t(record[14]);
    channels_[now_] = std::make_unique<Channel>(raw_place(record), returns & 15U, returns >> 4);
  }

  const std::array<std::int32_t, 3>& read(Decoder& flat, Decoder* heights) {
    const std::uint32_t changed = flat.symbol(channels_[now_]->changed[kind_of_last(*channels_[now_])]);
    if (changed & 64) {
      const std::size_t next = (now_ + flat.symbol(channels_[now_]->channel) + 1) & 3;
      if (!channels_[next])
        channels_[next] =
            std::make_unique<Channel>(channels_[now_]->place, channels_[now_]->r, channels_[now_]->n);
      now_ = next;
    }
    Channel& at = *channels_[now_];
    at.time_changed = (changed & 16) != 0;
    if (changed & 4) at.n = flat.symbol(at.count_after[at.n]);
    at.r = return_of(changed & 3, at, flat);
    const bool is_single = at.n == 1;
    const std::size_t m = kReturns[at.n][at.r] * 2U + at.time_changed;
    at.models.read_flat(flat, at.dx[m], at.dy[m], is_single, at.place);
    std::int32_t& height = at.height[level_of(at.n, at.r)];
    if (heights) at.place[2] = height = at.models.read_height(*heights, height, is_single);
    return at.place;
  }

 private:
  /// 3 of a single return, 1 of the first, 2 of the last, 0 of others; and 4 where its time was another.
  static std::size_t kind_of_last(const Channel& last) {
    return (last.r == 1 ? 1U : 0U) + (last.r >= last.n ? 2U : 0U) + (last.time_changed ? 4U : 0U);
  }
  static std::uint32_t return_of(std::uint32_t change, Channel& at, Decoder& from) {
    if (change == 0) return at.r;
    if (change == 1) return (at.r + 1) & 15;
    if (change == 2) return (at.r + 15) & 15;
    if (at.time_changed) return from.symbol(at.which_after[at.r]);
    return (at.r + from.symbol(at.which_of_same) + 2) & 15;
  }

  /// By the number of returns and which of them.
  static constexpr std::uint8_t kReturns[16][16] = {
      {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5}, {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
      {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3}, {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
      {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
      {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
      {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
      {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
      {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
      {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5}};

  std::array<std::unique_ptr<Channel>, 4> channels_;
  std::size_t now_;
};

template <typename Take>
void read_layers(const Chunk& chunk, const std::vector<LazPart>& parts, std::size_t record,
                 const Take& take) {
  take(raw_place(chunk.bytes.data()));
  if (chunk.points == 1) return;
  // After the first point the number of points, and how many bytes each layer has.
  std::size_t layers = 0;
  for (const LazPart& part : parts)
    layers += part.kind == Part::point14      ? 9
              : part.kind == Part::infrared14 ? 2
              : part.kind == Part::bytes14    ? part.size
                                              : 1;
  const std::size_t begin = record + 4 + 4 * layers;
  if (chunk.bytes.size() < begin) throw Damaged{"a chunk that ends before its layers"};
  const auto size = [&](std::size_t i) {
    return std::size_t(little_endian<std::uint32_t>(chunk.bytes.data() + record + 4 + 4 * i));
  };
  if (size(0) > chunk.bytes.size() - begin || size(1) > chunk.bytes.size() - begin - size(0))
    throw Damaged{"layers that are longer than their chunk"};
  Decoder flat(chunk.bytes.substr(begin, size(0)));
  std::optional<Decoder> heights;  // none where all are the same
  if (size(1) > 0) heights.emplace(chunk.bytes.substr(begin + size(0), size(1)));
  Point14 point(chunk.bytes.data());
  for (std::uint64_t i = 1; i < chunk.points; ++i) take(point.read(flat, heights ? &*heights : nullptr));
}

class LazReader {
 public:
  LazReader(const Source& source, const LasHeader& header) : source_(source), header_(header) {
    read_parts();
  }

  void append(std::vector<Eigen::Vector3d>& points) {
    const std::vector<Chunk> all = chunks();
    const auto take = [&](const std::array<std::int32_t, 3>& x) {
      if (points.size() % 4096 == 0) checkpoint();
      points.push_back(header_.place(x[0], x[1], x[2]));
    };
    for (std::size_t i = 0; i < all.size(); ++i) try {
        if (is_layered_)
          read_layers(all[i], parts_, header_.record, take);
        else
          read_stream(all[i], parts_, header_.record, take);
      } catch (const Damaged& damaged) {
        refuse(std::string(damaged.what) + ", in chunk " + std::to_string(i),
               "points as LASzip compresses them");
      }
  }

 private:
  [[noreturn]] void refuse(const std::string& value, const std::string& requirement) const {
    source_.refuse(value, requirement);
  }
  const char* at(std::size_t place) const { return source_.bytes.data() + place; }

  /// The record of LASzip's own among those after the header.
  std::string_view own_record() const {
    std::size_t place = header_.header_size;
    const auto count = little_endian<std::uint32_t>(at(100));
    for (std::uint32_t i = 0; i < count && place + 54 <= header_.points_at; ++i) {
      const std::size_t length = little_endian<std::uint16_t>(at(place + 20));
      if (length > header_.points_at - place - 54) break;
      if (std::string_view(at(place + 2), 16) == std::string_view("laszip encoded\0", 16) &&
          little_endian<std::uint16_t>(at(place + 18)) == 22204)
        return {at(place + 54), length};
      place += 54 + length;
    }
    refuse("compressed points without LASzip's record", "a LAZ file, whose records say how it is compressed");
  }

  void read_parts() {
    const std::string_view own = own_record();
    const auto whole = [&](std::size_t place) { return little_endian<std::uint16_t>(own.data() + place); };
    const std::size_t parts = own.size() >= 34 ? whole(32) : 0;
    if (parts == 0 || own.size() < 34 + 6 * parts)
      refuse("a record of LASzip of " + std::to_string(own.size()) + " bytes", "34, and 6 for each part");
    const int compressor = whole(0);
    chunk_size_ = little_endian<std::uint32_t>(own.data() + 12);
    is_layered_ = compressor == 3;
    has_chunks_ = compressor != 1;
    if (compressor < 1 || compressor > 3 || whole(2) != 0)
      refuse("compressor " + std::to_string(compressor) + ", coder " + std::to_string(whole(2)),
             "compressor 1, 2 or 3, coder 0");
    std::size_t record = 0;
    for (std::size_t i = 0; i < parts; ++i) {
      const int kind = whole(34 + 6 * i), size = whole(36 + 6 * i), version = whole(38 + 6 * i);
      add_part(i, kind, std::size_t(size), version);
      record += std::size_t(size);
    }
    if (record != header_.record || (parts_[0].kind == Part::point14) != (header_.point_format >= 6))
      refuse("parts of " + std::to_string(record) + " bytes",
             "those of point format " + std::to_string(header_.point_format) + ", of " +
                 std::to_string(header_.record) + " bytes");
  }

  void add_part(std::size_t i, int kind, std::size_t size, int version) {
    struct Known {
      Part kind;
      std::size_t size;  // 0: any
      int version;
    };
    constexpr Known kStream[] = {
        {Part::point, 20, 2}, {Part::time, 8, 2}, {Part::colour, 6, 2}, {Part::bytes, 0, 2}};
    constexpr Known kLayers[] = {{Part::point14, 30, 3},
                                 {Part::colour14, 6, 3},
                                 {Part::infrared14, 8, 3},
                                 {Part::wave14, 29, 3},
                                 {Part::bytes14, 0, 3}};
    const auto fits = [&](const Known& known) {
      return int(known.kind) == kind && (known.size == 0 ? size > 0 : known.size == size) &&
             known.version == version && (i == 0) == (&known == kStream || &known == kLayers) &&
             (parts_.empty() || parts_.back().kind < known.kind || known.kind == Part::bytes) &&
             (parts_.empty() || parts_.back().kind != Part::bytes);
    };
    using All = std::span<const Known>;
    for (const Known& known : is_layered_ ? All(kLayers) : All(kStream))
      if (fits(known)) {
        parts_.push_back({known.kind, size});
        return;
      }
    refuse("part " + std::to_string(i) + " of kind " + std::to_string(kind) + ", " + std::to_string(size) +
               " bytes, version " + std::to_string(version),
           "one that LASzip 2 or 3 writes, but no waves of point formats 4 and 5: laszip or pdal translate "
           "makes "
           "LAS, or a file of today's version");
  }

  std::vector<Chunk> chunks() const {
    const std::string_view bytes = source_.bytes;
    if (header_.count == 0) return {};
    if (!has_chunks_) {
      if (bytes.size() - header_.points_at < header_.record) refuse("no points", "a first one as it is");
      return {{header_.count, bytes.substr(header_.points_at)}};
    }
    const auto place_of_table = [&](std::size_t place) {
      if (place + 8 > bytes.size()) refuse("end of file before the chunks", "the place of their table");
      return little_endian<std::int64_t>(bytes.data() + place);
    };
    std::int64_t table = place_of_table(header_.points_at);
    // Whoever could not go back wrote it at the end.
    if (table == -1) table = place_of_table(bytes.size() - 8);
    const std::size_t first = header_.points_at + 8;
    if (table < std::int64_t(first) || std::uint64_t(table) > bytes.size() - 8)
      refuse("a table of chunks at byte " + std::to_string(table),
             std::to_string(first) + " to " + std::to_string(bytes.size() - 8));
    try {
      return chunks_of_table(std::size_t(table), bytes.substr(first, std::size_t(table) - first));
    } catch (const Damaged& damaged) {
      refuse(std::string(damaged.what) + ", in the table of chunks", "a table as LASzip writes it");
    }
  }

  std::vector<Chunk> chunks_of_table(std::size_t table, std::string_view data) const {
    const auto count = little_endian<std::uint32_t>(at(table + 4));
    if (little_endian<std::uint32_t>(at(table)) != 0 || count > data.size() / header_.record)
      refuse("a table of " + std::to_string(count) + " chunks",
             "as many as the " + std::to_string(data.size()) + " bytes before it can hold");
    constexpr std::uint32_t kVariable = 0xffffffffU;
    Decoder from(std::string_view(source_.bytes).substr(table + 8));
    NumberModel numbers(32, 2);
    std::vector<Chunk> chunks;
    std::uint64_t left = header_.count;
    std::int32_t points = 0, size = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (chunk_size_ == kVariable) points = numbers.read(from, points, 0);
      size = numbers.read(from, size, 1);
      const std::uint64_t of_chunk =
          chunk_size_ == kVariable ? std::uint32_t(points) : std::min<std::uint64_t>(chunk_size_, left);
      if (of_chunk == 0 || of_chunk > left || std::uint32_t(size) < header_.record ||
          std::uint32_t(size) > data.size())
        refuse("chunk " + std::to_string(i) + " of " + std::to_string(of_chunk) + " points and " +
                   std::to_string(std::uint32_t(size)) + " bytes",
               "what is left of " + std::to_string(left) + " and " + std::to_string(data.size()));
      chunks.push_back({of_chunk, data.substr(0, std::uint32_t(size))});
      data.remove_prefix(std::uint32_t(size));
      left -= of_chunk;
    }
    if (left != 0)
      refuse("chunks of " + std::to_string(header_.count - left) + " points",
             std::to_string(header_.count) + ", as the header says");
    return chunks;
  }

  const Source& source_;
  const LasHeader& header_;
  std::vector<LazPart> parts_;
  std::uint32_t chunk_size_ = 0;
  bool is_layered_ = false, has_chunks_ = true;
};

}  // namespace

void append_laz(const Source& source, const LasHeader& header, std::vector<Eigen::Vector3d>& points) {
  LazReader(source, header).append(points);
}

}  // namespace vericone::files
