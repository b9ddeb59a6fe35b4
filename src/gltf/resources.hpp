#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::gltf {

/// What a URI of a glTF stands for.
struct Resource {
  std::string bytes;
  std::string mimeType;  ///< of a data: URI; empty for files
};

/// The bytes of a data: URI, or of a file in `folder` or below. Everything else is refused: other
/// schemes, absolute paths, paths that lead up and links that lead out. Messages name the URI, not
/// the glTF.
Result<Resource> fetch(std::string_view uri, const std::filesystem::path& folder);

/// A key that is the same for all URIs of one file, however they spell it, and for equal data:
/// URIs.
std::string identityOf(std::string_view uri, const std::filesystem::path& folder);

}  // namespace sweepface::gltf
