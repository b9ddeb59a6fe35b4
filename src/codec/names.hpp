#pragma once

#include "sweepface/rig.hpp"

#include "codec/reader.hpp"
#include "codec/writer.hpp"

namespace sweepface::codec {

bool hasNames(const Names& names);
void writeNames(Writer& out, const Names& names);
/// Complains where two of the names are the same, unless they are empty; `what` they name.
void refuseTwins(Reader& in, std::vector<std::string_view> names, const char* what);
/// As many names of a kind as the wireframe has things, or none; no two the same.
Names readNames(Reader& in, const Wireframe& wireframe);

}  // namespace sweepface::codec
