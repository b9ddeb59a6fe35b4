/* Plays .sweep faces from C, or from whatever can call C. See docs/c-interface.md.
 *
 * A rig holds what is in a file; a mesh is its surface at one level of detail; a face is one set of
 * weights on a mesh; a motion moves weights. A handle keeps alive what it was made from, so handles
 * may be freed in any order, on any thread; freeing NULL does nothing. Only calls that take a
 * non-const rig change it (loading targets, following, dividing, turning eyes); nothing else may
 * use the rig during such a call. Otherwise any number of threads may read rigs and meshes. A face
 * or a motion belongs to one thread at a time. Faces may be evaluated whatever is being done with
 * their rig.
 *
 * A function that can fail returns a status; after a failure sweepface_message() returns one
 * sentence about it, and outputs are untouched. Other functions return 0 or NULL where there is
 * nothing. If memory runs out the program ends: C++ must not catch what is thrown then. */
#ifndef SWEEPFACE_SWEEPFACE_H
#define SWEEPFACE_SWEEPFACE_H

#include <stddef.h>
#include <stdint.h>

/* The version of this header. While the major number stays the same (before 1.0: the minor number),
 * functions are only added. */
#define SWEEPFACE_VERSION_MAJOR 0
#define SWEEPFACE_VERSION_MINOR 1
#define SWEEPFACE_VERSION_PATCH 0
/* The same in the form that sweepface_version() returns. */
#define SWEEPFACE_VERSION_NUMBER                                         \
  (SWEEPFACE_VERSION_MAJOR * 10000u + SWEEPFACE_VERSION_MINOR * 100u + \
   SWEEPFACE_VERSION_PATCH)

#ifndef SWEEPFACE_API
#if defined(__GNUC__)
#define SWEEPFACE_API __attribute__((visibility("default")))
#else
#define SWEEPFACE_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sweepface_rig sweepface_rig;
typedef struct sweepface_mesh sweepface_mesh;
typedef struct sweepface_face sweepface_face;
typedef struct sweepface_motion sweepface_motion;

typedef int32_t sweepface_status;
enum sweepface_statuses {
  SWEEPFACE_OK = 0,
  SWEEPFACE_BAD_DATA = 1,    /* not a valid .sweep file, or one that needs more memory than it may
                                use; the message says which */
  SWEEPFACE_BAD_ARGUMENT = 2 /* something that does not exist, or a number out of range */
};

/* The version of the library: major * 10000 + minor * 100 + patch. */
SWEEPFACE_API uint32_t sweepface_version(void);

/* Why the last failing call on this thread failed: one sentence in UTF-8, of at most 2,047 bytes,
 * with names as they were given. Valid until the next call fails; empty if none has. */
SWEEPFACE_API const char* sweepface_message(void);

/* ---- Rigs ---- */

/* Reads a .sweep file from memory, which you may reuse afterwards. Any bytes are safe. `name` is
 * what messages call the file; NULL: "The face". */
SWEEPFACE_API sweepface_status sweepface_rig_load(const void* bytes, size_t size, const char* name,
                                                  sweepface_rig** rig);
/* The same in two steps, so that a face can be shown before it can move. The first leaves out what
 * the targets of a packed file do, about half of the work; until the second, every weight stays 0.
 * The second does nothing if everything has been read. In between, faces of the rig may be
 * evaluated, but their weights cannot be set, nor meshes prepared or made into shader tables.
 * sweepface_rig_follow and sweepface_rig_turn_eyes need targets and a rig without meshes: free the
 * meshes and faces that showed the neutral first. */
SWEEPFACE_API sweepface_status sweepface_rig_load_neutral(const void* bytes, size_t size,
                                                          const char* name, sweepface_rig** rig);
SWEEPFACE_API sweepface_status sweepface_rig_load_targets(sweepface_rig* rig);
/* In one step, within about `memory` bytes: a file that needs more is refused. What does not move
 * takes hardly any bytes in a file, so even a small file may need a lot of memory; the other two
 * functions allow it 2 GiB. Meshes and the search for eyes take some 600 bytes a vertex on top, for
 * at most 2^24 vertices. */
SWEEPFACE_API sweepface_status sweepface_rig_load_within(const void* bytes, size_t size,
                                                         const char* name, size_t memory,
                                                         sweepface_rig** rig);
