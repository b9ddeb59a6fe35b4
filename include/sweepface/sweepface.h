/* Plays .sweep faces from C, or from whatever can call C. See docs/c-interface.md.
 *
 * A rig is what a file holds; a mesh is its surface at one level of detail; a face is one set of
 * weights on a mesh; a motion moves weights. What is made from something keeps it alive: handles
 * may be freed in any order, on any thread, and NULL may be freed. Rigs change only in calls that
 * take one that is not const (loading targets, following, dividing, turning eyes), beside which
 * nothing else may use the rig; apart from that rigs and meshes may be read by any number of
 * threads. A face or a motion belongs to one thread at a time. Faces may be evaluated whatever is
 * done with their rig.
 *
 * A function that can fail returns a status; sweepface_message() then has one sentence about it,
 * and what was to be written is untouched. Others answer 0 or NULL where there is nothing. Where
 * memory runs out the program ends: C++ must not catch what is thrown then. */
#ifndef SWEEPFACE_SWEEPFACE_H
#define SWEEPFACE_SWEEPFACE_H

#include <stddef.h>
#include <stdint.h>

/* The version of this header. Functions are only added while the major number stays (from 1.0 on;
 * before, while the minor number stays). */
#define SWEEPFACE_VERSION_MAJOR 0
#define SWEEPFACE_VERSION_MINOR 1
#define SWEEPFACE_VERSION_PATCH 0
/* The same as sweepface_version() tells it. */
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
  SWEEPFACE_BAD_DATA = 1,    /* bytes that are no sound .sweep file, or need more memory than they
                                may have; the message says which */
  SWEEPFACE_BAD_ARGUMENT = 2 /* something asked for that there is not, or a number out of range */
};

/* The version of the library: major * 10000 + minor * 100 + patch. */
SWEEPFACE_API uint32_t sweepface_version(void);

/* Why the last failing call on this thread failed: one sentence in UTF-8, in which names stand as
 * they were given, of its first 2,047 bytes, valid until the next fails. Empty if none has. */
SWEEPFACE_API const char* sweepface_message(void);

/* ---- Rigs ---- */

/* Reads a .sweep file from memory, which may be reused afterwards. Any bytes are safe. `name` is
 * what messages call it; NULL: "The face". */
SWEEPFACE_API sweepface_status sweepface_rig_load(const void* bytes, size_t size, const char* name,
                                                  sweepface_rig** rig);
/* The same in two steps, so that a face shows before it can move. The first reads all but what
 * the targets of a packed file do, about half of it: until the second every weight stays 0. The second
 * does nothing where all is read. Meanwhile faces of the rig may be evaluated, but neither their
 * weights set nor meshes prepared or made into shader tables. What follows weights and how eyes turn
 * is said before there are meshes, and needs targets: those that showed the neutral are freed first. */
SWEEPFACE_API sweepface_status sweepface_rig_load_neutral(const void* bytes, size_t size,
                                                          const char* name, sweepface_rig** rig);
SWEEPFACE_API sweepface_status sweepface_rig_load_targets(sweepface_rig* rig);
/* All at once, within so many bytes of memory, about: a file that needs more is refused. What is
 * still takes hardly any bytes, so that a small file may ask for much; the others let it have 2 GiB.
 * Meshes, and looking for eyes, take theirs besides, some 600 bytes a vertex, of 2^24 at most. */
SWEEPFACE_API sweepface_status sweepface_rig_load_within(const void* bytes, size_t size,
                                                         const char* name, size_t memory,
                                                         sweepface_rig** rig);
SWEEPFACE_API void sweepface_rig_free(sweepface_rig* rig);

/* The expressions; names are UTF-8 and belong to the rig. */
SWEEPFACE_API uint32_t sweepface_rig_target_count(const sweepface_rig* rig);
SWEEPFACE_API const char* sweepface_rig_target_name(const sweepface_rig* rig, uint32_t target);
/* The target of a name; where there is none, the message says which there are. */
SWEEPFACE_API sweepface_status sweepface_rig_find_target(const sweepface_rig* rig, const char* name,
                                                         uint32_t* target);

/* The targets that a tracker's name drives, as in clips (docs/clips.md): EyeBlinkLeft eyeBlink_L,
 * browInnerUp those of both sides. Writes the first `room` and answers how many there are. */
SWEEPFACE_API uint32_t sweepface_rig_match_targets(const sweepface_rig* rig, const char* name,
                                                   uint32_t* targets, uint32_t room);

/* How many targets turn about something that the file tells: the jaw about its hinge, lids about
 * the eyeball. */
SWEEPFACE_API uint32_t sweepface_rig_turn_count(const sweepface_rig* rig);

/* Weights that follow from those that are set (docs/arcs.md), in all meshes of the rig: it is said
 * while there are none. */
