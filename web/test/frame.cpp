// Evaluates a face natively, for comparison. Usage: frame FACE LOD WEIGHT... > floats
// Writes positions and then normals of all points, three floats each, and then the error as one.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "sweepface/sweepface.h"

namespace {

std::vector<char> read(const char* path) {
  std::vector<char> bytes;
  if (std::FILE* file = std::fopen(path, "rb")) {
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
      bytes.push_back(static_cast<char>(c));
    std::fclose(file);
  }
  return bytes;
}

bool fails(sweepface_status status) {
  if (status == SWEEPFACE_OK) return false;
  std::fprintf(stderr, "frame: %s\n", sweepface_message());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::vector<char> bytes = read(argv[1]);
  sweepface_rig* rig = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  if (fails(sweepface_rig_load(bytes.data(), bytes.size(), argv[1], &rig)) ||
      fails(sweepface_mesh_create(rig, static_cast<uint32_t>(std::atoi(argv[2])), &mesh)) ||
      fails(sweepface_face_create(mesh, &face)))
    return 1;
  std::vector<double> weights;
  for (int k = 3; k < argc; ++k) weights.push_back(std::strtod(argv[k], nullptr));
  if (fails(sweepface_face_set_weights(face, weights.data(), weights.size()))) return 1;
  const std::size_t points = sweepface_mesh_point_count(mesh);
  std::vector<float> out(6 * points);
  if (fails(sweepface_face_evaluate(face, points, {out.data(), 0}, {out.data() + 3 * points, 0})))
    return 1;
  out.push_back(static_cast<float>(sweepface_face_error(face)));
  return std::fwrite(out.data(), sizeof(float), out.size(), stdout) == out.size() ? 0 : 1;
}
