#include "spume/io/csv_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "spume/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

using testing::ScratchFolder;
using testing::text_of;

constexpr std::array<Column, 3> columns{{{"n", "a count"}, {"x_m", "a place"}, {"word", "a word"}}};

TEST(CsvTable, StartsWithItsHeaderAndHasOneLineARow) {
  const ScratchFolder folder;
  CsvTable table(folder.path() / "a.csv", columns);
  EXPECT_EQ(text_of(folder.path() / "a.csv"), "n,x_m,word\n");
  table.append({3, 0.5, "film"});
  table.append({-1, 1e-300, ""});
  EXPECT_EQ(text_of(folder.path() / "a.csv"),
            "n,x_m,word\n3,0.5,film\n-1,1e-300,\n");  // there before it is closed
}

TEST(CsvTable, NumbersReadBackToTheSameBits) {
  const ScratchFolder folder;
  const double values[] = {
      0.1, 1.0 / 3, 6.02214076e23, 5e-324, -1.7976931348623157e308, std::nextafter(1e-6, 1)};
  CsvTable table(folder.path() / "a.csv", columns);
  for (double value : values) table.append({0, value, "x"});
  std::ifstream file(folder.path() / "a.csv");
  std::string line;
  std::getline(file, line);
  for (double value : values) {
    std::getline(file, line);
    EXPECT_EQ(std::strtod(line.c_str() + 2, nullptr), value) << line;
  }
}

TEST(CsvTable, TextWithCommasOrQuotesIsQuotedAndLineEndsBecomeSpaces) {
  const ScratchFolder folder;
  CsvTable table(folder.path() / "a.csv", columns);
  table.append({0, 0.0, "a, \"b\"\nc"});
  EXPECT_EQ(text_of(folder.path() / "a.csv"), "n,x_m,word\n0,0,\"a, \"\"b\"\" c\"\n");
}

TEST(CsvTable, GoesOnAfterTheRowsThatCount) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.csv";
  std::ofstream(path) << "n,x_m,word\n0,0,a\n1,1,b\n2,2,c\n3,3,cut sh";  // killed while writing
  {
    CsvTable table(path, columns, 2);
    EXPECT_EQ(text_of(path), "n,x_m,word\n0,0,a\n1,1,b\n");
    table.append({7, 7.0, "d"});
  }
  EXPECT_EQ(text_of(path), "n,x_m,word\n0,0,a\n1,1,b\n7,7,d\n");
  CsvTable(path, columns, 0);
  EXPECT_EQ(text_of(path), "n,x_m,word\n");
}

TEST(CsvTable, RefusesToGoOnWithLessThanWasPromised) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.csv";
  EXPECT_THROW(CsvTable(path, columns, 0), InputError);
  std::ofstream(path) << "n,x_m,word\n0,0,a\n1,1,cut sh";
  EXPECT_THROW(CsvTable(path, columns, 2), InputError);
  EXPECT_EQ(text_of(path), "n,x_m,word\n0,0,a\n1,1,cut sh");  // and leaves the file alone
  std::ofstream(path) << "n,y_m,word\n0,0,a\n";
  EXPECT_THROW(CsvTable(path, columns, 1), InputError);
}

TEST(CsvTable, RefusesARowOfAnotherLength) {
  const ScratchFolder folder;
  CsvTable table(folder.path() / "a.csv", columns);
  EXPECT_THROW(table.append({1, 2.0}), std::logic_error);
}

TEST(CsvTable, SaysWhichFileCannotBeWritten) {
  try {
    CsvTable table("/nowhere/a.csv", columns);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/a.csv"), std::string::npos);
  }
}

}  // namespace
}  // namespace spume::io
