#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/regions.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

// Faces look along +z, +y is up and +x their own left (docs/eyes.md).

/// Angles in radians, right-handed: yaw about y (positive: to the face's left), pitch about x
/// (down), roll about z (to its right). They turn by Ry · Rx · Rz.
struct Angles {
  double yaw = 0, pitch = 0, roll = 0;
  friend bool operator==(const Angles&, const Angles&) = default;
};

/// x, y, z, w of a unit quaternion.
using Quaternion = std::array<double, 4>;
Quaternion quaternionOf(const Angles& angles);
Vec3 turned(const Quaternion& by, const Vec3& v);

/// How a whole model turns about a point.
struct HeadTrack {
  std::vector<double> times;          ///< [F] seconds, increasing
  std::vector<Quaternion> rotations;  ///< [F]
  Vec3 pivot;
};

/// How head and eyes stand.
struct HeadPose {
  Angles head, leftEye, rightEye;
  friend bool operator==(const HeadPose&, const HeadPose&) = default;
};

/// Turns left-handed angles into right-handed ones, and vice versa.
Angles betweenHands(const Angles& angles);

/// The columns in which a clip has the angles of Live Link Face: HeadYaw, LeftEyePitch and so on.
/// These are left-handed: yaw is positive to the face's right, roll to its left.
class ClipAngles {
 public:
  explicit ClipAngles(const Clip& clip);
  /// Whether a clip's name is that of an angle.
  static bool tells(const std::string& name);
  /// Whether there are any of the head.
  bool head() const { return columns_[0] >= 0 || columns_[1] >= 0 || columns_[2] >= 0; }
  /// Whether any of the head, or a yaw or pitch of an eye, is ever other than 0: recordings have a
  /// column for each, filled with 0 if it was not recorded.
  bool turnsHead() const { return turns_[0] || turns_[1] || turns_[2]; }
  bool eyes() const { return turns_[3] || turns_[4] || turns_[6] || turns_[7]; }
  /// The pose at `seconds` after the first frame of the clip, right-handed; angles that it lacks
  /// are 0.
  HeadPose at(const Clip& clip, double seconds) const noexcept;

 private:
  std::array<std::ptrdiff_t, 9> columns_;  // or -1
  std::array<bool, 9> turns_{};
};

/// Whether a clip drives any target, or has nothing but angles, so that it moves the head and the
/// eyes alone.
bool movesAnything(const Clip& clip, const ClipMatch& match);

/// An eyeball: stored vectors that turn together about a centre.
struct Eye {
  std::string name;  ///< eyeLeft, eyeRight
  Vec3 centre;       ///< of the ball, model units
  double radius = 0;
  std::vector<Index> stored;
};

/// The eyeballs: the two largest balls of a face and whatever lies in them.
std::vector<Eye> findEyes(const Rig& rig);

/// Turns eyes rigidly, by targets that hold the turned ball exactly: with a rotation of θ about an
/// axis (a, b, 0), the ball stands at
///
///   p + sin θ (a X p + b Y p) + (1 − cos θ) (a² X² p + b² Y² p + ab (XY + YX) p)
///
/// where X and Y are the cross products with the x and y axes. Eyes only use axes in the plane
/// across the view (Listing's law). Terms whose factors may be below 0 have a target for each sign,
/// since some programs stop weights at 0.
class EyeTurns {
 public:
  static constexpr std::size_t kTargets = 8;  ///< of an eye
  static constexpr std::size_t kTerms = 5;    ///< of the rotation

  EyeTurns() = default;

  /// Adds the targets to a rig, named eyeLeft.down, .up, .left, .right, .xx, .yy, .xy and .yx.
  /// Targets named like ARKit's eyeLook shapes turn the eyes from now on. They turn them by as much
  /// as they did so far, but no longer move the ball along straight lines; those that did not turn
  /// them do so by half a radian.
  static EyeTurns addTo(Rig& rig, std::span<const Eye> eyes);

  bool empty() const noexcept { return eyes_.empty(); }

  /// Gives every eyeball wholly to the region that has most of it: a ball whose parts turn by
  /// different angles is no ball. The same for influences [R][storedCount].
  void keepWhole(const Surface& surface, std::span<Region> regions) const;
  void keepWhole(std::span<std::vector<float>> influences) const;

  /// Sets the weights [K] of the turns from those of the eyeLook targets.
  void apply(std::span<double> weights) const noexcept;
  /// Sets them from angles instead, as a tracker gives them; roll is ignored.
  void apply(const HeadPose& pose, std::span<double> weights) const noexcept;

 private:
  struct Look {
    Index target = -1;
    double x = 0, y = 0;  // rotation vector at weight 1
  };
  struct Turning {
    Index first = -1;  // of its targets
    bool left = true;
    std::vector<Look> looks;
    std::vector<Index> stored;
  };
  template <typename Share>
  void keepWhole(std::size_t regions, const Share& share) const;
  using Factors = std::array<double, kTerms>;
  static void set(const Turning& eye, const Factors& factors, std::span<double> weights) noexcept;
  static void addLooks(Rig& rig, const Eye& eye, Turning& turning);

  std::vector<Turning> eyes_;
};

}  // namespace sweepface
