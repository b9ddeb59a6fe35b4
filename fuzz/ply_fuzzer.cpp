#include "mesh_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sweepface;
  const std::string_view text = fuzzing::asText(data, size);
  const auto mesh = parsePly(text, "input.ply");
  fuzzing::requireSound(mesh);
  fuzzing::requireTarget(mesh, io::parsePlyTarget(text, "input.ply"));
  return 0;
}
