#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "sweepface/io.hpp"

#include "io/temporary_folder.hpp"

namespace sweepface::testing {

/// What a run of the tool left behind.
struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A wavy sheet of 6 × 5 quads with texture, two materials and two groups; `lift` moves its
/// vertices.
inline std::string sheet(const std::function<Vec3(Vec3)>& lift = {}) {
  std::string text = "mtllib skin.mtl\n";
  for (int j = 0; j <= 5; ++j)
    for (int i = 0; i <= 6; ++i) {
      Vec3 p{1.0 * i, 1.1 * j, 0.3 * std::sin(0.8 * i) * std::cos(0.7 * j)};
      if (lift) p = lift(p);
      text += fmt::format("v {} {} {}\nvt {} {}\n", p.x, p.y, p.z, i / 6.0, j / 5.0);
    }
  for (int j = 0; j < 5; ++j) {
    text += fmt::format("g row{}\nusemtl {}\n", j / 3, j % 2 ? "skin" : "lips");
    for (int i = 0; i < 6; ++i) {
      const int a = 7 * j + i + 1;
      text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", a, a + 1, a + 8, a + 7);
    }
  }
  return text;
}

inline Vec3 opened(Vec3 p) { return {p.x, p.y - 0.2 * p.x, p.z + 0.1 * p.y * p.y}; }
inline Vec3 smiling(Vec3 p) { return {p.x + 0.3 * std::sin(p.y), p.y, p.z + 0.2 * p.x}; }

/// The surface of a cube of n × n quads a side: closed, with eight corners of three quads.
inline std::string cube(int n) {
  std::map<std::array<int, 3>, int> numbers;
  std::string vertices, faces;
  const auto number = [&](std::array<int, 3> p) {
    const auto [place, isNew] = numbers.try_emplace(p, static_cast<int>(numbers.size()) + 1);
    if (isNew) vertices += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int end : {0, n})
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
          faces += "f";
          for (int k = 0; k < 4; ++k) {
            const int corner = end ? k : 3 - k;
            std::array<int, 3> p{};
            p[axis] = end;
            p[(axis + 1) % 3] = a + (corner == 1 || corner == 2);
            p[(axis + 2) % 3] = b + (corner >= 2);
            faces += fmt::format(" {}", number(p));
          }
          faces += "\n";
        }
  return vertices + faces;
}

/// Runs the tool in a folder of its own with a small rig.
class Tool : public ::testing::Test {
 protected:
  /// Runs a command line with relative paths in the test's folder.
  Outcome run(const std::string& arguments) {
    const std::string command = fmt::format("cd '{}' && '{}' {} >.out 2>.err",
                                            (folder / "").string(), SWEEPFACE_TOOL, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / ".out"),
            contents(folder / ".err")};
  }

  /// Starts the tool without a shell, with paths as they are; its errors go to .err in the folder.
  pid_t start(const std::vector<std::string>& arguments) {
    std::vector<char*> words{const_cast<char*>(SWEEPFACE_TOOL)};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const std::string errors = (folder / ".err").string();
    const pid_t child = fork();
    if (child != 0) return child;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    dup2(open(errors.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
    execv(SWEEPFACE_TOOL, words.data());
    _exit(127);
  }

  /// The exit code of a started tool, or -1 if it did not exit by itself.
  static int codeOf(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void makeRig() {
    folder.file("neutral.obj", sheet());
    folder.file("targets/jawOpen.obj", sheet(opened));
    folder.file("targets/smile.obj", sheet(smiling));
  }

  /// Converts the rig to face.sweep.
  void convertRig(const std::string& more = "") {
    makeRig();
    const Outcome made = run("convert neutral.obj targets -o face.sweep --tolerance 0.01 " + more);
    ASSERT_EQ(made.code, 0) << made.err;
  }

  PolygonMesh mesh(std::string_view name) {
    Result<PolygonMesh> read = readMesh(folder / name);
    EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().message);
    return read ? *read : PolygonMesh{};
  }

  /// Whether the tool exits with `code`, one sentence on the error stream that contains `part`, and
  /// nothing on the output stream.
  ::testing::AssertionResult fails(const std::string& arguments, std::string_view part,
                                   int code = 1) {
    const Outcome r = run(arguments);
    if (r.code != code)
      return ::testing::AssertionFailure() << "it ended with " << r.code << ": " << r.err;
    if (!r.out.empty()) return ::testing::AssertionFailure() << "it printed " << r.out;
    if (!r.err.starts_with("sweepface: ") || r.err.find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "'" << r.err << "' does not say '" << part << "'";
    const auto lines = std::count(r.err.begin(), r.err.end(), '\n');
    if (lines != (code == 2 ? 2 : 1))
      return ::testing::AssertionFailure() << "more than a sentence: " << r.err;
    return ::testing::AssertionSuccess();
  }

  TemporaryFolder folder;
};

inline double largestDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, norm(a[v] - b[v]));
  return largest;
}

}  // namespace sweepface::testing
