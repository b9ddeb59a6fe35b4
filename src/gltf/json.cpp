#include "gltf/json.hpp"

#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "io/json_text.hpp"

namespace sweepface::gltf {
namespace {

// Members are searched linearly, so an object with very many would take very long.
constexpr std::size_t deepest = 128, mostMembers = 4096;

/// Refuses a text, JSON or not, that would keep the parser busy.
Result<void> checkNesting(std::string_view text) {
  std::vector<std::size_t> members;  // of each enclosing object
  Result<void> result;
  io::scanJson(text, [&](std::size_t at) {
    const char c = text[at];
    if ((c == '[' || c == '{') && members.size() == deepest)
      result = fail(
          fmt::format("its JSON is nested deeper than {} levels; export the file again.", deepest));
    else if (c == '[' || c == '{')
      members.push_back(0);
    if ((c == ']' || c == '}') && !members.empty()) members.pop_back();
    if (c == ':' && !members.empty() && ++members.back() > mostMembers)
      result =
          fail(fmt::format("its JSON has an object of more than {} members; export the file "
                           "again.",
                           mostMembers));
    return result.has_value();
  });
  return result;
}

const Json& emptyArray() {
  static const Json empty = Json::array();
  return empty;
}
const Json& emptyObject() {
  static const Json empty = Json::object();
  return empty;
}

/// A whole number below 2^53, however it is written; where sizes have 32 bits, below 2^31, which is
/// beyond all files, so that two can be added.
std::optional<std::size_t> asSize(const Json& value) {
  constexpr double beyond = sizeof(std::size_t) < 8 ? 0x1p31 : 0x1p53;
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0 && number < beyond) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::size_t>(number);
}

}  // namespace

Result<Json> parseJson(std::string_view text) {
  if (auto ok = checkNesting(text); !ok) return std::unexpected(ok.error());
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) return fail("its JSON is not an object; export the file again.");
    return json;
  } catch (const Json::parse_error& error) {
    return fail("its JSON, " + io::whereNoJson(text, error.byte));
  } catch (const Json::out_of_range&) {
    return fail("its JSON has a number that is too large to be held; export the file again.");
  }
}

const Json& listOf(const Json& gltf, std::string_view key) {
  const Json* const list = find(gltf, key);
  return list && list->is_array() ? *list : emptyArray();
}

std::optional<std::size_t> asIndex(const Json& value, std::size_t count) {
  const auto index = asSize(value);
  return index && *index < count ? index : std::nullopt;
}

std::optional<std::size_t> findIndex(const Json& object, std::string_view key, std::size_t count) {
  const Json* const value = find(object, key);
  return value ? asIndex(*value, count) : std::nullopt;
}

Members::Members(const Json& object, std::string place)
    : object_(object), place_(std::move(place)) {
  if (!object.is_object()) refuse("it is not an object");
}

void Members::refuse(std::string_view fault, std::string_view advice) {
  if (ok()) problem_ = fmt::format("{}: {}; {}.", place_, fault, advice);
}

const Json* Members::required(std::string_view key) {
  const Json* const value = find(object_, key);
  if (!value) refuse(quoted(key) + " is missing");
  return ok() ? value : nullptr;
}

std::size_t Members::size(std::string_view key) {
  const Json* const value = required(key);
  if (!value) return 0;
  const auto number = asSize(*value);
  if (!number) refuse(quoted(key) + " is not a whole number");
  return number.value_or(0);
}

std::size_t Members::size(std::string_view key, std::size_t absent) {
  return has(key) ? size(key) : absent;
}

std::size_t Members::index(std::string_view key, std::size_t count, std::string_view things) {
  const std::size_t number = size(key);
  if (ok() && number >= count)
    refuse(fmt::format("'{}' is {}, but the file has {} {}", key, number, count, things));
  return ok() ? number : 0;
}

std::optional<std::size_t> Members::optionalIndex(std::string_view key, std::size_t count,
                                                  std::string_view things) {
  if (!has(key)) return std::nullopt;
  const std::size_t number = index(key, count, things);
  return ok() ? std::optional(number) : std::nullopt;
}

double Members::number(std::string_view key, double absent) {
  if (!has(key)) return absent;
  const Json* const value = required(key);
  if (value && !value->is_number()) refuse(quoted(key) + " is not a number");
  return ok() ? value->get<double>() : absent;
}

bool Members::flag(std::string_view key) {
  if (!has(key)) return false;
  const Json* const value = required(key);
  if (value && !value->is_boolean()) refuse(quoted(key) + " is neither true nor false");
  return ok() && value->get<bool>();
}

std::string_view Members::text(std::string_view key) {
  if (!has(key)) return {};
  const Json* const value = required(key);
  if (value && !value->is_string()) refuse(quoted(key) + " is not a text");
  return ok() ? std::string_view(value->get_ref<const std::string&>()) : std::string_view();
}

const Json& Members::object(std::string_view key) {
  if (!has(key)) return emptyObject();
  const Json* const value = required(key);
  if (value && !value->is_object()) refuse(quoted(key) + " is not an object");
  return ok() ? *value : emptyObject();
}

const Json& Members::array(std::string_view key) {
  if (!has(key)) return emptyArray();
  const Json* const value = required(key);
  if (value && !value->is_array()) refuse(quoted(key) + " is not a list");
  return ok() ? *value : emptyArray();
}

}  // namespace sweepface::gltf
