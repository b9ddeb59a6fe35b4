#pragma once

#include <algorithm>
#include <string>
#include <string_view>

// What files may be called here.
namespace sweepface::cli {

/// As file systems compare names: those of Windows ignore case.
inline std::string asCompared(std::string name) {
#ifdef _WIN32
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
#endif
  return name;
}

inline bool isForbiddenInFileNames(char c) {
#ifdef _WIN32
  return std::string_view(R"(/\:*?"<>|)").contains(c) || (c >= 0 && c < ' ');
#else
  return c == '/';
#endif
}

/// Whether a name is a device's, with any ending, as CON.obj is on Windows.
inline bool isDeviceName([[maybe_unused]] std::string_view name) {
#ifdef _WIN32
  const std::string stem = asCompared(std::string(name.substr(0, name.find('.'))));
  const std::string_view kind = std::string_view(stem).substr(0, 3);
  const bool isNumbered = stem.size() == 4 && stem[3] >= '0' && stem[3] <= '9';
  return stem == "con" || stem == "prn" || stem == "aux" || stem == "nul" ||
         (isNumbered && (kind == "com" || kind == "lpt"));
#else
  return false;
#endif
}

inline bool mayBeFileName(std::string_view name) {
  return std::ranges::none_of(name, isForbiddenInFileNames) && !isDeviceName(name);
}

}  // namespace sweepface::cli
