#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::usd {

struct ArchiveFile {
  std::string_view name, bytes;
};

/// A ZIP archive of files as they are, without compression, each at a multiple of 64 bytes, as USDZ
/// asks. Fails if it outgrows the 4 GiB of a ZIP.
Result<std::string> archive(std::span<const ArchiveFile> files);

}  // namespace sweepface::usd
