#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::io {

/// Reads the members of an object of a JSON text; messages say in which file and where.
class JsonFields {
 public:
  using Json = nlohmann::json;

  JsonFields(std::string_view file, const Json& object, std::string place)
      : file_(file), object_(object), place_(std::move(place)) {}

  const Json& json() const { return object_; }

  std::unexpected<Error> fail(std::string_view what) const { return failAt(place_, what); }
  std::unexpected<Error> failAt(std::string_view place, std::string_view what) const {
    return sweepface::fail(fmt::format("{}: {} {}.", file_, place, what));
  }
  /// Passes on an error whose message is a sentence of its own.
  std::unexpected<Error> pass(const Error& error) const {
    return sweepface::fail(fmt::format("{}: {}: {}", file_, place_, error.message));
  }

  /// Checks that this is an object with no other members than these.
  Result<void> isObject(std::initializer_list<std::string_view> keys) const {
    if (!object_.is_object()) return fail("is not an object");
    for (const auto& [key, value] : object_.items())
      if (std::ranges::find(keys, key) == keys.end())
        return fail(fmt::format("has an unknown key '{}'", key));
    return {};
  }

  Result<void> number(const char* key, double& value, bool required = false) const {
    const auto found = object_.find(key);
    if (found == object_.end()) {
      if (required) return fail(fmt::format("has no '{}'", key));
      return {};
    }
    if (!found->is_number()) return fail(fmt::format("has a '{}' that is not a number", key));
    value = found->get<double>();
    return {};
  }

  Result<void> text(const char* key, std::string& value, bool required = false) const {
    const auto found = object_.find(key);
    if (found == object_.end()) {
      if (required) return fail(fmt::format("has no '{}'", key));
      return {};
    }
    if (!found->is_string()) return fail(fmt::format("has a '{}' that is not a text", key));
    value = found->get<std::string>();
    return {};
  }

 private:
  std::string_view file_;
  const Json& object_;
  std::string place_;
};

}  // namespace sweepface::io