SWEEPFACE_API void sweepface_rig_free(sweepface_rig* rig);

/* The expressions; names are UTF-8 and belong to the rig. */
SWEEPFACE_API uint32_t sweepface_rig_target_count(const sweepface_rig* rig);
SWEEPFACE_API const char* sweepface_rig_target_name(const sweepface_rig* rig, uint32_t target);
/* The target with this name; if there is none, the message lists the names there are. */
SWEEPFACE_API sweepface_status sweepface_rig_find_target(const sweepface_rig* rig, const char* name,
                                                         uint32_t* target);

/* The targets that a tracker's name drives, as in clips (docs/clips.md): EyeBlinkLeft drives
 * eyeBlink_L, browInnerUp the targets of both sides. Writes the first `room` of them and returns
 * how many there are. */
SWEEPFACE_API uint32_t sweepface_rig_match_targets(const sweepface_rig* rig, const char* name,
                                                   uint32_t* targets, uint32_t room);

/* The number of targets for which the file says what they turn about: the jaw about its hinge, lids
 * about the eyeball. */
SWEEPFACE_API uint32_t sweepface_rig_turn_count(const sweepface_rig* rig);

/* Weights that follow from those you set (docs/arcs.md), in all meshes of the rig. Choose them
 * before the rig has any. */
enum sweepface_followings {
  SWEEPFACE_ARCS = 1,   /* targets that turn move on arcs instead of straight lines */
  SWEEPFACE_COMBINE = 2 /* A_B goes by the product of A and B, A_50 stands in for A at 0.5; weights
                           that you set for A_B and A_50 are ignored */
};
/* `what` is a sum of the above; 0: none, as after loading. Refused beyond 4096 targets. */
SWEEPFACE_API sweepface_status sweepface_rig_follow(sweepface_rig* rig, uint32_t what);

/* The corners of the bounding box of the neutral's vertices, including those of no face, in model
 * units; zeros if there are no vertices, or more than a mesh may have. Between vertices, and so in
 * finer meshes, the surface may bulge beyond the box by some hundredths of an edge. Expressions
 * reach beyond it too. */
SWEEPFACE_API void sweepface_rig_box(const sweepface_rig* rig, double low[3], double high[3]);

/* How far any source vertex may be off in any expression, in model units. Evaluation may add up to
 * sweepface_face_error. */
SWEEPFACE_API double sweepface_rig_tolerance(const sweepface_rig* rig);

/* ---- Meshes ---- */

/* The arrays that a mesh returns belong to it, and are valid as long as it exists. */

/* The finest level of detail. */
#define SWEEPFACE_MOST_LOD 64

/* The surface at a level of detail: 0 for the source's own vertices and polygons, N to cut every
 * edge of the source into N. */
SWEEPFACE_API sweepface_status sweepface_mesh_create(const sweepface_rig* rig, uint32_t lod,
                                                     sweepface_mesh** mesh);
/* What a level of detail may cost or must achieve, measured on the neutral. Edges of the source are
 * cut into 64 at most, even where that is too few for a length or an error. */
typedef int32_t sweepface_budget;
enum sweepface_budgets {
  SWEEPFACE_BUDGET_EDGE_LENGTH = 0, /* no curve has a segment longer than this, in model units;
                                       diagonals between curves may be longer */
  SWEEPFACE_BUDGET_ERROR = 1,       /* edges of triangles are at most this far from the surface, in
                                       model units, nearly everywhere (docs/evaluation.md) */
  SWEEPFACE_BUDGET_VERTICES = 2     /* as close to the surface as this many points allow; there may
                                       be more vertices, as some are copies of points */
};

/* The surface as fine as a budget demands, decided curve by curve. It has no cracks, and the same
 * points in the same order every time. The size of a pixel is
 * 2 * distance * tan(field of view / 2) / height. */
SWEEPFACE_API sweepface_status sweepface_mesh_create_within(const sweepface_rig* rig,
                                                            sweepface_budget budget, double value,
                                                            sweepface_mesh** mesh);
/* The points of the surface nearest to the given ones [count x 3, model units] in the neutral, for
 * things attached to a face: glasses, jewellery, hair. The mesh has no triangles. Together with its
 * normal and tangent (sweepface_face_tangents), which here goes along the surface's own u, each
 * point is a frame that moves with the skin. Takes 20 ms, and 0.1 ms a point, on a face of 11,000
 * vertices: make one mesh of all points. */
