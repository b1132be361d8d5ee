// SPDX-License-Identifier: MIT
#include "io/map_file.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace map_file_test {

class MapFile : public ::testing::Test {
 protected:
  Grid read(const std::string& content) {
    warnings_.clear();
    return read_map(directory_.write("m.map", content), &warnings_);
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }

  TemporaryDirectory directory_;
  std::vector<std::string> warnings_;
};

const std::string kHeader = "type octile\nheight 2\nwidth 3\nmap\n";

TEST_F(MapFile, ReadsCellsRowByRow) {
  const Grid grid = read(kHeader + ".@.\nT..\n");
  EXPECT_EQ(grid.width(), 3);
  EXPECT_EQ(grid.height(), 2);
  EXPECT_FALSE(grid.passable(grid.cell({1, 0})));
  EXPECT_FALSE(grid.passable(grid.cell({0, 1})));
  EXPECT_EQ(grid.passable_count(), 4);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(MapFile, AcceptsVariantsOfOtherTools) {
  EXPECT_EQ(read("type octile\r\nwidth 3\r\nheight 2\r\nmap\r\n...\r\n...\r\n").passable_count(),
            6);
  EXPECT_EQ(read(kHeader + "...\n...").passable_count(), 6);        // no newline at the end
  EXPECT_EQ(read(kHeader + "...\n...\n\n\n").passable_count(), 6);  // empty lines at the end
  EXPECT_EQ(read("\xEF\xBB\xBF" + kHeader + "...\n...\n").passable_count(), 6);
}

TEST_F(MapFile, WarnsOnceAboutTerrainThatToolsReadDifferently) {
  EXPECT_EQ(read(kHeader + ".GS\nEOW\n").passable_count(), 4);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("m.map: line 5, column 2: 'G' is passable here"), std::string::npos);
}

TEST_F(MapFile, NamesLineAndColumnOfWrongCells) {
  EXPECT_EQ(refused(kHeader + "...\n.x.\n"),
            "m.map: line 6, column 2: unknown map character 'x'; expected one of . G S E "
            "(passable) or @ O T W (blocked)");
  EXPECT_EQ(refused(kHeader + "...\n.\xff.\n").substr(0, 54),
            "m.map: line 6, column 2: unknown map character '\\xff';");
  EXPECT_EQ(refused(kHeader + "...\n..\n"),
            "m.map: line 6, column 3: the row has 2 characters; expected 3");
  EXPECT_EQ(refused(kHeader + "....\n...\n"),
            "m.map: line 5, column 4: the row has 4 characters; expected 3");
  EXPECT_EQ(refused(kHeader + "\n...\n"),
            "m.map: line 5, column 1: the row has 0 characters; expected 3");
}

TEST_F(MapFile, ExplainsHowObstaclesAreWritten) {
  EXPECT_EQ(refused(kHeader + "...\n.#.\n"),
            "m.map: line 6, column 2: found '#'; expected '@' where the map is blocked, as in "
            "Moving AI's maps");
}

TEST_F(MapFile, RefusesAWrongNumberOfRows) {
  EXPECT_EQ(refused(kHeader), "m.map: line 5, column 1: the map ends after 0 rows; expected 2");
  EXPECT_EQ(refused(kHeader + "...\n"),
            "m.map: line 6, column 1: the map ends after 1 rows; expected 2");
  EXPECT_EQ(refused(kHeader + "...\n...\n...\n"),
            "m.map: line 7, column 1: the map has more than 2 rows; expected no more");
}

TEST_F(MapFile, ReadsHeadersStrictly) {
  EXPECT_EQ(refused(""), "m.map: line 1, column 1: the file ends here; expected 'type octile'");
  EXPECT_EQ(refused("type tile\n"),
            "m.map: line 1, column 1: is not a map; expected the first line 'type octile' ('grove "
            "convert' converts drawings to maps)");
  EXPECT_EQ(refused("type octile\n"),
            "m.map: line 2, column 1: the file ends here; expected 'height' or 'width'");
  const std::string both = "expected 'height' and 'width', one per line, each with a number";
  EXPECT_EQ(refused("type octile\nheight\n"), "m.map: line 2, column 1: found 'height'; " + both);
  EXPECT_EQ(refused("type octile\nheight 2\nheight 2\n"),
            "m.map: line 3, column 1: found 'height 2'; " + both);
  EXPECT_EQ(refused("type octile\nheight 2\nwidth 3\nmaps\n"),
            "m.map: line 4, column 1: found 'maps'; expected 'map'");
}

TEST_F(MapFile, RefusesInvalidSizes) {
  const auto with_height = [&](const std::string& height) {
    return refused("type octile\nheight " + height + "\nwidth 3\nmap\n").substr(0, 25);
  };
  for (const char* height : {"0", "-1", "2.5", "99999999999", "x", "1e3", "2 3"})
    EXPECT_EQ(with_height(height), "m.map: line 2, column 8: ") << height;
  EXPECT_EQ(refused("type octile\nheight 60000\nwidth 60000\nmap\n"),
            "m.map: line 2, column 1: found 60000 x 60000 cells; expected at most 67108864");
}

TEST_F(MapFile, RefusesFoldersAndMissingFiles) {
  EXPECT_EQ(refusal([&] { read_map(directory_ / "none.map"); }),
            "none.map: cannot be read: No such file or directory");
  EXPECT_NE(refusal([&] { read_map(directory_.path()); }).find("is a folder; expected a file"),
            std::string::npos);
}

TEST_F(MapFile, RoundTrips) {
  const Grid grid(3, 2, {true, false, true, true, true, false});
  write_map(directory_ / "out.map", grid);
  EXPECT_EQ(file_content(directory_ / "out.map"), kHeader + ".@.\n..@\n");
}

TEST_F(MapFile, BorderedCsvHasABorderOfBlockedCells) {
  const Grid grid(3, 2, {true, false, true, true, true, false});
  write_bordered_csv(directory_ / "out.csv", grid);
  EXPECT_EQ(file_content(directory_ / "out.csv"),
            "4,5\n1,1,1,1,1\n1,0,1,0,1\n1,0,0,1,1\n1,1,1,1,1\n");
}

}  // namespace map_file_test
}  // namespace grove::detail
