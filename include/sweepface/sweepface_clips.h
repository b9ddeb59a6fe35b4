/* Clips for faces (docs/clips.md). Clips are other programs' files, so these functions are part of
 * the library that converts: link sweepface::convert. What sweepface.h says holds here as well. */
#ifndef SWEEPFACE_SWEEPFACE_CLIPS_H
#define SWEEPFACE_SWEEPFACE_CLIPS_H

#include "sweepface/sweepface_head.h"
#include "sweepface/sweepface_regions.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Regions as text ---- */

/* Divides the face by the `regions` of a JSON text, which may be a timeline (docs/regions.md), for
 * meshes made from now on. If the text has none, the face is one region again. `name` is what
 * messages call the text; NULL: "The text". */
SWEEPFACE_API sweepface_status sweepface_rig_divide_by(sweepface_rig* rig, const void* text,
                                                       size_t size, const char* name);
/* How a region moves: as that text says, or else {1, 1, 0}. */
SWEEPFACE_API sweepface_status sweepface_rig_region_matter(const sweepface_rig* rig,
                                                           uint32_t region,
                                                           sweepface_matter* matter);

/* ---- Clips ---- */

/* Weights over time for the targets of a rig. Never changes: any number of threads may
 * read it. */
typedef struct sweepface_clip sweepface_clip;

/* How a clip is read; timelines ignore all of it, and others what is not for their kind. */
typedef struct sweepface_clip_options {
  double frames_per_second; /* of a CSV's timecodes; 0: as these tell, or else 60. Required for
                               MediaPipe frames without times */
  int32_t smooth;           /* removes a tracker's noise, by the one-euro filter */
  double frequency;         /* of the spring on which heavy regions hang; */
  double damping;           /* of the same spring; both 0: the defaults */
  const char* animation;    /* the name of an animation in a .glb; NULL: the first that has
                               weights */
  const char* names;        /* a JSON text, ended by 0, that maps names of the clip to targets
                               called otherwise (docs/clips.md); NULL: no mapping */
} sweepface_clip_options;

/* The default options. */
SWEEPFACE_API sweepface_clip_options sweepface_clip_usual_options(void);

/* Reads a clip from memory, which may be reused afterwards: a CSV of Live Link Face, a JSON of
 * MediaPipe or Audio2Face, a timeline (JSON) or an animation of a .glb that has weights; told apart
 * by their content. Names are matched with the rig's targets. It is an error if none matches,
 * unless all are angles of the head and the eyes. Regions of a timeline's own count only if
 * sweepface_rig_divide_by() has divided the rig by it before. `options` may be NULL; `name` is what
 * messages call it, NULL or empty: "The clip". */
SWEEPFACE_API sweepface_status sweepface_clip_read(const sweepface_rig* rig, const void* bytes,
                                                   size_t size, const char* name,
                                                   const sweepface_clip_options* options,
                                                   sweepface_clip** clip);
SWEEPFACE_API void sweepface_clip_free(sweepface_clip* clip);

SWEEPFACE_API double sweepface_clip_seconds(const sweepface_clip* clip);
/* Names of the clip that drive no target, and targets that nothing drives, counted from 0; NULL
 * after the last. They belong to the clip. Angles of the head and the eyes are in neither list. */
SWEEPFACE_API const char* sweepface_clip_unmatched(const sweepface_clip* clip, uint32_t index);
SWEEPFACE_API const char* sweepface_clip_undriven(const sweepface_clip* clip, uint32_t index);
/* What was repaired or may be wrong in the file, in sentences; NULL after the last. */
SWEEPFACE_API const char* sweepface_clip_warning(const sweepface_clip* clip, uint32_t index);

/* How many regions the rig had when the clip was read. */
SWEEPFACE_API uint32_t sweepface_clip_region_count(const sweepface_clip* clip);
/* The weights at a time in seconds after the first frame, linear between frames and held at the
 * ends: the first `count` of [regions x targets]. */
SWEEPFACE_API sweepface_status sweepface_clip_weights(const sweepface_clip* clip, double seconds,
                                                      double* out, size_t count);

/* ---- Eyes and head ---- */

/* Whether a clip has any angles of the head, and whether it has a yaw or pitch of an eye that is
 * ever other than 0: without one, eyes look by their weights. */
SWEEPFACE_API int32_t sweepface_clip_has_head(const sweepface_clip* clip);
SWEEPFACE_API int32_t sweepface_clip_has_eyes(const sweepface_clip* clip);
/* All angles at a time; those that the clip lacks are 0. If the clip has no angles of the eyes,
 * give sweepface_face_look() NULL instead, so that the eyes are not held straight. */
SWEEPFACE_API sweepface_status sweepface_clip_pose(const sweepface_clip* clip, double seconds,
                                                   sweepface_pose* pose);

#ifdef __cplusplus
}
#endif

#endif
