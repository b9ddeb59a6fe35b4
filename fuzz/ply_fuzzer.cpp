#include "mesh_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sweepface;
  fuzzing::requireSound(parsePly(fuzzing::asText(data, size), "input.ply"));
  return 0;
}
