#include "app/live/still_writer.h"

#include <fmt/chrono.h>
#include <spdlog/spdlog.h>

#include "ar/output/sink.h"

namespace app {
namespace {

ar::SourceInfo one_picture(ar::SourceInfo source) {
  source.path.clear();
  source.tags.reset();
  return source;
}

}  // namespace

StillWriter::StillWriter(std::filesystem::path folder, ar::SourceInfo source)
    : folder_(std::move(folder)), source_(one_picture(std::move(source))) {}

std::string StillWriter::write(const ShownPicture& shown) {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto second = std::chrono::floor<std::chrono::seconds>(now);
  const std::filesystem::path path =
      folder_ / fmt::format("skyshaft-{:%Y%m%d-%H%M%S}-{:03}.png", fmt::gmtime(second), (now - second).count());
  writing_.push_back(std::async(std::launch::async, [path, source = source_, picture = shown.picture] {
    const auto sink = ar::make_file_sink(path, source);
    sink->write(picture, 0);
    sink->finish();
  }));
  return path.string();
}

void StillWriter::finish() {
  for (std::future<void>& still : writing_) {
    try {
      still.get();
    } catch (const std::exception& error) {
      spdlog::warn("{}", error.what());
    }
  }
  writing_.clear();
}

}  // namespace app
