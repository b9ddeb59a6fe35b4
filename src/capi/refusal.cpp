#include "capi/message.hpp"

namespace sweepface::capi {

sweepface_status refuseWith(std::initializer_list<TextPart> parts) { return refuseCallWith(parts); }

}  // namespace sweepface::capi
