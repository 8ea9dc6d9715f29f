// What decoding and encoding a clip costs without any of Skyshaft's own work: the yardstick for `skyshaft process`.
//   transcode_bench IN [OUT] [--codec h264|hevc|ffv1] [--preset P] [--crf N] [--threads N]
// Decodes IN alone, then decodes and encodes it (into OUT, or a temporary file), and prints JSON. Processor seconds
// stand beside the clock's: they hold on a busy machine too.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ar/capture/file/open_source.h"
#include "ar/output/sink.h"

namespace {

struct Run {
  std::string in;
  std::string out;
  int threads = 0;
  ar::VideoSinkOptions sink;
};

struct Timing {
  long long frames = 0;
  double seconds = 0.0;
  double cpu_seconds = 0.0;  // of all threads
  double per_second() const { return seconds > 0.0 ? static_cast<double>(frames) / seconds : 0.0; }
};

ar::VideoCodec codec_of(const std::string& name) {
  if (name == "h264") return ar::VideoCodec::H264;
  if (name == "hevc") return ar::VideoCodec::Hevc;
  if (name == "ffv1") return ar::VideoCodec::Ffv1;
  throw std::invalid_argument("codec must be h264, hevc or ffv1, found " + name);
}

Run parse(const std::vector<std::string>& arguments) {
  Run run;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (!word.starts_with("--")) {
      (run.in.empty() ? run.in : run.out) = word;
      continue;
    }
    if (i + 1 == arguments.size()) throw std::invalid_argument(word + " needs a value");
    const std::string& value = arguments[++i];
    if (word == "--codec") {
      run.sink.codec = codec_of(value);
    } else if (word == "--preset") {
      run.sink.preset = value;
    } else if (word == "--crf") {
      run.sink.crf = std::stoi(value);
    } else if (word == "--threads") {
      run.threads = run.sink.threads = std::stoi(value);
    } else {
      throw std::invalid_argument("unknown option " + word);
    }
  }
  if (run.in.empty()) {
    throw std::invalid_argument("usage: transcode_bench IN [OUT] [--codec C] [--preset P] [--crf N] [--threads N]");
  }
  return run;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::unique_ptr<ar::FrameSource> open(const Run& run) {
  ar::OpenOptions options;
  options.threads = run.threads;
  return ar::open_source(run.in, options);
}

Timing decode(const Run& run) {
  Timing timing;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const auto source = open(run);
  while (source->next()) ++timing.frames;
  timing.seconds = seconds_since(start);
  timing.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  return timing;
}

Timing transcode(const Run& run, const std::string& out) {
  Timing timing;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const auto source = open(run);
  const auto sink = ar::make_file_sink(out, source->info(), run.sink);
  for (; auto frame = source->next(); ++timing.frames) sink->write_untouched(std::move(*frame));
  sink->finish();
  timing.seconds = seconds_since(start);
  timing.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  return timing;
}

void print(const Run& run, const ar::SourceInfo& info, const Timing& decoding, const Timing& both) {
  fmt::print(R"({{"clip": "{}", "width": {}, "height": {}, "frames": {}, "preset": "{}", "crf": {}, "threads": {},)"
             R"( "decode_fps": {:.2f}, "decode_encode_fps": {:.2f}, "decode_s": {:.3f},)"
             R"( "decode_encode_s": {:.3f}, "decode_cpu_s": {:.3f},)"
             R"( "decode_encode_cpu_s": {:.3f}}})"
             "\n",
             std::filesystem::path(run.in).filename().string(), info.format.width, info.format.height, both.frames,
             run.sink.preset, run.sink.crf, run.threads, decoding.per_second(), both.per_second(), decoding.seconds,
             both.seconds, decoding.cpu_seconds, both.cpu_seconds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Run run = parse({argv + 1, argv + argc});
    run.sink.overwrite = true;
    const bool temporary = run.out.empty();
    const std::string out =
        temporary ? (std::filesystem::temp_directory_path() / "skyshaft_transcode_bench.mkv").string() : run.out;
    const Timing decoding = decode(run);
    const Timing both = transcode(run, out);
    if (temporary) std::filesystem::remove(out);
    print(run, open(run)->info(), decoding, both);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
