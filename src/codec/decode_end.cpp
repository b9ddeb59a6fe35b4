#include "codec/decoding.hpp"
#include "codec/names.hpp"

namespace sweepface::codec {

void readEnd(Decoding& d, Reader& in) {
  std::vector<std::string_view> names;
  for (const Target& target : d.rig->targets) names.push_back(target.name);
  refuseTwins(in, std::move(names), "targets");
  if (d.rig->targets.size() < d.targets) in.refuse("targets are missing");
  for (const Target& target : d.rig->targets)
    if (!d.targetsToCome && target.difference.size() != d.stored)
      in.refuse("the targets' vectors are missing");
  if (d.rig->source.loose.size() != d.loose) in.refuse("the loose vertices are missing");
}

}  // namespace sweepface::codec
