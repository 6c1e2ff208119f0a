// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are whole or not there, and tables that are gone on with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "output/output_file.h"
#include "work/resumable_table.h"

namespace vericone::work::work_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Work : public ::testing::Test {
 protected:
  Work() { fs::remove_all(folder_); }
  ~Work() override { fs::remove_all(folder_); }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }
  template <typename Act>
  static std::string refusal(Act act) {
    try {
      act();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) /
      (std::string("vericone_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

class StagedFolders : public Work {};

TEST_F(StagedFolders, AppearTogetherAndReplaceWhatAnEarlierRunLeft) {
  fs::create_directories(folder_);
  for (const char* old : {"old.png", "mine.png", "a.txt"}) write_whole(folder_ / old, "old");
  {
    StagedFolder staged(folder_);
    write_whole(staged.path() / "a.txt", "new");
    fs::create_directory(staged.path() / "sub");
    write_whole(staged.path() / "sub" / "b.txt", "b");
    EXPECT_EQ(staged.published(staged.path() / "a.txt"), folder_ / "a.txt");
    EXPECT_EQ(content(folder_ / "a.txt"), "old");
    EXPECT_EQ(staged.publish({"old.png", "a.txt"}),
              (std::vector<fs::path>{folder_ / "a.txt", folder_ / "sub" / "b.txt"}));
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"a.txt", "mine.png", "sub"}));
  EXPECT_EQ(content(folder_ / "a.txt"), "new");
}

TEST_F(StagedFolders, LeaveNothingWhereNothingIsPublished) {
  for (const bool abandons : {true, false}) {
    StagedFolder staged(folder_ / "one" / "two");
    write_whole(staged.path() / "half.txt", "half");
    if (!abandons) continue;
    staged.abandon();
    EXPECT_FALSE(fs::exists(folder_));
    EXPECT_THAT(refusal([&] { staged.publish(); }), HasSubstr("abandoned"));
  }
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(StagedFolders, OfOneProcessDoNotDisturbEachOther) {
  StagedFolder first(folder_), second(folder_);
  ASSERT_NE(first.path(), second.path());
  write_whole(first.path() / "a.txt", "1");
  write_whole(second.path() / "b.txt", "2");
  first.abandon();
  second.publish();
  second.abandon();
  EXPECT_EQ(names(), std::vector<std::string>{"b.txt"});
}

TEST_F(StagedFolders, RemoveWhatKilledOnesLeft) {
  fs::create_directories(folder_ / ".partial-123456-1");
  write_whole(folder_ / ".partial-123456-1" / "a.txt", "half");
  write_whole(folder_ / "mine.partial-1", "");
  StagedFolder(folder_).abandon();
  EXPECT_EQ(names(), std::vector<std::string>{"mine.partial-1"});
}

TEST_F(StagedFolders, RefuseWhatIsNoFolder) {
  fs::create_directories(folder_);
  write_whole(folder_ / "file", "");
  EXPECT_THAT(refusal([&] { StagedFolder staged(folder_ / "file" / "in", "--out"); }),
              HasSubstr("--out: got " + (folder_ / "file" / "in").string() + ", must be a folder; "));
  StagedFolder staged(folder_);
  fs::create_directory(folder_ / "a.txt");
  write_whole(staged.path() / "a.txt", "");
  write_whole(staged.path() / "b.txt", "");
  EXPECT_THAT(refusal([&] { staged.publish(); }), HasSubstr("a folder without one in it called a.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "b.txt"));
}

class ResumableTables : public Work {
 protected:
  ResumableTables() {
    table_.settings = "# squares";
    table_.header = "n,square";
    table_.count = 1003;
    table_.block = 7;
    table_.row = [this](std::uint64_t i) {
      ++computed_;
      return std::to_string(i) + "," + std::to_string(i * i);
    };
  }

  bool fill(const std::string& field = "out") {
    StagedFolder folder(folder_, field);
    const bool finished = run_table(table_, folder);
    if (finished) folder.publish();
    return finished;
  }
  std::string whole() const {
    std::string text = "# squares\nn,square\n";
    for (std::uint64_t i = 0; i < table_.count; ++i)
      text += std::to_string(i) + "," + std::to_string(i * i) + "\n";
    return text;
  }

  ResumableTable table_{"squares.csv"};
  std::atomic<std::uint64_t> computed_ = 0;
  const fs::path partial_ = folder_ / "squares.csv.partial", done_ = folder_ / "squares.csv";
};

TEST_F(ResumableTables, DependOnNoThreadAndNoStop) {
  for (const int threads : {1, 3}) {
    fs::remove_all(folder_);
    table_.threads = threads;
    int stops = 0;
    for (bool finished = false; !finished; ++stops) {
      std::uint64_t told = 0;
      const std::uint64_t enough = 300 * std::uint64_t(stops + 1);
      table_.progress = [&](std::uint64_t rows) {
        EXPECT_GE(rows, told);
        told = rows;
        return rows < enough;
      };
      finished = fill();
      EXPECT_EQ(fs::exists(partial_), !finished);
    }
    EXPECT_GT(stops, 2);
    EXPECT_EQ(content(done_), whole());
    EXPECT_EQ(names(), std::vector<std::string>{"squares.csv"});
  }
}

TEST_F(ResumableTables, RowsInMemoryAreThose) {
  std::string text = "# squares\nn,square\n";
  EXPECT_TRUE(compute_rows(table_, 0, [&](std::string_view rows) { text += rows; }));
  EXPECT_EQ(text, whole());
}

TEST_F(ResumableTables, AreCutAfterTheLastWholeRow) {
  fs::create_directories(folder_);
  write_whole(partial_, "# squares\nn,square\n0,0\n1,1\n2,");
  EXPECT_TRUE(fill());
  EXPECT_EQ(content(done_), whole());
  EXPECT_EQ(computed_, table_.count - 2);
}

TEST_F(ResumableTables, RefuseRowsThatAreNotTheirs) {
  fs::create_directories(folder_);
  write_whole(partial_, "# cubes\nn,square\n0,0\n");
  EXPECT_THAT(refusal([&] { fill("--out"); }), HasSubstr("--out: got " + folder_.string() +
                                                         ", must be a folder "
                                                         "without the unfinished run of other settings"));
  for (const char* rows : {"0,0\n2,4\n", "0,0\n0,0\n", "0,0\n1,nan\n", "0,0\n1,1,1\n"}) {
    write_whole(partial_, std::string("# squares\nn,square\n") + rows);
    EXPECT_THAT(refusal([&] { fill(); }), HasSubstr("has row 1 in line 4; delete that file to begin anew"))
        << rows;
  }
}

TEST_F(ResumableTables, OneRunWritesThem) {
  StagedFolder first(folder_), second(folder_);
  (void)first.resumable("squares.csv");
  EXPECT_EQ(first.resumable("squares.csv"), partial_);
  EXPECT_THAT(refusal([&] { (void)second.resumable("squares.csv"); }),
              HasSubstr("a folder that no other run is writing to"));
  first.abandon();
  EXPECT_EQ(second.resumable("squares.csv"), partial_);
}

TEST_F(ResumableTables, FailAndStopWithTheirRow) {
  table_.threads = 2;
  const auto square = table_.row;
  table_.row = [&](std::uint64_t i) {
    if (i == 500) throw std::runtime_error("row 500");
    return square(i);
  };
  EXPECT_THROW(fill(), std::runtime_error);
  EXPECT_THAT(content(partial_), ::testing::StartsWith("# squares\nn,square\n"));
  Stop stop;
  const StopScope scope(&stop);
  table_.row = [&](std::uint64_t i) {
    if (i == 600) stop.request();
    checkpoint();
    return square(i);
  };
  EXPECT_THROW(fill(), Interrupted);
  table_.row = square;
  const StopScope none(nullptr);
  EXPECT_TRUE(fill());
  EXPECT_EQ(content(done_), whole());
}

TEST(Provenance, HasWhatWasReadAndNothingWhereItIsGone) {
  const fs::path file = fs::path(::testing::TempDir()) / "vericone_provenance";
  write_whole(file, "abc");
  const std::string text = provenance("vericone test", 2, {file, "/none"});
  fs::remove(file);
  EXPECT_THAT(text,
              HasSubstr("\"sha256\": \"ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\""));
  EXPECT_THAT(text, HasSubstr("\"sha256\": null"));
  EXPECT_THAT(text, HasSubstr("\"command\": \"vericone test\""));
  EXPECT_THAT(text, HasSubstr("\"threads\": 2"));
}

}  // namespace
}  // namespace vericone::work::work_test