enum sweepface_followings {
  SWEEPFACE_ARCS = 1,   /* targets that turn go on arcs instead of straight lines */
  SWEEPFACE_COMBINE = 2 /* A_B goes by the product of A and B, A_50 stands in for A at 0.5: what is
                           set for them counts for nothing */
};
/* `what` is a sum of the above; 0: none, as after loading. */
SWEEPFACE_API sweepface_status sweepface_rig_follow(sweepface_rig* rig, uint32_t what);

/* The corners of the box round the neutral's vertices, also those of no face, in model units: zeros if
 * it has no vertex, or more than a mesh may have. Between vertices, and so in finer meshes, the surface
 * may bulge beyond it by some hundredths of an edge, and expressions reach beyond it. */
SWEEPFACE_API void sweepface_rig_box(const sweepface_rig* rig, double low[3], double high[3]);

/* How far any source vertex may be off in any expression, in model units. What is played may be off
 * by sweepface_face_error more. */
SWEEPFACE_API double sweepface_rig_tolerance(const sweepface_rig* rig);

/* ---- Meshes ---- */

/* The arrays that a mesh tells are its own, and stay while it does. */

/* The finest level of detail. */
#define SWEEPFACE_MOST_LOD 64

/* The surface at a level of detail: 0 for the source's own vertices and polygons, N for every edge
 * of the source cut into N. */
SWEEPFACE_API sweepface_status sweepface_mesh_create(const sweepface_rig* rig, uint32_t lod,
                                                     sweepface_mesh** mesh);
/* What a level of detail may cost or must reach, in the neutral. Edges of the source are cut into 64
 * at most, even where that is too few for a length or an error. */
typedef int32_t sweepface_budget;
enum sweepface_budgets {
  SWEEPFACE_BUDGET_EDGE_LENGTH = 0, /* no curve has a segment longer than this, in model units;
                                       diagonals of what lies between curves may be longer */
  SWEEPFACE_BUDGET_ERROR = 1,       /* edges of triangles are no further than this from the surface,
                                       in model units, nearly everywhere (docs/evaluation.md) */
  SWEEPFACE_BUDGET_VERTICES = 2     /* as near to the surface as so many points allow; vertices are
                                       more, as they are copies of points, too */
};

/* The surface as fine as a budget asks, curve by curve: without a crack, and with the same points
 * in the same order every time. A pixel is 2 * distance * tan(field of view / 2) / height in size.
 */
SWEEPFACE_API sweepface_status sweepface_mesh_create_within(const sweepface_rig* rig,
                                                            sweepface_budget budget, double value,
                                                            sweepface_mesh** mesh);
/* The points of the surface that lie nearest to given ones in the neutral [count x 3, model units],
 * for what is attached to a face: glasses, jewels, hair. They have no triangles; with normals and
 * tangents (sweepface_face_tangents), which go along the surface's own lines here, each is a frame
 * that moves with the skin. Takes some 70 us a point on a face of 11,000 vertices. */
SWEEPFACE_API sweepface_status sweepface_mesh_create_at(const sweepface_rig* rig,
                                                        const double* points, size_t count,
                                                        sweepface_mesh** mesh);
SWEEPFACE_API void sweepface_mesh_free(sweepface_mesh* mesh);

/* Makes what moves the mesh, and with `normals` what moves its normals, now rather than when a face
 * with a weight other than 0 is first evaluated: that takes some 60 ms for 11,000 vertices and
 * 57 targets. */
SWEEPFACE_API sweepface_status sweepface_mesh_prepare(const sweepface_mesh* mesh, int32_t normals);

/* Vertices are points first (lod 0: the source's vertices in their order) and then copies of points
 * that have several texture coordinates, or where mirrored ones meet others: tangents differ. */
SWEEPFACE_API uint32_t sweepface_mesh_point_count(const sweepface_mesh* mesh);
SWEEPFACE_API uint32_t sweepface_mesh_vertex_count(const sweepface_mesh* mesh);

/* [vertices - points] the point that each of the other vertices repeats, or NULL. */
SWEEPFACE_API const uint32_t* sweepface_mesh_copies(const sweepface_mesh* mesh);

/* Where the first `count` points lie among the source's vertices, those of lod 0: between four, or
 * fewer, of which `shares` add up to 1 [count x 4 each]. For what hangs on the source's vertices and is
 * to follow to a level of detail: skin weights, colours. Shares above 0 come first; of a share of 0 the
 * vertex is the first one again. Takes a while, and allocates. */
SWEEPFACE_API sweepface_status sweepface_mesh_origins(const sweepface_mesh* mesh, size_t count,
                                                      uint32_t* vertices, float* shares);

