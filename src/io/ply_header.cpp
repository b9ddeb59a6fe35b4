#include "io/ply_header.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "io/text.hpp"

namespace sweepface::io {
namespace {

/// Far more than a mesh has; a search goes through all of them.
constexpr std::size_t maxElements = 100, maxProperties = 1000;

std::optional<PlyScalar> scalarNamed(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, PlyScalar>, 16> names{{
      {"char", PlyScalar::int8},
      {"int8", PlyScalar::int8},
      {"uchar", PlyScalar::uint8},
      {"uint8", PlyScalar::uint8},
      {"short", PlyScalar::int16},
      {"int16", PlyScalar::int16},
      {"ushort", PlyScalar::uint16},
      {"uint16", PlyScalar::uint16},
      {"int", PlyScalar::int32},
      {"int32", PlyScalar::int32},
      {"uint", PlyScalar::uint32},
      {"uint32", PlyScalar::uint32},
      {"float", PlyScalar::float32},
      {"float32", PlyScalar::float32},
      {"double", PlyScalar::float64},
      {"float64", PlyScalar::float64},
  }};
  const auto found = std::ranges::find(names, name, &std::pair<std::string_view, PlyScalar>::first);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string_view name)
      : bytes_(bytes),
        name_(name),
        lines_(bytes, bytes.starts_with("ply\r") && !bytes.starts_with("ply\r\n") ? '\r' : '\n') {}

  Result<PlyHeader> read() {
    if (bytes_.empty()) return fail(fmt::format("{} is empty; export the mesh again.", name_));
    if (isUtf16(bytes_))
      return fail(fmt::format("{} is a text in UTF-16; save it in UTF-8.", name_));
    if (!lines_.next() || trimmed(lines_.line()) != "ply")
      return fail(
          fmt::format("{} does not begin with a line 'ply'; check that it is a PLY file.", name_));
    while (lines_.next() && trimmed(lines_.line()) != "end_header")
      if (!readLine()) return std::unexpected(Error{error_});
    if (trimmed(lines_.line()) != "end_header")
      return fail(
          fmt::format("{} ends within its header, at line {}; export the mesh again or copy "
                      "the file again.",
                      name_, lines_.number()));
    if (!hasFormat_)
      return fail(
          fmt::format("{} has no format line in its header; export the mesh again.", name_));
    header_.lineCount = lines_.number();
    header_.byteCount = bytes_.size() - lines_.rest().size();
    header_.lineBreak = lines_.lineBreak();
    return std::move(header_);
  }

 private:
  bool failLine(std::string_view what) {
    error_ = fmt::format("{}, line {}: {}; export the mesh again.", name_, lines_.number(), what);
    return false;
  }

  bool readLine() {
    Words words(lines_.line());
    const std::string_view keyword = words.next();
    if (keyword == "format") return readFormat(words);
    if (keyword == "element") return readElement(words);
    if (keyword == "property") return readProperty(words);
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return true;
    return failLine(fmt::format("the header says {}, which PLY does not know", inQuotes(keyword)));
  }

  bool readFormat(Words& words) {
    const std::string_view format = words.next(), version = words.next();
    if (format == "ascii")
      header_.format = PlyFormat::ascii;
    else if (format == "binary_little_endian")
      header_.format = PlyFormat::littleEndian;
    else if (format == "binary_big_endian")
      header_.format = PlyFormat::bigEndian;
    else
      return failLine(fmt::format("the format {} is unknown", inQuotes(format)));
    if (version != "1.0")
      return failLine(
          fmt::format("the format version {} is unknown, only 1.0 is", inQuotes(version)));
    return hasFormat_ = true;
  }

  bool readElement(Words& words) {
    const std::string_view name = words.next(), count = words.next();
    const auto number = toNumber<std::uint64_t>(count);
    if (!number) return failLine(fmt::format("the element count {} is no count", inQuotes(count)));
    if (header_.find(name))
      return failLine(fmt::format("there is a second element {}", inQuotes(name)));
    if (header_.elements.size() == maxElements)
      return failLine(fmt::format("there are more than {} elements", maxElements));
    header_.elements.push_back({std::string(name), *number, {}});
    return true;
  }

  bool readProperty(Words& words) {
    if (header_.elements.empty()) return failLine("a property comes before any element");
    PlyProperty property;
    std::string_view type = words.next();
    if (type == "list") {
      const std::string_view countType = words.next();
      property.countType = scalarNamed(countType);
      if (!property.countType || !isInteger(*property.countType))
        return failLine(
            fmt::format("the list count type {} is no integer type", inQuotes(countType)));
      type = words.next();
    }
    const auto scalar = scalarNamed(type);
    if (!scalar) return failLine(fmt::format("the property type {} is unknown", inQuotes(type)));
    property.type = *scalar;
    property.name = words.next();
    if (property.name.empty()) return failLine("the property has no name");
    PlyElement& element = header_.elements.back();
    if (element.find({property.name}) >= 0)
      return failLine(fmt::format("there is a second property {} of the element {}",
                                  inQuotes(property.name), inQuotes(element.name)));
    if (element.properties.size() == maxProperties)
      return failLine(fmt::format("the element {} has more than {} properties",
                                  inQuotes(element.name), maxProperties));
    element.properties.push_back(std::move(property));
    return true;
  }

  std::string_view bytes_, name_;
  LineCursor lines_;
  PlyHeader header_;
  bool hasFormat_ = false;
  std::string error_;
};

}  // namespace

Index PlyElement::find(std::initializer_list<std::string_view> names) const {
  const auto found = std::ranges::find_if(properties, [&](const PlyProperty& property) {
    return std::ranges::find(names, property.name) != names.end();
  });
  return found == properties.end() ? -1 : static_cast<Index>(found - properties.begin());
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(elements, name, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

Result<PlyHeader> parsePlyHeader(std::string_view bytes, std::string_view name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace sweepface::io
