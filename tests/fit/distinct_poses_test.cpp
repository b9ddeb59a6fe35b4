#include "fit/distinct_poses.hpp"

#include <gtest/gtest.h>

namespace sweepface {
namespace {

TEST(DistinctPoses, LeaveOutWhatIsTheFirstOnceMore) {
  PoseMatrix all = PoseMatrix::Random(4, 15);
  for (const Index pose : {1, 3}) all.middleCols<3>(3 * pose) = all.leftCols<3>();
  const DistinctPoses poses(all);
  const PoseMatrix distinct = poses.of(all);
  ASSERT_EQ(distinct.cols(), 9);
  for (Index pose = 0; pose < 5; ++pose)
    EXPECT_EQ(distinct.middleCols<3>(poses.column(pose)), all.middleCols<3>(3 * pose)) << pose;
}

TEST(DistinctPoses, KeepWhatDiffersByOneNumber) {
  PoseMatrix all = PoseMatrix::Zero(4, 6);
  all(3, 5) = 1e-300;
  EXPECT_EQ(DistinctPoses(all).of(all), all);
}

}  // namespace
}  // namespace sweepface
