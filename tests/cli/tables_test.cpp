#include <sstream>

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// scripts/tables, which makes the tables of docs/performance.md.
class Tables : public Tool {
 protected:
  void SetUp() override {
    if (std::system("command -v python3 >/dev/null") != 0) GTEST_SKIP() << "there is no python3";
    makeRig();
  }
  Outcome tables(const std::string& arguments) {
    const std::string command =
        fmt::format("cd '{}' && SWEEPFACE_TOOL='{}' python3 '{}/scripts/tables' {} >.out 2>.err",
                    (folder / "").string(), SWEEPFACE_TOOL, SWEEPFACE_SOURCE_DIR, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / ".out"),
            contents(folder / ".err")};
  }
};

TEST_F(Tables, HaveARowForEveryFaceAndTolerance) {
  const Outcome r = tables("sheet: neutral.obj targets -- 0.1 0.05p still: neutral.obj -- '0.1*s'");
  ASSERT_EQ(r.code, 0) << r.err;
  std::vector<std::string> lines;
  std::istringstream text(r.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u) << r.out;
  const auto bars = std::ranges::count(lines[0], '|');
  for (const std::string& line : lines) EXPECT_EQ(std::ranges::count(line, '|'), bars) << line;
  for (const std::string column :
       {"bytes", "distance RMS", "displacement RMS", "normals RMS", "99 %", "99.9 %", "folds"})
    EXPECT_NE(lines[0].find(" " + column + " |"), std::string::npos) << column;
  EXPECT_TRUE(lines[2].starts_with("| sheet | 0.1 | ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("|  | 0.05, packed | ")) << lines[3];
  EXPECT_TRUE(lines[4].starts_with("| still | 0.1, no limit on normals, subdivided | "))
      << lines[4];
}

TEST_F(Tables, SayWhatIsWrong) {
  for (const std::string wrong : {"", "neutral.obj -- 0.1", "sheet: neutral.obj", "sheet: -- 0.1"})
    EXPECT_EQ(tables(wrong).code, 1) << wrong;
  const Outcome r = tables("sheet: nothing.obj -- 0.1");
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(r.err.starts_with("sweepface: Cannot read nothing.obj")) << r.err;
}

}  // namespace
}  // namespace sweepface
