#include "gltf/accessor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <new>

namespace sweepface::gltf {
namespace {

struct Shape {
  std::string_view name;
  std::size_t rows, columns;
};
constexpr std::array<Shape, 7> kShapes{{{"SCALAR", 1, 1},
                                        {"VEC2", 2, 1},
                                        {"VEC3", 3, 1},
                                        {"VEC4", 4, 1},
                                        {"MAT2", 2, 2},
                                        {"MAT3", 3, 3},
                                        {"MAT4", 4, 4}}};

/// Whether `count` elements lie within a view of `length` bytes; sizes are below 2^53.
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t size,
          std::uint64_t length) {
  return offset + (count - 1) * stride + size <= length;
}

Component readType(Members& in) {
  const std::size_t number = in.size("componentType");
  const auto type = componentOf(number);
  if (in.ok() && !type) in.refuse(fmt::format("the componentType {} is unknown", number));
  return type.value_or(Component::float32);
}

void readShape(Members& in, Accessor& accessor) {
  const std::string_view name = in.text("type");
  const auto shape = std::ranges::find(kShapes, name, &Shape::name);
  if (shape == kShapes.end()) return in.refuse("its 'type' is missing or unknown");
  accessor.rows = shape->rows, accessor.columns = shape->columns;
}

void checkView(Members& in, const Document& document, const Accessor& accessor) {
  if (!in.ok() || !accessor.view) return;
  const BufferView& view = document.views[*accessor.view];
  const std::size_t size = accessor.elementSize(), stride = view.stride ? view.stride : size;
  if (accessor.count > 1 && stride < size)
    return in.refuse(
        fmt::format("its elements of {} bytes overlap in buffer view {}, whose "
                    "byteStride is {}",
                    size, *accessor.view, stride));
  if (!fits(accessor.offset, accessor.count, stride, size, view.length))
    in.refuse(fmt::format("its {} elements reach beyond the {} bytes of buffer view {}",
                          accessor.count, view.length, *accessor.view));
}

/// A view that holds `count` values of `size` bytes one after the other.
struct Packed {
  std::size_t view = 0, offset = 0;
};
Packed readPacked(Members& in, const Document& document, std::size_t count, std::size_t size) {
  const Packed packed{in.index("bufferView", document.views.size(), "buffer views"),
                      in.size("byteOffset", 0)};
  if (in.ok() && !fits(packed.offset, count, size, size, document.views[packed.view].length))
    in.refuse(fmt::format("its {} values reach beyond the {} bytes of buffer view {}", count,
                          document.views[packed.view].length, packed.view));
  return packed;
}

Result<Accessor::Sparse> readSparse(const Json& json, const Document& document,
                                    const Accessor& accessor) {
  Accessor::Sparse sparse;
  Members in(json, fmt::format("accessor {}, sparse", accessor.index));
  sparse.count = in.size("count");
  if (in.ok() && (sparse.count == 0 || sparse.count > accessor.count))
    in.refuse(fmt::format("its count {} is not from 1 to {}", sparse.count, accessor.count));
  Members indices(in.object("indices"), in.place() + " indices");
  Members values(in.object("values"), in.place() + " values");
  if (!in.ok()) return in.error();

  sparse.indexType = readType(indices);
  if (!isOfIndices(sparse.indexType))
    indices.refuse("their componentType is not one of unsigned integers");
  const Packed where = readPacked(indices, document, sparse.count, sizeOf(sparse.indexType));
  if (!indices.ok()) return indices.error();
  const Packed what = readPacked(values, document, sparse.count, accessor.elementSize());
  if (!values.ok()) return values.error();
  sparse.indexView = where.view, sparse.indexOffset = where.offset;
  sparse.valueView = what.view, sparse.valueOffset = what.offset;
  return sparse;
}

/// Reads elements into values.
class Elements {
 public:
  explicit Elements(const Accessor& accessor)
      : accessor_(accessor), one_(rangeOf(accessor.type).high) {}

  void read(const char* bytes, double* values) const {
    const std::size_t size = sizeOf(accessor_.type);
    for (std::size_t c = 0; c < accessor_.columns; ++c)
      for (std::size_t r = 0; r < accessor_.rows; ++r)
        *values++ = value(load(accessor_.type, bytes + c * accessor_.columnSize() + r * size));
  }

