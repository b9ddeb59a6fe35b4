// A small program that uses an installed Sweepface: the limit of four quads becomes a file.
#include <sweepface/codec.hpp>
#include <sweepface/fit.hpp>
#include <sweepface/io.hpp>
#include <sweepface/subdivision.hpp>

using namespace sweepface;

int main() {
  const auto sheet = parseObj(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 1\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n"
      "f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n",
      "sheet");
  if (!sheet) return 1;
  const auto limit = subdivide({*sheet, {}}, 1);
  if (!limit) return 1;
  const auto converted = convert(limit->rig);
  if (!converted) return 1;
  const auto again = decode(encode(converted->rig), "sheet");
  return again && again->source.gridVertex.size() == 25 ? 0 : 1;
}
