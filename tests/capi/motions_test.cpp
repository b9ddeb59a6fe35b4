#include <gtest/gtest.h>
#include <vector>

#include "sweepface/live_motion.hpp"
#include "sweepface/sweepface.h"

#include "capi/refuses.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Motions : public ::testing::Test {
 protected:
  Motions() {
    const double rest[] = {0, 0.5};
    EXPECT_EQ(sweepface_motion_create(rest, 2, &motion), SWEEPFACE_OK);
  }
  ~Motions() override { sweepface_motion_free(motion); }

  double weight(std::size_t k) {
    double weights[2];
    EXPECT_EQ(sweepface_motion_positions(motion, weights, 2), SWEEPFACE_OK);
    return weights[k];
  }
  double velocity(std::size_t k) {
    double velocities[2];
    EXPECT_EQ(sweepface_motion_velocities(motion, velocities, 2), SWEEPFACE_OK);
    return velocities[k];
  }

  sweepface_motion* motion = nullptr;
};

TEST_F(Motions, GoTheWayOfEveryDrive) {
  for (int32_t kind = SWEEPFACE_CUT; kind <= SWEEPFACE_BOUNCE; ++kind) {
    MotionState expected = MotionState::make(std::vector{0.0, 0.5}).value();
    sweepface_motion* found = nullptr;
    const double rest[] = {0, 0.5};
    ASSERT_EQ(sweepface_motion_create(rest, 2, &found), SWEEPFACE_OK);
    sweepface_drive drive = sweepface_drive_of(kind);
    drive.seconds = 0.7, drive.turn = 0.3, drive.frequency = 3, drive.damping = 0.4;
    drive.restitution = 0.6, drive.delay = 0.1;
    ASSERT_EQ(sweepface_motion_move_to(found, 1, 2, &drive), SWEEPFACE_OK);
    ASSERT_TRUE(
        expected.moveTo(1, 2, {static_cast<Drive::Kind>(kind), 0.7, 0.3, {3, 0.4}, 0.6, 0.1}));
    for (int frame = 0; frame < 30; ++frame) {
      sweepface_motion_advance(found, 0.05);
      expected.advance(0.05);
      double position[2], speed[2];
      ASSERT_EQ(sweepface_motion_positions(found, position, 2), SWEEPFACE_OK);
      ASSERT_EQ(sweepface_motion_velocities(found, speed, 2), SWEEPFACE_OK);
      EXPECT_EQ(position[0], 0);
      EXPECT_EQ(position[1], expected.sample(1).position) << kind;
      EXPECT_EQ(speed[1], expected.sample(1).velocity) << kind;
    }
    sweepface_motion_free(found);
  }
}

TEST_F(Motions, HaveTheLibrarysUsualNumbers) {
  const Drive usual;
  const sweepface_drive drive = sweepface_drive_of(SWEEPFACE_BOUNCE);
  EXPECT_EQ(drive.kind, SWEEPFACE_BOUNCE);
  EXPECT_EQ(drive.delay, usual.delay);
  EXPECT_EQ(drive.seconds, usual.seconds);
  EXPECT_EQ(drive.turn, usual.turn);
  EXPECT_EQ(drive.frequency, usual.spring.frequency);
  EXPECT_EQ(drive.damping, usual.spring.damping);
  EXPECT_EQ(drive.restitution, usual.restitution);
  EXPECT_EQ(sweepface_drive_of(77).kind, SWEEPFACE_SPRING);
}

TEST_F(Motions, MoveAllAtOnceByASpring) {
  const double goals[] = {1, -1};
  ASSERT_EQ(sweepface_motion_move_all(motion, goals, 2, nullptr), SWEEPFACE_OK);
  sweepface_motion_advance(motion, 3);
  EXPECT_NEAR(weight(0), 1, 1e-6);
  EXPECT_NEAR(weight(1), -1, 1e-6);
}

TEST_F(Motions, TakeBlows) {
  ASSERT_EQ(sweepface_motion_push(motion, 0, 2, 1), SWEEPFACE_OK);
  EXPECT_EQ(velocity(0), 2);
  sweepface_motion_advance(motion, 0.5);
  EXPECT_GT(weight(0), 0.5);
  EXPECT_LT(velocity(0), 2);
}