 private:
  double value(double stored) const {
    return accessor_.normalized ? std::max(stored / one_, -1.0) : stored;
  }

  const Accessor& accessor_;
  double one_;  // what a normalised 1 is stored as
};

void readDense(const Document& document, const Accessor& accessor, std::vector<double>& values) {
  const Elements elements(accessor);
  const std::string_view bytes = document.bytesOf(*accessor.view);
  const std::size_t given = document.views[*accessor.view].stride;
  const std::size_t stride = given ? given : accessor.elementSize();
  for (std::size_t k = 0; k < accessor.count; ++k)
    elements.read(&bytes[accessor.offset + k * stride], &values[k * accessor.components()]);
}

Result<void> overwrite(const Document& document, const Accessor& accessor,
                       std::vector<double>& values) {
  const Accessor::Sparse& sparse = *accessor.sparse;
  const Elements elements(accessor);
  const char* where = &document.bytesOf(sparse.indexView)[sparse.indexOffset];
  const char* what = &document.bytesOf(sparse.valueView)[sparse.valueOffset];
  double last = -1;
  for (std::size_t k = 0; k < sparse.count; ++k) {
    const double index = load(sparse.indexType, where);
    if (index <= last || index >= static_cast<double>(accessor.count))
      return fail(fmt::format(
          "accessor {}, sparse indices: number {} is {}, but they must increase and stay below "
          "{}; export the file again.",
          accessor.index, k, index, accessor.count));
    elements.read(what, &values[static_cast<std::size_t>(index) * accessor.components()]);
    where += sizeOf(sparse.indexType);
    what += accessor.elementSize();
    last = index;
  }
  return {};
}

}  // namespace

std::size_t Accessor::columnSize() const {
  const std::size_t size = sizeOf(type) * rows;
  return columns > 1 ? (size + 3) / 4 * 4 : size;
}

Result<Accessor> accessorAt(const Document& document, std::size_t index) {
  const Json& json = document.list("accessors")[index];
  Accessor accessor;
  accessor.index = index;
  Members in(json, fmt::format("accessor {}", index));
  accessor.type = readType(in);
  readShape(in, accessor);
  accessor.normalized = in.flag("normalized") && accessor.type != Component::float32;
  accessor.count = in.size("count");
  if (accessor.count == 0) in.refuse("its count is 0");
  accessor.offset = in.size("byteOffset", 0);
  accessor.view = in.optionalIndex("bufferView", document.views.size(), "buffer views");
  checkView(in, document, accessor);
  const Json& sparse = in.object("sparse");
  if (!in.ok()) return in.error();
  if (in.has("sparse")) {
    const auto read = readSparse(sparse, document, accessor);
    if (!read) return std::unexpected(read.error());
    accessor.sparse = *read;
  }
  return accessor;
}

Result<std::vector<double>> decode(const Document& document, const Accessor& accessor) {
  if (!accessor.view && accessor.count > document.mostClaimed())
    return fail(fmt::format(
        "accessor {}: it claims {} elements without data in {} bytes, more than a file of this "
        "size can mean; export the file again.",
        accessor.index, accessor.count, document.sourceBytes));
  const std::uint64_t numbers = std::uint64_t{accessor.count} * accessor.components();
  std::vector<double> values;
  if (numbers > values.max_size()) throw std::bad_alloc();
  values.resize(static_cast<std::size_t>(numbers));
  if (accessor.view) readDense(document, accessor, values);
  if (accessor.sparse)
    if (auto ok = overwrite(document, accessor, values); !ok) return std::unexpected(ok.error());
  const auto bad = std::ranges::find_if_not(values, [](double x) { return std::isfinite(x); });
  if (bad == values.end()) return values;
  return fail(fmt::format("accessor {}: element {} is not finite; export the file again.",
                          accessor.index,
                          static_cast<std::size_t>(bad - values.begin()) / accessor.components()));
}

std::vector<Vec3> asVectors(const std::vector<double>& values) {
  std::vector<Vec3> vectors(values.size() / 3);
  for (std::size_t k = 0; k < vectors.size(); ++k)
    vectors[k] = {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
  return vectors;
}

}  // namespace sweepface::gltf
