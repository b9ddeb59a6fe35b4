// A small program that uses an installed Sweepface: a picture of a triangle.
#include <sweepface/picture.hpp>

using namespace sweepface;

int main() {
  Scene scene;
  scene.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.triangles = {{0, 1, 2}};
  scene.finish = Finish::flat;
  scene.colour = {1, 0, 0};
  const PictureSize size{64, 64};
  const Camera camera = frameCamera(scene.positions, {}, size);
  const auto image = render(scene, camera, size);
  if (!image) return 1;
  const auto png = encodePng(*image);
  return png && png->starts_with("\x89PNG") && image->at(32, 32) == scene.colour ? 0 : 1;
}
