#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Whether the use of an accessor in a part counts, given the attribute's name, or "indices", and
/// the JSON that refers to it.
using CountsInParts = std::function<bool(std::string_view, const Json&)>;

/// [accessors] whether something uses each. Attributes and indices of parts count if `counts` says
/// so; everything else always does.
std::vector<bool> usedAccessors(const Document& document, const Parts& parts,
                                const CountsInParts& counts);

/// [accessors] how often each is referred to.
std::vector<std::size_t> accessorUseCounts(const Document& document);

/// Checks that every reference to an accessor names one that exists: otherwise it would come to
/// name one that is added later.
Result<void> checkAccessorUses(const Document& document);

}  // namespace sweepface::gltf
