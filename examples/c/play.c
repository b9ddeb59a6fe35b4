/* Moves one expression of a face by a spring and prints how the face follows.
 * Usage: play FACE.sweep EXPRESSION */
#include <math.h>

#define PROGRAM "play"
#include "example.h"

/* The largest distance of a vertex from where it rested. */
static double largest_distance(const float* a, const float* b, uint32_t vertices) {
  double largest = 0;
  for (uint32_t v = 0; v < vertices; ++v) {
    double square = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const double d = (double)a[3 * v + k] - b[3 * v + k];
      square += d * d;
    }
    largest = fmax(largest, sqrt(square));
  }
  return largest;
}

static int play(sweepface_face* face, sweepface_motion* motion, uint32_t target, uint32_t vertices,
                float* rest, float* now) {
  const sweepface_vectors unwanted = {NULL, 0}, to_rest = {rest, 0}, to_now = {now, 0};
  if (sweepface_face_evaluate(face, vertices, to_rest, unwanted)) return refused();

  sweepface_drive spring = sweepface_drive_of(SWEEPFACE_SPRING);
  spring.frequency = 1.5;
  spring.damping = 0.4;
  if (sweepface_motion_move_to(motion, 0, 1, &spring)) return refused();
  for (int frame = 0; frame <= 30; ++frame) {
    double weight[1];
    if (sweepface_motion_positions(motion, weight, 1)) return refused();
    if (sweepface_face_set_weight(face, target, weight[0])) return refused();
    if (sweepface_face_evaluate(face, vertices, to_now, unwanted)) return refused();
    printf("%4.2f s  weight %6.3f  moved %7.4f  ", frame / 30.0, weight[0],
           largest_distance(now, rest, vertices));
    for (int k = 0; k < (int)(40 * weight[0]); ++k) putchar('#');
    putchar('\n');
    sweepface_motion_advance(motion, 1 / 30.0);
  }
  return EXIT_SUCCESS;
}

int main(int count, char** arguments) {
  if (count != 3) return fail("give a .sweep file and the name of an expression.");
  size_t size = 0;
  char* bytes = read_file(arguments[1], &size);
  if (!bytes) return fail("the file cannot be read.");
  sweepface_rig* rig = NULL;
  const sweepface_status loaded = sweepface_rig_load(bytes, size, arguments[1], &rig);
  free(bytes);
  if (loaded) return refused();

  uint32_t target = 0;
  sweepface_mesh* mesh = NULL;
  sweepface_face* face = NULL;
  sweepface_motion* motion = NULL;
  const double rest[1] = {0};
  if (sweepface_rig_find_target(rig, arguments[2], &target) ||
      sweepface_mesh_create(rig, 0, &mesh) || sweepface_face_create(mesh, &face) ||
      sweepface_motion_create(rest, 1, &motion))
    return refused();
  const uint32_t vertices = sweepface_mesh_point_count(mesh);
  printf("%u vertices, %u triangles, %u expressions\n", vertices,
         sweepface_mesh_triangle_count(mesh), sweepface_rig_target_count(rig));

  float* positions = malloc(2 * 3 * sizeof(float) * (vertices ? vertices : 1));
  const int result =
      positions ? play(face, motion, target, vertices, positions, positions + 3 * (size_t)vertices)
                : fail("there is not enough memory.");
  free(positions);
  sweepface_motion_free(motion);
  sweepface_face_free(face);
  sweepface_mesh_free(mesh);
  sweepface_rig_free(rig);
  return result;
}