SWEEPFACE_API sweepface_status sweepface_mesh_create_at(const sweepface_rig* rig,
                                                        const double* points, size_t count,
                                                        sweepface_mesh** mesh);
SWEEPFACE_API void sweepface_mesh_free(sweepface_mesh* mesh);

/* Builds the tables that move the mesh, and with `normals` those that move its normals, now rather
 * than when a face with a weight other than 0 is first evaluated. Takes some 60 ms for 11,000
 * vertices and 57 targets. */
SWEEPFACE_API sweepface_status sweepface_mesh_prepare(const sweepface_mesh* mesh, int32_t normals);

/* Vertices are first the points (lod 0: the source's vertices in their order), then copies of
 * points that have several texture coordinates, or where mirrored texture coordinates meet others
 * and so tangents differ. */
SWEEPFACE_API uint32_t sweepface_mesh_point_count(const sweepface_mesh* mesh);
SWEEPFACE_API uint32_t sweepface_mesh_vertex_count(const sweepface_mesh* mesh);

/* [vertices - points] the point that each vertex after the points repeats, or NULL. */
SWEEPFACE_API const uint32_t* sweepface_mesh_copies(const sweepface_mesh* mesh);

/* Where the first `count` points lie among the source's vertices (those of lod 0): each is a blend
 * of up to four of them, with `shares` that add up to 1 [count x 4 each]. Use it to carry
 * per-vertex data of the source, such as skin weights or colours, over to a level of detail. Shares
 * above 0 come first; where a share is 0, the vertex repeats the first one. Takes a while, and
 * allocates. */
SWEEPFACE_API sweepface_status sweepface_mesh_origins(const sweepface_mesh* mesh, size_t count,
                                                      uint32_t* vertices, float* shares);

/* [triangles x 3] vertices, counter-clockwise seen from outside, grouped by material. */
SWEEPFACE_API uint32_t sweepface_mesh_triangle_count(const sweepface_mesh* mesh);
SWEEPFACE_API const uint32_t* sweepface_mesh_triangles(const sweepface_mesh* mesh);

/* [vertices x 2] u to the right and v upwards, or NULL if the source had none. */
SWEEPFACE_API const float* sweepface_mesh_texcoords(const sweepface_mesh* mesh);

/* Triangles of one material. */
typedef struct sweepface_part {
  const char* material; /* as the source has it, in general UTF-8; "" if it named none. Belongs to
                           the mesh. */
  uint32_t first_triangle;
  uint32_t triangle_count;
} sweepface_part;

SWEEPFACE_API uint32_t sweepface_mesh_part_count(const sweepface_mesh* mesh);
SWEEPFACE_API sweepface_status sweepface_mesh_part(const sweepface_mesh* mesh, uint32_t part,
                                                   sweepface_part* out);

/* ---- Faces ---- */

/* A new face shows the neutral: all weights are 0. */
SWEEPFACE_API sweepface_status sweepface_face_create(const sweepface_mesh* mesh,
                                                     sweepface_face** face);
SWEEPFACE_API void sweepface_face_free(sweepface_face* face);

/* Weights lie within SWEEPFACE_MOST_WEIGHT of 0: 0 is none of an expression, 1 all of it. */
#define SWEEPFACE_MOST_WEIGHT 1e6

SWEEPFACE_API sweepface_status sweepface_face_set_weight(sweepface_face* face, uint32_t target,
                                                         double weight);
/* Sets the first `count` weights. */
SWEEPFACE_API sweepface_status sweepface_face_set_weights(sweepface_face* face,
                                                          const double* weights, size_t count);
/* [targets] the current weights, in the face's own memory. Where the mesh is divided into regions
 * (sweepface_mesh_region_count in sweepface_regions.h): [regions x targets]. */
SWEEPFACE_API const double* sweepface_face_weights(const sweepface_face* face);

/* How far any vertex may be from the exact surface under the current weights, in model units. Every
 * target of weight 1 (in a divided face, every such target of every region) adds three tenths of
 * the rig's tolerance, or 1e-5 of the neutral's diagonal if that is more. Rounding comes on top: it
 * grows with how far all targets together can move a place, and with hundreds of targets it is the
 * larger part. Not for every frame: it allocates. */
