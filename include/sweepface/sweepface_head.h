/* Eyes and heads that turn (docs/eyes.md). What sweepface.h says holds here as well. */
#ifndef SWEEPFACE_SWEEPFACE_HEAD_H
#define SWEEPFACE_SWEEPFACE_HEAD_H

#include "sweepface/sweepface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Angles in radians, right-handed: yaw about y, positive to the face's left; pitch about x,
 * positive down; roll about z, positive to its right. */
typedef struct sweepface_angles {
  double yaw, pitch, roll;
} sweepface_angles;

typedef struct sweepface_pose {
  sweepface_angles head, left_eye, right_eye;
} sweepface_pose;

/* Writes x, y, z and w of the quaternion that turns the model by these angles: Ry * Rx * Rz. They
 * must be finite. */
SWEEPFACE_API void sweepface_rotation(const sweepface_angles* angles, double quaternion[4]);

/* Makes eyeballs turn rigidly about their centres from now on. Call it before the rig has meshes,
 * and after sweepface_rig_follow. Writes the number of eyeballs, which may be 0. */
SWEEPFACE_API sweepface_status sweepface_rig_turn_eyes(sweepface_rig* rig, uint32_t* eyes);
/* Turns the eyes to these angles, whatever the head does; NULL, as at the start: by the weights of
 * eyeLook targets. Does nothing if no eyes turn. */
SWEEPFACE_API sweepface_status sweepface_face_look(sweepface_face* face,
                                                   const sweepface_pose* pose);

#ifdef __cplusplus
}
#endif

#endif
