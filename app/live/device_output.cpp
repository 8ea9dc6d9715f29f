#include "app/live/device_output.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "ar/error.h"
#include "ar/output/v4l2/v4l2_sink.h"

namespace app {
namespace {

std::unique_ptr<ar::FrameSink> open_sink(const std::string& specification, ar::SourceInfo source) {
  const std::string kind = "v4l2:";
  if (!specification.starts_with(kind)) {
    throw ar::InputError(fmt::format(
        "found --output {}; accepted: v4l2:/dev/videoN, or v4l2: for the first output device", specification));
  }
  std::string address = specification.substr(kind.size());
  std::optional<std::string> format;
  if (const std::size_t colon = address.rfind(':'); colon != std::string::npos) {
    format = address.substr(colon + 1);
    address.resize(colon);
  }
  return ar::open_v4l2_sink(address, source, format);
}

}  // namespace

DeviceOutput::DeviceOutput(const std::string& specification, const ar::SourceInfo& source)
    : sink_(open_sink(specification, source)) {}

void DeviceOutput::show(const ShownPicture& shown) {
  if (!sink_) return;
  try {
    sink_->write(shown.picture, count_++);
  } catch (const ar::InputError& error) {
    spdlog::warn("{}", error.what());
    sink_.reset();
  }
}

}  // namespace app