SWEEPFACE_API double sweepface_face_error(const sweepface_face* face);

/* Where to write an array of three floats a vertex, or four for tangents. The outputs of one call
 * may be interleaved in the same structs, but must not overlap. */
typedef struct sweepface_vectors {
  float* data;   /* NULL: not wanted */
  size_t stride; /* bytes from one vertex to the next, 12 (for four floats 16) to 2^30, even if data
                    is NULL; 0: tightly packed */
} sweepface_vectors;

/* Writes positions in model units and unit normals of the first `count` vertices under the face's
 * weights. Allocates nothing once the mesh is prepared. The points of a mesh have no cracks, even
 * in floats. Vertices that repeat points are copied from where the points were written: if that
 * memory is slow to read, write the points alone and repeat them by sweepface_mesh_copies. */
SWEEPFACE_API sweepface_status sweepface_face_evaluate(sweepface_face* face, size_t count,
                                                       sweepface_vectors positions,
                                                       sweepface_vectors normals);
/* The same, with the same result, for outputs that still hold what the last call for this face
 * wrote there: only what the weights have moved since is written again. The face remembers three
 * places of each output, for buffers used in turn; an output at another place, or with another
 * stride or count, is written in full. */
SWEEPFACE_API sweepface_status sweepface_face_update(sweepface_face* face, size_t count,
                                                     sweepface_vectors positions,
                                                     sweepface_vectors normals);

/* The corners of a box around the face under its weights, in model units, for culling: it contains
 * every vertex that an evaluation would write, without evaluating. Where targets move different
 * parts of the face it is larger than needed. The first call for a mesh whose face has a weight
 * other than 0 evaluates every target once, and allocates; further ones do not. Zeros if there are
 * no vertices; infinite where sweepface_face_error is, as of targets that move by 10^30. */
SWEEPFACE_API sweepface_status sweepface_face_box(sweepface_face* face, double low[3],
                                                  double high[3]);

/* ---- Tangents ---- */

/* Builds the tables that move tangents and the normals that go with them, now rather than when they
 * are first asked for. Takes as long as sweepface_mesh_prepare with normals. Fails if the mesh has
 * no texture coordinates, unless it is of points. */
SWEEPFACE_API sweepface_status sweepface_mesh_prepare_tangents(const sweepface_mesh* mesh);

/* Writes the tangent space of normal maps at the first `count` vertices under the face's weights:
 * unit normals, and tangents of four floats (a stride of 0 is 16 bytes, the least). x, y and z are
 * MikkTSpace's tangent of the neutral as the surface carries it along: the direction along u of the
 * texture coordinates, of unit length and perpendicular to the normal. w is 1 or -1:
 * w * cross(normal, tangent) goes along v, upwards. These normals are as close to the surface's own
 * as those of sweepface_face_evaluate, but not the same: where the skin folds sharply they may be
 * tens of degrees apart, so take both from here. Allocates nothing once tangents are prepared.
 * Vertices that repeat points get tangents perpendicular to normals that they share only if both are
 * asked for at once. Fails if the mesh has no texture coordinates, unless it is of points. */
SWEEPFACE_API sweepface_status sweepface_face_tangents(sweepface_face* face, size_t count,
                                                       sweepface_vectors normals,
                                                       sweepface_vectors tangents);

/* ---- Shaders ---- */

/* A mesh as a vertex shader evaluates it (docs/evaluation.md). Row r of point p is
 *   neutral[p][r] + factor * scale *
 *     (sum over t < texels, k < 4 of basis[first + r * texels + t][k] * modes[at + 4 * t + k])
 * where places[p] holds three numbers: first, at * 64 + texels, and the bits of the float scale.
 * Positions have one row a point. Tangents have two, along the sweep and across it; their cross
 * product points outward. Belongs to the mesh. */
typedef struct sweepface_shader_tables {
  const int16_t* basis;   /* [texel_count x 4] */
  const uint32_t* places; /* [points x 3] */
  const float* neutral;   /* [points x rows x 3] */
  uint32_t texel_count;
  uint32_t mode_count;
} sweepface_shader_tables;

