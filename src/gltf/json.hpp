#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::gltf {

/// Members stay in the order in which they were read.
using Json = nlohmann::ordered_json;

/// Parses a JSON text. Unbounded nesting and objects are refused before they can cost stack or
/// time.
Result<Json> parseJson(std::string_view text);

/// The member of an object, or null if it has none or is not an object.
inline const Json* find(const Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}
inline Json* find(Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// A list of an object of a glTF, e.g. "accessors"; empty if there is none.
const Json& listOf(const Json& gltf, std::string_view key);

/// Reads an object of a glTF. The first fault sticks: from then on everything reads as absent or
/// zero, so callers need ok() only before they trust what they have read.
class Members {
 public:
  /// Messages begin with the place, e.g. "accessor 5".
  Members(const Json& object, std::string place);

  bool ok() const { return problem_.empty(); }
  std::unexpected<Error> error() const { return fail(problem_); }
  /// Fails with "place: fault; advice.", unless something has failed before.
  void refuse(std::string_view fault, std::string_view advice = "export the file again");
  const std::string& place() const { return place_; }

  bool has(std::string_view key) const { return find(object_, key) != nullptr; }
  /// A whole number.
  std::size_t size(std::string_view key);
  std::size_t size(std::string_view key, std::size_t absent);
  /// A whole number below `count`, the index of one of `things`, e.g. "accessors".
  std::size_t index(std::string_view key, std::size_t count, std::string_view things);
  std::optional<std::size_t> optionalIndex(std::string_view key, std::size_t count,
                                           std::string_view things);
  double number(std::string_view key, double absent);
  bool flag(std::string_view key);
  std::string_view text(std::string_view key);  ///< empty where absent
  const Json& object(std::string_view key);     ///< empty where absent
  const Json& array(std::string_view key);      ///< empty where absent
  /// Exactly N numbers, or nothing where absent.
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(std::string_view key) {
    const Json& list = array(key);
    if (!ok() || !has(key)) return std::nullopt;
    std::array<double, N> values{};
    bool whole = list.size() == N;
    for (std::size_t k = 0; whole && k < N; ++k) {
      whole = list[k].is_number();
      if (whole) values[k] = list[k].get<double>();
    }
    if (whole) return values;
    refuse(quoted(key) + " is not a list of " + std::to_string(N) + " numbers");
    return std::nullopt;
  }

 private:
  static std::string quoted(std::string_view key) { return "'" + std::string(key) + "'"; }
  const Json* required(std::string_view key);

  const Json& object_;
  std::string place_, problem_;
};

/// The value as an index below `count`, if it is one.
std::optional<std::size_t> asIndex(const Json& value, std::size_t count);
/// The same for the member of an object.
std::optional<std::size_t> findIndex(const Json& object, std::string_view key, std::size_t count);

}  // namespace sweepface::gltf
