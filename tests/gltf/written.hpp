#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"

#include "faces.hpp"
#include "gltf/glb.hpp"
#include "gltf/scene.hpp"

// Reads written GLBs independently of the library, by the glTF specification alone.
namespace sweepface::testing {

class Written {
 public:
  explicit Written(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, &bytes.at(at + 3) - 3, 4);
      return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    EXPECT_EQ(word(12) % 4, 0u);
    json = Json::parse(bytes.substr(20, word(12)));
    const std::size_t start = 20 + word(12);
    if (start == bytes.size()) return;
    EXPECT_EQ(bytes.substr(start + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(word(start) % 4, 0u);
    binary = bytes.substr(start + 8, word(start));
  }

  Json json;
  std::string binary;

  const Json& accessor(std::size_t number) const { return json.at("accessors").at(number); }
  const Json& primitive(std::size_t mesh = 0, std::size_t number = 0) const {
    return json.at("meshes").at(mesh).at("primitives").at(number);
  }
  std::size_t attribute(const char* name, std::size_t mesh = 0, std::size_t number = 0) const {
    return primitive(mesh, number).at("attributes").at(name).get<std::size_t>();
  }
  std::size_t morph(std::size_t target, const char* name = "POSITION", std::size_t mesh = 0,
                    std::size_t number = 0) const {
    return primitive(mesh, number).at("targets").at(target).at(name).get<std::size_t>();
  }
  bool isSparse(std::size_t number) const { return accessor(number).contains("sparse"); }
  bool hasData(std::size_t number) const {
    return isSparse(number) || accessor(number).contains("bufferView");
  }

  /// The components of all elements as they are stored.
  std::vector<double> stored(std::size_t number) const {
    const Json& a = accessor(number);
    const std::size_t width = widthOf(a), size = width * sizeOf(a), count = a.at("count");
    std::vector<double> values(count * width, 0.0);
    if (a.contains("bufferView")) {
      const Json& view = json.at("bufferViews").at(a["bufferView"].get<std::size_t>());
      const std::size_t stride = view.value("byteStride", size);
      for (std::size_t k = 0; k < count; ++k)
        read(a, start(a) + k * stride, &values[k * width], width);
    }
    if (a.contains("sparse")) {
      const Json& sparse = a["sparse"];
      const Json& indices = sparse.at("indices");
      for (std::size_t k = 0; k < sparse.at("count").get<std::size_t>(); ++k) {
        double row = 0;
        read(indices, start(indices) + k * sizeOf(indices), &row, 1);
        read(a, start(sparse.at("values")) + k * size,
             &values.at(static_cast<std::size_t>(row) * width), width);
      }
    }
    return values;
  }

  /// Their values, with normalized integers decoded.
  std::vector<double> numbers(std::size_t number) const {
    std::vector<double> values = stored(number);
    if (!accessor(number).value("normalized", false)) return values;
    const double one =
        std::map<int, double>{{5120, 127}, {5121, 255}, {5122, 32767}, {5123, 65535}}.at(
            accessor(number).at("componentType"));
    for (double& value : values) value = std::max(value / one, -1.0);
    return values;
  }
  std::vector<Vec3> vectors(std::size_t number) const {
    EXPECT_EQ(accessor(number).at("type"), "VEC3");
    const std::vector<double> values = numbers(number);
    std::vector<Vec3> list;
    for (std::size_t k = 0; k + 2 < values.size(); k += 3)
      list.push_back({values[k], values[k + 1], values[k + 2]});
    return list;
  }
  std::vector<Index> indices(std::size_t mesh = 0, std::size_t number = 0) const {
    const auto values = numbers(primitive(mesh, number).at("indices").get<std::size_t>());
    return {values.begin(), values.end()};
  }

  /// The bytes that an accessor without sparse values covers.
  std::string raw(std::size_t number) const {
    const Json& a = accessor(number);
    const Json& view = json.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    const std::size_t size = widthOf(a) * sizeOf(a), stride = view.value("byteStride", size);
    return binary.substr(start(a), (a.at("count").get<std::size_t>() - 1) * stride + size);
  }

 private:
  static std::size_t widthOf(const Json& a) {
    return std::map<std::string, std::size_t>{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}
        .at(a.at("type").get<std::string>());
  }
  static std::size_t sizeOf(const Json& a) {
    const int type = a.at("componentType");
    return type < 5122 ? 1 : type < 5124 ? 2 : 4;
  }
  /// Where the data of an accessor, or of a part of a sparse one, begin.
  std::size_t start(const Json& holder) const {
    const Json& view = json.at("bufferViews").at(holder.at("bufferView").get<std::size_t>());
    return view.value("byteOffset", std::size_t{0}) + holder.value("byteOffset", std::size_t{0});
  }

  void read(const Json& a, std::size_t at, double* values, std::size_t width) const {
    const auto each = [&]<typename T>(T) {
      for (std::size_t k = 0; k < width; ++k) {
        T value{};
        std::memcpy(&value, &binary.at(at + (k + 1) * sizeof(T) - 1) - (sizeof(T) - 1), sizeof(T));
        values[k] = static_cast<double>(value);
      }
    };
    switch (a.at("componentType").get<int>()) {
      case 5120:
        return each(std::int8_t{});
      case 5121:
        return each(std::uint8_t{});
      case 5122:
        return each(std::int16_t{});
      case 5123:
        return each(std::uint16_t{});
      case 5125:
        return each(std::uint32_t{});
      default:
        return each(float{});
    }
  }
};

/// A sampler of an animation (glTF 2.0, appendix C).
class Sampler {
 public:
  Sampler(const Written& glb, const Json& animation, std::size_t number) {
    const Json& sampler = animation["samplers"][number];
    times_ = glb.numbers(sampler["input"].get<std::size_t>());
    output_ = glb.numbers(sampler["output"].get<std::size_t>());
    cubic_ = sampler["interpolation"] == "CUBICSPLINE";
    width_ = output_.size() / times_.size() / (cubic_ ? 3 : 1);
  }

