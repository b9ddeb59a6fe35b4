#include "usd/prim_names.hpp"

#include <fmt/format.h>

namespace sweepface::usd {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::string PrimNames::take(std::string_view wanted) {
  std::string name;
  if (wanted.empty() || isDigit(wanted.front())) name = "_";
  for (const char c : wanted) name += isLetter(c) || isDigit(c) ? c : '_';
  std::string free = name;
  for (int k = 2; !taken_.insert(free).second; ++k) free = fmt::format("{}_{}", name, k);
  return free;
}

}  // namespace sweepface::usd
