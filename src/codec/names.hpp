#pragma once

#include "sweepface/rig.hpp"

#include "codec/reader.hpp"
#include "codec/writer.hpp"

namespace sweepface::codec {

bool hasNames(const Names& names);
void writeNames(Writer& out, const Names& names);
/// Refuses duplicate names, except empty ones; `what` are the things they name.
void refuseTwins(Reader& in, std::vector<std::string_view> names, const char* what);
/// For each kind of thing, either a name for each of them in the wireframe or none at all; no two
/// names are the same.
Names readNames(Reader& in, const Wireframe& wireframe);

}  // namespace sweepface::codec
