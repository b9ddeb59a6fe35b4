#include "gltf/resources.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "sweepface/io.hpp"

#include "codec/utf8.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

namespace fs = std::filesystem;

std::optional<int> hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

/// A text with %41 and the like replaced by what they stand for; nothing if one is malformed.
std::optional<std::string> percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '%') {
      decoded += text[k];
      continue;
    }
    const auto high = k + 2 < text.size() ? hexDigit(text[k + 1]) : std::nullopt;
    const auto low = high ? hexDigit(text[k + 2]) : std::nullopt;
    if (!low) return std::nullopt;
    decoded += static_cast<char>(16 * *high + *low);
    k += 2;
  }
  return decoded;
}

std::optional<unsigned> base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return std::nullopt;
}

std::optional<std::string> base64Decoded(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const auto digit = base64Digit(c);
    if (!digit) return std::nullopt;
    bits = (bits << 6 | *digit) & 0xFFFF;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

bool isData(std::string_view uri) { return io::sameLetters(uri.substr(0, 5), "data:"); }

/// data:[<type>][;parameters][;base64],<data>
Result<Resource> decodeData(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos)
    return fail("a data: URI has no comma before its data; export the file again.");
  const std::string_view head = uri.substr(5, comma - 5), data = uri.substr(comma + 1);
  const bool isBase64 = head.ends_with(";base64");
  auto bytes = isBase64 ? base64Decoded(data) : percentDecoded(data);
  if (!bytes)
    return fail(fmt::format("a data: URI is not valid {}; export the file again.",
                            isBase64 ? "base64" : "percent-encoded text"));
  return Resource{std::move(*bytes), std::string(head.substr(0, head.find(';')))};
}

bool hasScheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find_first_of("/?#");
}

/// Whether a path leads only downwards.
bool leadsDown(const fs::path& path) {
  if (path.empty() || path.has_root_path() || !path.has_filename()) return false;
  return std::ranges::none_of(path, [](const fs::path& part) { return part == ".."; });
}

std::unexpected<Error> refuse(std::string_view uri, std::string_view why) {
  return fail(fmt::format("the file {} {}.", io::inQuotes(uri), why));
}

/// The path of the file that a URI names, with links resolved.
Result<fs::path> pathOf(std::string_view uri, const fs::path& folder) {
  const auto decoded = percentDecoded(uri);
  const bool plain =
      decoded && codec::isUtf8(*decoded) && decoded->find_first_of("\\\x7f") == std::string::npos;
  if (hasScheme(uri) || !plain || !leadsDown(utf8Path(*decoded)))
    return refuse(uri,
                  "is not named by a path within the folder of the glTF; put it there and name it "
                  "so");
  if (folder.empty()) return refuse(uri, "is not read here; store everything in one .glb file");
  std::error_code error;
  const fs::path home = fs::canonical(folder, error);
  const fs::path path = error ? fs::path() : fs::canonical(home / utf8Path(*decoded), error);
  if (error)
    return refuse(uri, fmt::format("cannot be read ({}); put it beside the glTF", error.message()));
  const auto [end, unused] = std::mismatch(home.begin(), home.end(), path.begin(), path.end());
  if (end != home.end())
    return refuse(uri, "is a link out of the folder of the glTF; put a copy into the folder");
  return path;
}

Result<Resource> readBeside(std::string_view uri, const fs::path& folder) {
  const auto path = pathOf(uri, folder);
  if (!path) return std::unexpected(path.error());
  std::error_code error;
  if (!fs::is_regular_file(*path, error))
    return refuse(uri, "is not a file; export the glTF again");
  auto bytes = readFile(*path);
  if (!bytes) return refuse(uri, fmt::format("cannot be read; {}", bytes.error().message));
  return Resource{std::move(*bytes), {}};
}

}  // namespace

Result<Resource> fetch(std::string_view uri, const fs::path& folder) {
  return isData(uri) ? decodeData(uri) : readBeside(uri, folder);
}

std::string identityOf(std::string_view uri, const fs::path& folder) {
  const auto path = isData(uri) ? Result<fs::path>(fs::path()) : pathOf(uri, folder);
  return path && !path->empty() ? path->string() : std::string(uri);
}

}  // namespace sweepface::gltf
