#include <embree3/rtcore.h>

#include "sweepface/box.hpp"

#include "picture/obstacles.hpp"

namespace sweepface {

struct Obstacles::Scene {
  struct Close {
    void operator()(RTCDevice opened) const { rtcReleaseDevice(opened); }
    void operator()(RTCScene made) const { rtcReleaseScene(made); }
  };
  std::unique_ptr<RTCDeviceTy, Close> device;
  std::unique_ptr<RTCSceneTy, Close> scene;
};
void Obstacles::Release::operator()(Scene* scene) const { delete scene; }

Result<Obstacles> Obstacles::make(std::span<const Vec3> positions,
                                  std::span<const std::array<Index, 3>> triangles) {
  const auto noMemory = [] { return fail("There is not enough memory for the picture."); };
  Obstacles o;
  const Box box(positions);
  o.centre_ = box.centre();
  if (const double size = norm(box.size()); size > 0) o.size_ = size;

  o.scene_.reset(new Scene);
  auto& [device, scene] = *o.scene_;
  device.reset(rtcNewDevice("set_affinity=0"));  // threads run where the system likes
  if (!device) return noMemory();
  scene.reset(rtcNewScene(device.get()));
  if (!scene) return noMemory();
  // Rounding then never decides whether a ray meets a box.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> geometry(
      rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry);
  if (!geometry) return noMemory();
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), positions.size()));
  auto* const corners = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), triangles.size()));
  if ((!vertices && !positions.empty()) || (!corners && !triangles.empty())) return noMemory();
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 p = (positions[v] - o.centre_) * (1 / o.size_);
    vertices[3 * v] = static_cast<float>(p.x);
    vertices[3 * v + 1] = static_cast<float>(p.y);
    vertices[3 * v + 2] = static_cast<float>(p.z);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) corners[3 * t + k] = static_cast<unsigned>(triangles[t][k]);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) return noMemory();
  return o;
}

bool Obstacles::blocks(const Vec3& origin, const Vec3& direction, double near, double far) const {
  const Vec3 p = (origin - centre_) * (1 / size_);
  RTCRay ray{};
  ray.org_x = static_cast<float>(p.x);
  ray.org_y = static_cast<float>(p.y);
  ray.org_z = static_cast<float>(p.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = static_cast<float>(near / size_);
  ray.tfar = static_cast<float>(far / size_);
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene.get(), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace sweepface