/* [triangles x 3] vertices, counter-clockwise seen from outside; those of a material together. */
SWEEPFACE_API uint32_t sweepface_mesh_triangle_count(const sweepface_mesh* mesh);
SWEEPFACE_API const uint32_t* sweepface_mesh_triangles(const sweepface_mesh* mesh);

/* [vertices x 2] u to the right and v upwards, or NULL if the source had none. */
SWEEPFACE_API const float* sweepface_mesh_texcoords(const sweepface_mesh* mesh);

/* Triangles of one material. */
typedef struct sweepface_part {
  const char* material; /* UTF-8; "" if the source named none. Belongs to the mesh. */
  uint32_t first_triangle;
  uint32_t triangle_count;
} sweepface_part;

SWEEPFACE_API uint32_t sweepface_mesh_part_count(const sweepface_mesh* mesh);
SWEEPFACE_API sweepface_status sweepface_mesh_part(const sweepface_mesh* mesh, uint32_t part,
                                                   sweepface_part* out);

/* ---- Faces ---- */

/* All weights are 0: the neutral. */
SWEEPFACE_API sweepface_status sweepface_face_create(const sweepface_mesh* mesh,
                                                     sweepface_face** face);
SWEEPFACE_API void sweepface_face_free(sweepface_face* face);

/* Weights are numbers between -SWEEPFACE_MOST_WEIGHT and it; 0 is without, 1 is all of it. */
#define SWEEPFACE_MOST_WEIGHT 1e6

SWEEPFACE_API sweepface_status sweepface_face_set_weight(sweepface_face* face, uint32_t target,
                                                         double weight);
/* The first `count` weights. */
SWEEPFACE_API sweepface_status sweepface_face_set_weights(sweepface_face* face,
                                                          const double* weights, size_t count);
/* [targets] the weights as they are; the face's own memory. Where the mesh is divided into regions
 * (sweepface_mesh_region_count in sweepface_regions.h): [regions x targets]. */
SWEEPFACE_API const double* sweepface_face_weights(const sweepface_face* face);

/* How far any vertex may be from the exact surface under the weights as they are, in model units:
 * three tenths of the rig's tolerance (or 1e-5 of the neutral's diagonal, if that is more) for every
 * target of weight 1, in a divided face for every such target of every region, and rounding, which
 * grows with how far all targets together can move a place: of hundreds it is the larger part. Not
 * for every frame: it allocates. */
SWEEPFACE_API double sweepface_face_error(const sweepface_face* face);

/* Where to write an array of three floats a vertex, or of four for tangents. The outputs of one call
 * may be parts of the same structs, but not lie over each other. */
typedef struct sweepface_vectors {
  float* data;   /* NULL: not wanted */
  size_t stride; /* bytes from one vertex to the next, 12 (of four floats 16) to 2^30 even where data
                    is NULL; 0: one behind the other */
} sweepface_vectors;

/* Positions in model units and unit normals of the first `count` vertices under the face's weights.
 * Allocates nothing once the mesh is prepared. Seen through floats, the points of a mesh are free
 * of cracks. Vertices that repeat points are read from where these were written: into memory that is
 * slow to read write the points alone, and repeat them as sweepface_mesh_copies tells. */
SWEEPFACE_API sweepface_status sweepface_face_evaluate(sweepface_face* face, size_t count,
                                                       sweepface_vectors positions,
                                                       sweepface_vectors normals);
/* The same, with the same result, where each output still holds what the last call for this face
 * wrote there: only what weights have moved since is written again. It remembers three places of each
 * output, for buffers in turn; one in another place, of another stride or count is written in full. */
SWEEPFACE_API sweepface_status sweepface_face_update(sweepface_face* face, size_t count,
                                                     sweepface_vectors positions,
                                                     sweepface_vectors normals);

/* ---- Tangents ---- */

/* Makes what moves tangents and the normals that go with them, now rather than when they are first
 * asked for: that takes as long as sweepface_mesh_prepare with normals. Fails where the mesh has
 * triangles but no texture coordinates. */
SWEEPFACE_API sweepface_status sweepface_mesh_prepare_tangents(const sweepface_mesh* mesh);

/* What normal maps are relative to, at the first `count` vertices under the face's weights: unit
 * normals, and tangents of four floats (a stride of 0 is 16 bytes, the least). x, y and z are the
 * direction along u of the texture coordinates into which the surface takes MikkTSpace's tangent of
 * the neutral, of unit length and perpendicular to the normal; w is 1 or -1: w * cross(normal,
 * tangent) goes along v, upwards. These normals are as near to the surface's own as those of
 * sweepface_face_evaluate, but not the same: where the skin folds sharply they may be tens of
 * degrees apart, so take all from here. Allocates nothing once tangents are prepared. Fails where
 * the mesh has triangles but no texture coordinates. */
