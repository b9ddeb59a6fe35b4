#include <string_view>

#include "sweepface/codec.hpp"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

sweepface_status sweepface_rig_load(const void* bytes, size_t size, const char* name,
                                    sweepface_rig** rig) {
  if (!rig || (!bytes && size > 0)) return refuse("Loading a rig needs bytes and a place for it.");
  Result<Rig> decoded = decode({static_cast<const char*>(bytes), size}, name ? name : "The face");
  if (!decoded) return refuse(SWEEPFACE_BAD_DATA, std::move(decoded.error().message));
  *rig = new sweepface_rig{std::make_shared<const Rig>(std::move(*decoded))};
  return SWEEPFACE_OK;
}

void sweepface_rig_free(sweepface_rig* rig) { delete rig; }

uint32_t sweepface_rig_target_count(const sweepface_rig* rig) {
  return rig ? static_cast<uint32_t>(rig->rig->targets.size()) : 0;
}

const char* sweepface_rig_target_name(const sweepface_rig* rig, uint32_t target) {
  if (target >= sweepface_rig_target_count(rig)) return nullptr;
  return rig->rig->targets[target].name.c_str();
}

sweepface_status sweepface_rig_find_target(const sweepface_rig* rig, const char* name,
                                           uint32_t* target) {
  if (!rig || !name || !target) return refuse("Finding a target needs a rig, a name and a place.");
  Result<Index> found = findTarget(*rig->rig, name);
  if (!found) return refuse(sentence(std::move(found.error().message)));
  *target = static_cast<uint32_t>(*found);
  return SWEEPFACE_OK;
}

double sweepface_rig_tolerance(const sweepface_rig* rig) { return rig ? rig->rig->tolerance : 0; }
