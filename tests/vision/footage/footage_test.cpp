// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <vericone/geometry/error.h>
#include <vericone/vision/footage/footage.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace vericone::vision::footage_test {

namespace fs = std::filesystem;

Image wave(int width, int height, int channels, double phase) {
  Image image(width, height, channels);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      for (int c = 0; c < channels; ++c)
        image.data[(std::size_t(v) * width + u) * channels + c] =
            std::uint8_t(128 + 60 * std::sin(0.15 * u + phase) + 50 * std::cos(0.1 * v + c));
  return image;
}

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.data.size(); ++k) sum += std::abs(double(a.data[k]) - b.data[k]);
  return sum / double(a.data.size());
}

struct Footage : testing::Test {
  Footage()
      : folder(fs::temp_directory_path() / ("vericone_footage_" + std::to_string(::getpid()) +
                                            testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder);
  }
  ~Footage() override { fs::remove_all(folder); }
  std::string refusal(const auto& work) {
    try {
      work();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void cut(const fs::path& from, const fs::path& to, double share) {
    std::ifstream in(from, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::ofstream(to, std::ios::binary) << bytes.substr(0, std::size_t(share * double(bytes.size())));
  }
  fs::path folder;
};

TEST_F(Footage, PicturesComeBack) {
  const Image colours = wave(61, 43, 3, 0.5);
  write_picture(folder / "a.png", colours);
  const Image read = read_picture(folder / "a.png", 3, "picture");
  EXPECT_EQ(read.width, 61);
  EXPECT_EQ(read.height, 43);
  EXPECT_EQ(read.data, colours.data);
  const Image grey = read_picture(folder / "a.png", 1, "picture");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_EQ(grey.data, grey_of(colours).data);
  cut(folder / "a.png", folder / "b.png", 0.6);
  EXPECT_THAT(refusal([&] { return read_picture(folder / "b.png", 1, "picture"); }),
              testing::MatchesRegex("picture: got .*b.png, must be a whole picture .*"));
  EXPECT_THROW(write_picture(folder / "none" / "a.png", colours), std::system_error);
}

TEST_F(Footage, AFolderIsReadInTheOrderOfItsNumbers) {
  for (const int k : {10, 9, 100, 2})
    write_picture(folder / ("f" + std::to_string(k) + ".png"), wave(40, 30, 1, k));
  std::ofstream(folder / "notes.txt") << "no picture\n";
  const auto reader = open_footage(folder, 1, "video");
  EXPECT_EQ(reader->frames(), 4u);
  EXPECT_EQ(reader->rate(), 0);
  Image image;
  for (const int k : {2, 9, 10, 100}) {
    ASSERT_TRUE(reader->next(image));
    EXPECT_EQ(image.data, wave(40, 30, 1, k).data);
  }
  EXPECT_FALSE(reader->next(image));
  write_picture(folder / "f3.png", wave(41, 30, 1, 0));
  const auto again = open_footage(folder, 1, "video");
  ASSERT_TRUE(again->next(image));
  EXPECT_THAT(refusal([&] { again->next(image); }),
              testing::HasSubstr("f3.png of 41 x 30 px, must be as large as"));
}

TEST_F(Footage, AVideoComesBack) {
  const fs::path file = folder / "a.mp4";
  VideoWriter writer(file, 97, 65, 25);
  for (int k = 0; k < 12; ++k) writer.add(wave(97, 65, k % 2 == 0 ? 3 : 1, 0.2 * k));
  EXPECT_EQ(refusal([&] { writer.add(wave(64, 64, 1, 0)); }),
            "image: got 64 x 64 px, must be 97 x 65 px, as the video");
  writer.close();
  const auto reader = open_footage(file, 3, "video");
  EXPECT_NEAR(reader->rate(), 25, 0.01);
  Image image;
  int count = 0;
  for (; reader->next(image); ++count) {
    EXPECT_EQ(image.width, 96);
    EXPECT_EQ(image.height, 64);
    if (count == 4) {
      const Image whole = wave(97, 65, 3, 0.8);
      Image even(96, 64, 3);
      for (int v = 0; v < 64; ++v)
        std::copy_n(&whole.data[std::size_t(v) * 97 * 3], 96 * 3, &even.data[std::size_t(v) * 96 * 3]);
      EXPECT_LT(difference(image, even), 8);
    }
  }
  EXPECT_EQ(count, 12);
  EXPECT_FALSE(reader->broken());
  EXPECT_THROW(VideoWriter(folder / "none" / "a.mp4", 64, 64, 25), std::runtime_error);
}

TEST_F(Footage, WhatIsNoVideoIsNamed) {
  std::ofstream(folder / "a.mp4") << "hello\n";
  fs::create_directory(folder / "empty");
  for (const char* name : {"a.mp4", "none.mp4", "empty"})
    EXPECT_THAT(refusal([&] { return open_footage(folder / name, 1, "video"); }),
                testing::MatchesRegex("video: got .*" + std::string(name) + ", must be a video.*"));
}

TEST_F(Footage, BoxesAreDrawn) {
  Image image = wave(80, 60, 3, 0);
  const Image before = image;
  Sighting s;
  s.sight = Sight::no_occlusion;
  s.measured = true;
  s.box = {20, 20, 30, 20};
  draw_sighting(image, s, "1");
  const std::size_t edge = (std::size_t(20) * 80 + 40) * 3, middle = (std::size_t(30) * 80 + 35) * 3;
  EXPECT_NE(image.data[edge + 1], before.data[edge + 1]);
  EXPECT_EQ(image.data[middle], before.data[middle]);
  s.box = {1e30, 0, 10, 10};
  const Image drawn = image;
  draw_sighting(image, s, "1");
  EXPECT_EQ(image.data, drawn.data);
}

}  // namespace vericone::vision::footage_test