TEST_F(Motions, TellWhetherTheyMove) {
  EXPECT_EQ(sweepface_motion_moves(motion, 0.001), 0);
  ASSERT_EQ(sweepface_motion_move_to(motion, 1, 1, nullptr), SWEEPFACE_OK);
  int frames = 0;
  for (; sweepface_motion_moves(motion, 0.001); ++frames)
    sweepface_motion_advance(motion, 1.0 / 60);
  EXPECT_NEAR(weight(1), 1, 0.001);
  EXPECT_GT(frames, 20);
  EXPECT_LT(frames, 60);
  EXPECT_EQ(sweepface_motion_moves(motion, 1e-9), 1);
}

TEST_F(Motions, AreCopiedWithTheirVelocities) {
  ASSERT_EQ(sweepface_motion_move_to(motion, 0, 1, nullptr), SWEEPFACE_OK);
  sweepface_motion_advance(motion, 0.1);
  sweepface_motion* copy = nullptr;
  ASSERT_EQ(sweepface_motion_copy(motion, &copy), SWEEPFACE_OK);
  sweepface_motion_advance(motion, 0.1);
  const double later = weight(0);
  double of[2];
  ASSERT_EQ(sweepface_motion_positions(copy, of, 2), SWEEPFACE_OK);
  EXPECT_LT(of[0], later);
  sweepface_motion_advance(copy, 0.1);
  ASSERT_EQ(sweepface_motion_positions(copy, of, 2), SWEEPFACE_OK);
  EXPECT_EQ(of[0], later);
  sweepface_motion_free(copy);
}

TEST_F(Motions, RefuseAndChangeNothing) {
  const double goals[] = {1, 2, 3};
  sweepface_drive odd = sweepface_drive_of(SWEEPFACE_NEWTON);
  odd.seconds = -1;
  EXPECT_TRUE(refuses(sweepface_motion_move_to(motion, 0, 1, &odd), "."));
  odd.kind = 6;
  EXPECT_TRUE(refuses(sweepface_motion_move_to(motion, 0, 1, &odd),
                      "There is no drive of kind 6; kinds are 0 to 5."));
  EXPECT_TRUE(refuses(sweepface_motion_move_all(motion, goals, 2, &odd), "no drive of kind 6"));
  EXPECT_TRUE(refuses(sweepface_motion_move_to(motion, 2, 1, nullptr), "There is no weight 2"));
  EXPECT_TRUE(refuses(sweepface_motion_move_all(motion, goals, 3, nullptr), "3 goals for 2"));
  EXPECT_TRUE(refuses(sweepface_motion_push(motion, 2, 1, 1), "There is no weight 2"));
  sweepface_motion_advance(motion, 1);
  EXPECT_EQ(weight(0), 0);
  EXPECT_EQ(weight(1), 0.5);
  double room[3];
  EXPECT_TRUE(refuses(sweepface_motion_positions(motion, room, 3), "only 2 weights, not 3"));
  const double infinite[] = {1e308 * 10};
  sweepface_motion* none = nullptr;
  EXPECT_TRUE(refuses(sweepface_motion_create(infinite, 1, &none), "not a finite number"));
  EXPECT_EQ(none, nullptr);
}

TEST(NoMotion, IsAnAnswer) {
  double room[1];
  sweepface_motion_advance(nullptr, 1);
  EXPECT_EQ(sweepface_motion_moves(nullptr, 0), 0);
  EXPECT_TRUE(refuses(sweepface_motion_move_to(nullptr, 0, 0, nullptr), "needs a motion"));
  EXPECT_TRUE(refuses(sweepface_motion_copy(nullptr, nullptr), "needs one"));
  EXPECT_TRUE(refuses(sweepface_motion_push(nullptr, 0, 0, 0), "needs a motion"));
  EXPECT_TRUE(refuses(sweepface_motion_positions(nullptr, room, 1), "needs one"));
}

}  // namespace
}  // namespace sweepface