SWEEPFACE_API sweepface_status sweepface_mesh_shader_tables(const sweepface_mesh* mesh,
                                                            int32_t tangents,
                                                            sweepface_shader_tables* out);
/* Writes what changes every frame: the modes [count x 4], the fourth number of each 0, and the
 * factor. `count` is the table's mode_count. */
SWEEPFACE_API sweepface_status sweepface_face_modes(sweepface_face* face, int32_t tangents,
                                                    int16_t* out, size_t count,
                                                    float* factor);

/* ---- Motions ---- */

/* How a weight moves to a goal from its current position and velocity (docs/motion.md). */
typedef int32_t sweepface_drive_kind;
enum sweepface_drive_kinds {
  SWEEPFACE_CUT = 0,              /* jumps there at once */
  SWEEPFACE_NEWTON = 1,           /* a constant force, arriving at speed */
  SWEEPFACE_LINEAR_FORCE = 2,     /* a force linear in time, arriving at rest */
  SWEEPFACE_ACCELERATE_BRAKE = 3, /* one constant force, then another, arriving at rest */
  SWEEPFACE_SPRING = 4,           /* pulled by a spring with a damper */
  SWEEPFACE_BOUNCE = 5            /* a constant force, then bounces */
};

typedef struct sweepface_drive {
  sweepface_drive_kind kind;
  double delay;       /* seconds before it sets out; the next drive replaces one that still waits */
  double seconds;     /* until it arrives, BOUNCE: until it first hits; not for CUT and SPRING */
  double turn;        /* ACCELERATE_BRAKE: when the second force takes over, as a fraction of
                         `seconds` */
  double frequency;   /* SPRING: oscillations a second without the damper */
  double damping;     /* SPRING: below 1 it overshoots, above 1 it creeps */
  double restitution; /* BOUNCE: the share of the speed kept at each bounce, in [0, 1 - 1e-9] */
} sweepface_drive;

/* A drive with default numbers, for you to change; for an unknown kind, a spring. */
SWEEPFACE_API sweepface_drive sweepface_drive_of(sweepface_drive_kind kind);

/* A motion of `count` weights at rest. Nothing allocates afterwards. */
SWEEPFACE_API sweepface_status sweepface_motion_create(const double* weights, size_t count,
                                                       sweepface_motion** motion);
/* A second motion in the same state, independent from then on: for looking ahead, or for coming
 * back. */
SWEEPFACE_API sweepface_status sweepface_motion_copy(const sweepface_motion* motion,
                                                     sweepface_motion** copy);
SWEEPFACE_API void sweepface_motion_free(sweepface_motion* motion);

/* Lets time pass: none if `seconds` is negative, not a number or more than 1e10. */
SWEEPFACE_API void sweepface_motion_advance(sweepface_motion* motion, double seconds);

/* Sends one weight or all of them to goals. `drive` may be NULL: a critically damped spring. */
SWEEPFACE_API sweepface_status sweepface_motion_move_to(sweepface_motion* motion, uint32_t weight,
                                                        double goal, const sweepface_drive* drive);
SWEEPFACE_API sweepface_status sweepface_motion_move_all(sweepface_motion* motion,
                                                         const double* goals, size_t count,
                                                         const sweepface_drive* drive);
/* An impulse: adds to a weight's velocity (per second), which drag (per second) then takes away. The
 * weight travels the velocity divided by the drag, or without drag any distance. Where it ends may
 * be beyond what a face accepts (SWEEPFACE_MOST_WEIGHT), as may a goal or a start. */
SWEEPFACE_API sweepface_status sweepface_motion_push(sweepface_motion* motion, uint32_t weight,
                                                     double velocity_change, double drag);

/* Writes the first `count` weights or velocities. */
SWEEPFACE_API sweepface_status sweepface_motion_positions(const sweepface_motion* motion,
                                                          double* out, size_t count);
SWEEPFACE_API sweepface_status sweepface_motion_velocities(const sweepface_motion* motion,
                                                           double* out, size_t count);
/* 1 while any weight waits to set out, or may still be further than `tolerance` from where it comes
 * to rest (0.001 is less than anyone sees). Then 0: there is nothing to evaluate until you ask
 * something new of the motion. */
SWEEPFACE_API int32_t sweepface_motion_moves(const sweepface_motion* motion, double tolerance);

#ifdef __cplusplus
}
#endif

#endif
