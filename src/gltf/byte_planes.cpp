#include "gltf/byte_planes.hpp"

#include <algorithm>
#include <vector>

#include "gltf/deflate.hpp"
#include "gltf/fixed32.hpp"

namespace sweepface::gltf {
namespace {

/// How many bytes of a table are tried to judge it.
constexpr std::size_t kEnough = std::size_t{1} << 18;

/// A plane of a table: bytes that are `width` apart in its rows, made contiguous.
std::string planeOf(std::string_view rows, std::size_t plane, std::size_t width) {
  std::string bytes;
  bytes.reserve(rows.size() / width);
  for (std::size_t at = plane; at < rows.size(); at += width) bytes += rows[at];
  return bytes;
}

std::string differences(std::string_view plane) {
  std::string steps(plane);
  for (std::size_t k = steps.size(); k-- > 1;)
    steps[k] = static_cast<char>(static_cast<unsigned char>(plane[k]) -
                                 static_cast<unsigned char>(plane[k - 1]));
  return steps;
}

void undoDifferences(std::string& plane) {
  for (std::size_t k = 1; k < plane.size(); ++k)
    plane[k] = static_cast<char>(static_cast<unsigned char>(plane[k]) +
                                 static_cast<unsigned char>(plane[k - 1]));
}

/// For each plane a byte that says whether it deflates better as differences.
std::string stepsOf(std::string_view rows, std::size_t width) {
  std::string steps;
  for (std::size_t p = 0; p < width; ++p) {
    const std::string plane = planeOf(rows, p, width);
    steps += deflated(differences(plane)).size() < deflated(plane).size() ? '\1' : '\0';
  }
  return steps;
}

std::string inPlanes(std::string_view rows, std::string_view steps) {
  std::string planes;
  for (std::size_t p = 0; p < steps.size(); ++p) {
    const std::string plane = planeOf(rows, p, steps.size());
    planes += steps[p] != 0 ? differences(plane) : plane;
  }
  return planes;
}

/// Takes numbers and bytes from the front of a text.
class Front {
 public:
  explicit Front(std::string_view text) : text_(text) {}

  std::string_view bytes(std::size_t count) {
    ok_ &= count <= text_.size();
    const std::string_view taken = text_.substr(0, count);
    text_.remove_prefix(taken.size());
    return taken;
  }
  std::size_t number() {
    const std::string_view four = bytes(4);
    return ok_ ? fixed32(four, 0) : 0;
  }
  std::string_view rest() const { return text_; }
  bool ok() const { return ok_; }

 private:
  std::string_view text_;
  bool ok_ = true;
};

void putRows(std::string& bytes, const ByteTable& table, std::string_view steps) {
  const std::string planes = bytes.substr(table.begin, table.size());
  for (std::size_t p = 0; p < table.width; ++p) {
    std::string plane = planes.substr(p * table.rows, table.rows);
    if (steps[p] != 0) undoDifferences(plane);
    for (std::size_t k = 0; k < table.rows; ++k)
      bytes[table.begin + k * table.width + p] = plane[k];
  }
}

}  // namespace

std::string toPlanes(std::string_view bytes, std::span<const ByteTable> tables) {
  std::string turned(bytes), heads;
  std::size_t count = 0;
  for (const ByteTable& table : tables) {
    const std::string_view rows = bytes.substr(table.begin, table.size());
    // Large tables are judged by their first rows.
    const std::string_view some =
        rows.substr(0, std::max<std::size_t>(kEnough / table.width, 1) * table.width);
    const std::string steps = stepsOf(some, table.width);
    std::string head;
    for (const std::size_t number : {table.begin, table.width, table.rows}) append32(head, number);
    head += steps;
    if (deflated(inPlanes(some, steps)).size() + head.size() >= deflated(some).size()) continue;
    turned.replace(table.begin, table.size(), inPlanes(rows, steps));
    heads += head;
    ++count;
  }
  if (count == 0) return {};
  std::string text;
  append32(text, count);
  return text + heads + turned;
}

Result<std::string> fromPlanes(std::string_view planes) {
  struct Turned {
    ByteTable table;
    std::string_view steps;
  };
  Front front(planes);
  std::vector<Turned> all;
  std::size_t end = 0;
  for (std::size_t left = front.number(); left > 0 && front.ok(); --left) {
    ByteTable table;
    table.begin = front.number();
    table.width = front.number();
    table.rows = front.number();
    const std::string_view steps = front.bytes(table.width);
    const std::uint64_t size = std::uint64_t{table.width} * table.rows;
    const bool sound = table.begin >= end && size > 0 && table.begin + size <= planes.size() &&
                       steps.find_first_not_of(std::string_view("\0\1", 2)) == steps.npos;
    if (!sound) return fail("it is damaged");
    end = table.end();
    all.push_back({table, steps});
  }
  if (!front.ok() || end > front.rest().size()) return fail("it is damaged");
  std::string bytes(front.rest());
  for (const auto& [table, steps] : all) putRows(bytes, table, steps);
  return bytes;
}

}  // namespace sweepface::gltf
