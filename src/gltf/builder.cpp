#include "gltf/builder.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace sweepface::gltf {
namespace {

constexpr int vertexBuffer = 34962, indexBuffer = 34963;
// Roughly how much an accessor's JSON grows when it is sparse.
constexpr std::size_t sparseOverhead = 128;

void align(std::string& bytes, std::size_t size) {
  bytes.resize((bytes.size() + size - 1) / size * size, '\0');
}

/// Elements of attributes begin at multiples of four bytes.
std::size_t strideOf(std::size_t elementSize) { return (elementSize + 3) / 4 * 4; }

const char* shapeOf(std::size_t width) {
  static constexpr std::array names{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return width < names.size() ? names[width] : "MAT4";
}

/// Exactly what is stored: integers stay integers, floats keep all their digits.
Json numberOf(Component type, double value) {
  if (type == Component::float32) return value;
  return static_cast<std::int64_t>(value);
}

void setBounds(Json& accessor, const Column& column) {
  std::array<double, 16> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < column.count() * column.width; ++k) {
    const double value = column.stored(k);
    low[k % column.width] = std::min(low[k % column.width], value);
    high[k % column.width] = std::max(high[k % column.width], value);
  }
  accessor["min"] = Json::array(), accessor["max"] = Json::array();
  for (std::size_t k = 0; k < column.width; ++k) {
    accessor["min"].push_back(numberOf(column.type, low[k]));
    accessor["max"].push_back(numberOf(column.type, high[k]));
  }
}

std::vector<double> rowsThatAreNotZero(const Column& column) {
  const std::size_t size = column.elementSize();
  std::vector<double> rows;
  for (std::size_t row = 0; row < column.count(); ++row) {
    const auto element = std::string_view(column.bytes).substr(row * size, size);
    if (element.find_first_not_of('\0') != std::string_view::npos)
      rows.push_back(static_cast<double>(row));
  }
  return rows;
}

Component typeOfIndices(std::size_t count) {
  if (count <= 0xff) return Component::uint8;
  return count <= 0xffff ? Component::uint16 : Component::uint32;
}

constexpr std::array grownLists{"accessors", "bufferViews"};

}  // namespace

// A JSON object moves all its members when it gets another one, so both lists are made now.
Builder::Builder(Document& document) : document_(document) {
  if (document.buffers.empty()) document.buffers.emplace_back();
  for (const char* list : grownLists)
    if (Json& value = document.json[list]; !value.is_array()) value = Json::array();
}

std::size_t Builder::add(const Column& column, Use use) {
  Json& accessors = document_.json["accessors"];
  accessors.push_back(Json::object());
  set(accessors.size() - 1, column, use);
  return accessors.size() - 1;
}

void Builder::set(std::size_t index, const Column& column, Use use) {
  Json& accessor = document_.json["accessors"][index];
  leaveViews(accessor);
  for (const char* key : {"bufferView", "byteOffset", "normalized", "min", "max", "sparse"})
    accessor.erase(key);
  accessor["componentType"] = static_cast<int>(column.type);
  accessor["count"] = column.count();
  accessor["type"] = shapeOf(column.width);
  if (column.normalized) accessor["normalized"] = true;
  if (column.bounded) setBounds(accessor, column);
  sound_ = sound_ && column.sound;

  if (use != Use::morphs) return setDense(accessor, column, use);
  const std::vector<double> rows = rowsThatAreNotZero(column);
  const std::size_t sparse =
      rows.size() * (column.elementSize() + sizeOf(typeOfIndices(column.count())));
  if (rows.empty()) return;  // an accessor without data is all zeros
  const std::size_t dense = column.count() * strideOf(column.elementSize());
  if (sparse + sparseOverhead < dense)
    setSparse(accessor, column, rows);
  else
    setDense(accessor, column, use);
}

void Builder::leaveViews(const Json& accessor) {
  const auto leave = [&](const Json* holder) {
    const auto view =
        holder ? findIndex(*holder, "bufferView", document_.views.size()) : std::nullopt;
    if (view) left_.push_back(*view);
  };
  leave(&accessor);
  if (const Json* const sparse = find(accessor, "sparse"))
    for (const char* part : {"indices", "values"}) leave(find(*sparse, part));
}

std::vector<bool> Builder::leftViews() const {
  std::vector<bool> left(document_.views.size());
  for (const std::size_t view : left_) left[view] = true;
  return left;
}

void Builder::setDense(Json& accessor, const Column& column, Use use) {
  const bool perVertex = use == Use::vertices || use == Use::morphs;
  const std::size_t size = column.elementSize();
  const std::size_t stride = perVertex ? strideOf(size) : size;
  const int target = perVertex ? vertexBuffer : use == Use::indices ? indexBuffer : 0;
  if (stride == size) {
    accessor["bufferView"] = addView(column.bytes, 0, target);
    return;
  }
  std::string padded;
  padded.reserve(column.count() * stride);
  for (std::size_t row = 0; row < column.count(); ++row) {
    padded.append(column.bytes, row * size, size);
    padded.append(stride - size, '\0');
  }
  accessor["bufferView"] = addView(padded, stride, target);
}

void Builder::setSparse(Json& accessor, const Column& column, std::span<const double> rows) {
  if (sparseIndices_.empty()) {
    // Reserves their places in the list; their contents are known only at the end.
    sparseIndexView_ = addView({}, 0, 0);
    sparseValueView_ = addView({}, 0, 0);
  }
  const Component type = typeOfIndices(column.count());
  const std::size_t size = column.elementSize();
  align(sparseIndices_, 4);
  align(sparseValues_, 4);
  accessor["sparse"] = {
      {"count", rows.size()},
      {"indices",
       {{"bufferView", sparseIndexView_},
        {"byteOffset", sparseIndices_.size()},
        {"componentType", static_cast<int>(type)}}},
      {"values", {{"bufferView", sparseValueView_}, {"byteOffset", sparseValues_.size()}}}};
  sparseIndices_ += pack(rows, 1, type).bytes;
  for (const double row : rows)
    sparseValues_.append(column.bytes, static_cast<std::size_t>(row) * size, size);
}

std::size_t Builder::addView(std::string_view bytes, std::size_t stride, int target) {
  std::string& buffer = document_.buffers[0];
  align(buffer, 4);
  const BufferView view{0, buffer.size(), bytes.size(), stride};
  Json json{{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.length}};
  if (stride != 0) json["byteStride"] = stride;
  if (target != 0) json["target"] = target;
  Json& views = document_.json["bufferViews"];
  views.push_back(std::move(json));
  document_.views.push_back(view);
  buffer += bytes;
  return views.size() - 1;
}

void Builder::finish() {
  std::string& buffer = document_.buffers[0];
  const auto fill = [&](std::size_t index, const std::string& bytes) {
    align(buffer, 4);
    Json& json = document_.json["bufferViews"][index];
    json["byteOffset"] = buffer.size();
    json["byteLength"] = bytes.size();
    document_.views[index] = {0, buffer.size(), bytes.size(), 0};
    buffer += bytes;
  };
  if (!sparseIndices_.empty()) {
    fill(sparseIndexView_, sparseIndices_);
    fill(sparseValueView_, sparseValues_);
  }
  align(buffer, 4);
  for (const char* list : grownLists)
    if (document_.json[list].empty()) document_.json.erase(list);
}

std::size_t Builder::size() const {
  return document_.buffers[0].size() + sparseIndices_.size() + sparseValues_.size();
}

}  // namespace sweepface::gltf