  /// Its values at a time.
  std::vector<double> at(double time) const {
    time = std::clamp(time, times_.front(), times_.back());
    const auto next = std::lower_bound(times_.begin() + 1, times_.end() - 1, time);
    const auto k = static_cast<std::size_t>(next - times_.begin()) - 1;
    const double td = times_[k + 1] - times_[k], t = (time - times_[k]) / td;
    std::vector<double> values;
    for (std::size_t w = 0; w < width_; ++w)
      values.push_back(cubic_ ? cubic(k, w, td, t) : std::lerp(part(k, w), part(k + 1, w), t));
    return values;
  }

 private:
  double part(std::size_t row, std::size_t w) const { return output_[row * width_ + w]; }
  double cubic(std::size_t k, std::size_t w, double td, double t) const {
    const double v0 = part(3 * k + 1, w), b0 = part(3 * k + 2, w);
    const double a1 = part(3 * k + 3, w), v1 = part(3 * k + 4, w);
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * v0 + td * (t3 - 2 * t2 + t) * b0 + (-2 * t3 + 3 * t2) * v1 +
           td * (t3 - t2) * a1;
  }

  std::vector<double> times_, output_;
  std::size_t width_ = 0;
  bool cubic_ = false;
};

/// The values of a sampler at a time.
inline std::vector<double> evaluate(const Written& glb, const Json& animation, std::size_t sampler,
                                    double time) {
  return Sampler(glb, animation, sampler).at(time);
}

inline Written write(const Rig& rig, const GlbOptions& options = {}) {
  const Result<std::string> bytes = formatGlb(rig, options);
  if (bytes) return Written(*bytes);
  ADD_FAILURE() << bytes.error().message;
  return Written(gltf::formatContainer(Json::object(), {}));
}

inline Rig converted(const MeshRig& source, double tolerance = 0.05) {
  ConvertOptions options;
  options.tolerance = tolerance;
  auto conversion = convert(source, options);
  if (conversion) return std::move(conversion->rig);
  ADD_FAILURE() << conversion.error().message;
  return {};
}
/// A face read from a GLB, with its scene.
inline Rig converted(const Glb& glb, double tolerance = 0.05) {
  RigSource source = read(glb);
  Rig rig = converted(source.rig, tolerance);
  rig.scene = std::move(source.scene);
  return rig;
}

/// The GLB of a rig's scene.
inline Written sceneOf(const Rig& rig) { return Written(gltf::glbOf(rig.scene).value()); }

/// The surface at the vertices of the source.
inline std::vector<Vec3> surfacePositions(const Rig& rig, const Weights& weights = {}) {
  return sourcePositions(rig, Tessellation(rig.surface, 1), blend(rig, weights), weights);
}
inline std::vector<Vec3> surfaceNormals(const Rig& rig, const Weights& weights = {}) {
  return sourceNormals(rig, Tessellation(rig.surface, 1), blend(rig, weights));
}
inline Weights oneTarget(const Rig& rig, std::size_t target) {
  Weights weights(rig.targets.size(), 0.0);
  weights[target] = 1;
  return weights;
}

inline double largest(const std::vector<Vec3>& list) {
  double most = 0;
  for (const Vec3& v : list) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most;
}

inline void expectNear(const std::vector<Vec3>& found, const std::vector<Vec3>& expected,
                       double within = 1e-12) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v)
    ASSERT_LE(norm(found[v] - expected[v]), within) << "vertex " << v;
}
/// Equal within the single precision of numbers as large as theirs.
inline void expectSingle(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  expectNear(found, expected, 2 * largest(expected) / (1 << 24));
}

}  // namespace sweepface::testing
