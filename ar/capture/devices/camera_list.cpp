#include "ar/capture/devices/camera_list.h"

#include "ar/capture/v4l2/device.h"
#include "ar/error.h"

#ifdef SKYSHAFT_LIBCAMERA
#include "ar/capture/libcamera/source.h"
#endif

namespace ar {

std::vector<CameraListing> list_cameras() {
  std::vector<CameraListing> cameras;
  for (const auto& node : v4l2::list_nodes()) {
    CameraListing camera;
    camera.source = "v4l2:" + node.string();
    try {
      const v4l2::Device device(node);
      if (!device.captures()) continue;  // an output, a codec, metadata
      camera.name = device.card();
      camera.modes = v4l2::list_modes(device);
      if (!choose_mode(camera.modes, {})) camera.problem = "it offers no format that can be decoded here";
    } catch (const InputError& error) {
      camera.problem = error.what();
    }
    cameras.push_back(std::move(camera));
  }
#ifdef SKYSHAFT_LIBCAMERA
  for (CameraListing& camera : list_libcamera_cameras()) cameras.push_back(std::move(camera));
#endif
  return cameras;
}

}  // namespace ar
