#include "ar/capture/devices/open_live_source.h"

#include <fmt/format.h>

#include "ar/capture/live/file_live_source.h"
#include "ar/capture/v4l2/source.h"
#include "ar/error.h"

#ifdef SKYSHAFT_LIBCAMERA
#include "ar/capture/libcamera/source.h"
#endif

namespace ar {
namespace {

#ifdef SKYSHAFT_LIBCAMERA
std::unique_ptr<LiveSource> open_through_libcamera(const std::string& id, const LiveRequest& request) {
  return open_libcamera_source(id, request);
}
#else
std::unique_ptr<LiveSource> open_through_libcamera(const std::string& id, const LiveRequest& /*request*/) {
  throw InputError(fmt::format(
      "cannot open libcamera:{}: Skyshaft was built without libcamera\nBuild it with libcamera-dev installed, or use "
      "--source v4l2:.",
      id));
}
#endif

}  // namespace

std::unique_ptr<LiveSource> open_live_source(const std::string& specification, const LiveRequest& request) {
  const std::size_t colon = specification.find(':');
  const std::string kind = specification.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : specification.substr(colon + 1);
  if (colon != std::string::npos) {
    if (kind == "v4l2") return open_v4l2_source(rest, request);
    if (kind == "libcamera") return open_through_libcamera(rest, request);
    if (kind == "file") return open_file_live_source(rest);
  }
  throw InputError(
      fmt::format("no source is called '{}'\nGive v4l2:/dev/video0, v4l2: (the first camera), libcamera:ID, libcamera: "
                  "or file:CLIP.",
                  specification));
}

}  // namespace ar
