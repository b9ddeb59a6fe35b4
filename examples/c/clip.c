/* Plays a capture on a face: prints what its names drive, and every quarter second the angles of
 * the head and the target with the largest weight.
 * Usage: clip FACE.sweep TAKE.csv|TAKE.json|SCENE.json */
#include "sweepface/sweepface_clips.h"

#define PROGRAM "clip"
#include "example.h"

static void report(const sweepface_clip* clip) {
  for (uint32_t k = 0; sweepface_clip_unmatched(clip, k); ++k)
    printf("%s drives nothing\n", sweepface_clip_unmatched(clip, k));
  uint32_t still = 0;
  while (sweepface_clip_undriven(clip, still)) ++still;
  printf("nothing drives %u of the targets\n", still);
}

static int play(const sweepface_rig* rig, const sweepface_clip* clip, sweepface_face* face,
                double* weights, uint32_t targets) {
  const double seconds = sweepface_clip_seconds(clip), step = 0.25;
  for (int frame = 0; frame * step <= seconds; ++frame) {
    sweepface_pose pose;
    if (sweepface_clip_weights(clip, frame * step, weights, targets) ||
        sweepface_clip_pose(clip, frame * step, &pose) ||
        sweepface_face_set_weights(face, weights, targets) ||
        sweepface_face_look(face, sweepface_clip_has_eyes(clip) ? &pose : NULL))
      return refused();
    uint32_t most = 0;
    for (uint32_t k = 1; k < targets; ++k)
      if (weights[k] > weights[most]) most = k;
    printf("%5.2f s  head %6.3f %6.3f %6.3f  %s %.3f\n", frame * step, pose.head.yaw,
           pose.head.pitch, pose.head.roll, sweepface_rig_target_name(rig, most), weights[most]);
  }
  return EXIT_SUCCESS;
}

int main(int count, char** arguments) {
  if (count != 3) return fail("give a .sweep file and a clip.");
  size_t sizes[2];
  char* files[2];
  for (int k = 0; k < 2; ++k)
    if (!(files[k] = read_file(arguments[k + 1], &sizes[k]))) return fail("a file cannot be read.");

  sweepface_rig* rig = NULL;
  sweepface_mesh* mesh = NULL;
  sweepface_face* face = NULL;
  sweepface_clip* clip = NULL;
  uint32_t eyes = 0;
  if (sweepface_rig_load(files[0], sizes[0], arguments[1], &rig) ||
      sweepface_rig_turn_eyes(rig, &eyes) || sweepface_mesh_create(rig, 0, &mesh) ||
      sweepface_face_create(mesh, &face) ||
      sweepface_clip_read(rig, files[1], sizes[1], arguments[2], NULL, &clip))
    return refused();
  for (int k = 0; k < 2; ++k) free(files[k]);
  printf("%.2f s, %u eyes turn\n", sweepface_clip_seconds(clip), eyes);
  report(clip);

  const uint32_t targets = sweepface_rig_target_count(rig);
  double* weights = malloc(sizeof(double) * (targets ? targets : 1));
  const int result =
      weights ? play(rig, clip, face, weights, targets) : fail("there is not enough memory.");
  free(weights);
  sweepface_clip_free(clip);
  sweepface_face_free(face);
  sweepface_mesh_free(mesh);
  sweepface_rig_free(rig);
  return result;
}
