/* Faces divided into regions, parts that are heavier or stiffer than the rest or move later, each
 * with weights of its own (docs/regions.md). What sweepface.h says holds here as well. */
#ifndef SWEEPFACE_SWEEPFACE_REGIONS_H
#define SWEEPFACE_SWEEPFACE_REGIONS_H

#include "sweepface/sweepface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Painting ---- */

/* Where a part of the face is (docs/regions.md): everything that is named, and what is not far from
 * that. Arrays that are not wanted are NULL and 0. */
typedef struct sweepface_brush {
  const char* const* parts; /* materials and groups of the source */
  size_t part_count;
  const double* points; /* [point_count x 3] places, each by itself, in model units */
  size_t point_count;
  const double* line; /* [line_count x 3] a line through these places */
  size_t line_count;
  const char* const* curves; /* of the wireframe, by name or number */
  size_t curve_count;
  const char* const* nodes; /* single nodes, by name or number, and their very shares */
  const double* node_shares;
  size_t node_count;
  double whole;          /* all of it up to this distance */
  double fade;           /* and from there less and less over so much more */
  int32_t through_space; /* distances through the air instead of along the surface */
} sweepface_brush;

/* Shares are numbers from 0 to 1 that say how much of each node of the wireframe belongs to a
 * region. */
SWEEPFACE_API uint32_t sweepface_rig_node_count(const sweepface_rig* rig);
/* Writes the shares of what a brush paints, [nodes]; or of `bands` > 1 neighbouring bands, the
 * first being what it takes wholly and the last what lies beyond its fade, [bands x nodes]. `count`
 * is how many numbers fit. */
SWEEPFACE_API sweepface_status sweepface_rig_paint(const sweepface_rig* rig,
                                                   const sweepface_brush* brush, uint32_t bands,
                                                   double* shares, size_t count);
/* How many regions a face may have, "rest" included. */
#define SWEEPFACE_MOST_REGIONS 32
/* Divides the face into regions with weights of their own, for meshes made from now on: `count`
 * painted ones, shares [count x nodes], of which overlapping ones get less in proportion, behind a
 * first one, "rest" ("rest_" beside one of that name), of what is left, if anything is: find a
 * region's number by its name. Vertices of no face go with the first region. 0: one region again,
 * as after loading. */
SWEEPFACE_API sweepface_status sweepface_rig_divide(sweepface_rig* rig, const char* const* names,
                                                    const double* shares, size_t count);
/* 1 and NULL where the face is not divided. Names belong to the rig until it is next divided. */
SWEEPFACE_API uint32_t sweepface_rig_region_count(const sweepface_rig* rig);
SWEEPFACE_API const char* sweepface_rig_region_name(const sweepface_rig* rig, uint32_t region);
/* Those that a mesh was made with, and its faces have weights for. */
SWEEPFACE_API uint32_t sweepface_mesh_region_count(const sweepface_mesh* mesh);

/* ---- Weights ---- */

/* The first `count` weights in one region alone; sweepface_face_set_weights sets them in all. */
SWEEPFACE_API sweepface_status sweepface_face_set_region_weights(sweepface_face* face,
                                                                 uint32_t region,
                                                                 const double* weights,
                                                                 size_t count);

/* How a region moves: how heavy and how stiff it is compared with the rest, 1, from 0.0001 to 10,000,
 * and how many seconds later it sets out, up to 60. */
typedef struct sweepface_matter {
  double mass;
  double stiffness;
  double delay;
} sweepface_matter;

/* Like sweepface_motion_create, for every region, [regions] matters: what moves a weight moves it
 * in all, each by its own matter. Positions and velocities are then [regions x count]. */
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
