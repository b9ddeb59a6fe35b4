/* Divides faces into regions: parts that are heavier or stiffer than the rest or move later, each
 * with weights of its own (docs/regions.md). What sweepface.h says holds here as well. */
#ifndef SWEEPFACE_SWEEPFACE_REGIONS_H
#define SWEEPFACE_SWEEPFACE_REGIONS_H

#include "sweepface/sweepface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Painting ---- */

/* Where a part of the face is (docs/regions.md): everything that is named, and what is near it.
 * Unused arrays are NULL with a count of 0. */
typedef struct sweepface_brush {
  const char* const* parts; /* materials and groups of the source */
  size_t part_count;
  const double* points; /* [point_count x 3] separate places, in model units */
  size_t point_count;
  const double* line; /* [line_count x 3] a line through these places */
  size_t line_count;
  const char* const* curves; /* of the wireframe, by name or number */
  size_t curve_count;
  const char* const* nodes; /* single nodes, by name or number, with the exact shares they get */
  const double* node_shares;
  size_t node_count;
  double whole;          /* all of the surface up to this distance */
  double fade;           /* beyond that, less and less over this much more */
  int32_t through_space; /* distances straight through space, not along the surface */
} sweepface_brush;

/* Shares are numbers from 0 to 1 that say how much of each node of the wireframe belongs to a
 * region. */
SWEEPFACE_API uint32_t sweepface_rig_node_count(const sweepface_rig* rig);
/* Writes the shares of what a brush paints, [nodes]. With `bands` > 1 writes those of neighbouring
 * bands, [bands x nodes]: the first is what the brush takes wholly, the last what lies beyond its
 * fade. `count` is how many numbers `shares` has room for. */
SWEEPFACE_API sweepface_status sweepface_rig_paint(const sweepface_rig* rig,
                                                   const sweepface_brush* brush, uint32_t bands,
                                                   double* shares, size_t count);
/* How many regions a face may have, "rest" included. */
#define SWEEPFACE_MOST_REGIONS 32
/* Divides the face into `count` painted regions with weights of their own, shares [count x nodes],
 * for meshes made from now on. Where regions overlap, each gets less in proportion. If anything is
 * left, it becomes an additional first region, "rest" ("rest_" beside one of that name), so find a
 * region's number by its name. Vertices of no face go with the first region. With a `count` of 0
 * the face is one region again, as after loading. */
SWEEPFACE_API sweepface_status sweepface_rig_divide(sweepface_rig* rig, const char* const* names,
                                                    const double* shares, size_t count);
/* 1 and NULL if the face is not divided. Names belong to the rig until it is next divided. */
SWEEPFACE_API uint32_t sweepface_rig_region_count(const sweepface_rig* rig);
SWEEPFACE_API const char* sweepface_rig_region_name(const sweepface_rig* rig, uint32_t region);
/* The number of regions that a mesh was made with, for which its faces have weights. */
SWEEPFACE_API uint32_t sweepface_mesh_region_count(const sweepface_mesh* mesh);

/* ---- Weights ---- */

/* Sets the first `count` weights in one region alone; sweepface_face_set_weights sets them in
 * all. */
SWEEPFACE_API sweepface_status sweepface_face_set_region_weights(sweepface_face* face,
                                                                 uint32_t region,
                                                                 const double* weights,
                                                                 size_t count);

/* How a region moves: its mass and stiffness relative to the rest (which has 1), from 0.0001 to
 * 10,000, and how many seconds later it sets out, up to 60. */
typedef struct sweepface_matter {
  double mass;
  double stiffness;
  double delay;
} sweepface_matter;

/* Like sweepface_motion_create, for regions with these matters [regions]: what moves a weight moves
 * it in all regions, in each by its own matter. Positions and velocities are then [regions x
 * count]. */
SWEEPFACE_API sweepface_status sweepface_motion_create_regions(const double* weights, size_t count,
                                                               const sweepface_matter* matters,
                                                               size_t regions,
                                                               sweepface_motion** motion);
/* Sends a weight to a goal in one region alone; or puts it there at once, without the delay. */
SWEEPFACE_API sweepface_status sweepface_motion_move_in(sweepface_motion* motion, uint32_t region,
                                                        uint32_t weight, double goal,
                                                        const sweepface_drive* drive);
SWEEPFACE_API sweepface_status sweepface_motion_put_in(sweepface_motion* motion, uint32_t region,
                                                       uint32_t weight, double value);

#ifdef __cplusplus
}
#endif

#endif