SWEEPFACE_API sweepface_status sweepface_face_tangents(sweepface_face* face, size_t count,
                                                       sweepface_vectors normals,
                                                       sweepface_vectors tangents);

/* ---- Shaders ---- */

/* A mesh as a vertex shader evaluates it (docs/evaluation.md). Row r of point p is
 *   neutral[p][r] + factor * scale *
 *     (sum over t < texels, k < 4 of basis[first + r * texels + t][k] * modes[at + 4 * t + k])
 * where places[p] is first, then at * 64 + texels, then the bits of the float scale. Positions have
 * one row a point, tangents two: along the sweep and across, whose cross product points outward.
 * Belongs to the mesh. */
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
/* What changes every frame: the modes [count x 4], the fourth number 0, and the factor; `count` is
 * the table's mode_count. */
SWEEPFACE_API sweepface_status sweepface_face_modes(sweepface_face* face, int32_t tangents,
                                                    int16_t* out, size_t count,
                                                    float* factor);

/* ---- Motions ---- */

/* How a weight goes from where it stands, with the velocity it has, to a goal (docs/motion.md). */
typedef int32_t sweepface_drive_kind;
enum sweepface_drive_kinds {
  SWEEPFACE_CUT = 0,              /* is there at once */
  SWEEPFACE_NEWTON = 1,           /* a constant force, arriving at speed */
  SWEEPFACE_LINEAR_FORCE = 2,     /* a force linear in time, arriving at rest */
  SWEEPFACE_ACCELERATE_BRAKE = 3, /* one constant force, then another, arriving at rest */
  SWEEPFACE_SPRING = 4,           /* pulled by a spring with a damper */
  SWEEPFACE_BOUNCE = 5            /* a constant force, then bounces */
};

typedef struct sweepface_drive {
  sweepface_drive_kind kind;
  double delay;       /* seconds before it sets out; what waits for that gives way to the next */
  double seconds;     /* until it arrives; not for CUT and SPRING */
  double turn;        /* ACCELERATE_BRAKE: when the second force takes over, as a fraction */
  double frequency;   /* SPRING: oscillations a second if there were no damper */
  double damping;     /* SPRING: below 1 it overshoots, above it creeps */
  double restitution; /* BOUNCE: the share of the speed that is left, in [0, 1 - 1e-9] */
} sweepface_drive;

/* A drive with the usual numbers, to be changed from there; of an unknown kind: a spring. */
SWEEPFACE_API sweepface_drive sweepface_drive_of(sweepface_drive_kind kind);

/* `count` weights at rest. Afterwards nothing allocates. */
SWEEPFACE_API sweepface_status sweepface_motion_create(const double* weights, size_t count,
                                                       sweepface_motion** motion);
/* Another in the same state, which goes on by itself: to look ahead, or to come back to it. */
SWEEPFACE_API sweepface_status sweepface_motion_copy(const sweepface_motion* motion,
                                                     sweepface_motion** copy);
SWEEPFACE_API void sweepface_motion_free(sweepface_motion* motion);

/* Lets time pass; negative, not a number or more than 1e10 seconds at once: none. */
SWEEPFACE_API void sweepface_motion_advance(sweepface_motion* motion, double seconds);

/* Sends one weight or all of them to goals. `drive` may be NULL: a critically damped spring. */
SWEEPFACE_API sweepface_status sweepface_motion_move_to(sweepface_motion* motion, uint32_t weight,
                                                        double goal, const sweepface_drive* drive);
SWEEPFACE_API sweepface_status sweepface_motion_move_all(sweepface_motion* motion,
                                                         const double* goals, size_t count,
                                                         const sweepface_drive* drive);
/* A blow: adds to a weight's velocity (per second), which drag (per second) then takes away. Where
 * it leads, as where a goal or a start is, may be beyond what a face takes (SWEEPFACE_MOST_WEIGHT):
 * the velocity over the drag, and without drag any distance. */
SWEEPFACE_API sweepface_status sweepface_motion_push(sweepface_motion* motion, uint32_t weight,
                                                     double velocity_change, double drag);

/* The first `count` weights or velocities. */
SWEEPFACE_API sweepface_status sweepface_motion_positions(const sweepface_motion* motion,
                                                          double* out, size_t count);
SWEEPFACE_API sweepface_status sweepface_motion_velocities(const sweepface_motion* motion,
                                                           double* out, size_t count);
/* 1 while any weight waits to set out, or may yet be further than `tolerance` from where it comes to
 * rest (0.001 is less than anyone sees), then 0: nothing is to be evaluated until something new is
 * asked of the motion. */
SWEEPFACE_API int32_t sweepface_motion_moves(const sweepface_motion* motion, double tolerance);

#ifdef __cplusplus
}
#endif

#endif
