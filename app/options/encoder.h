#pragma once

#include "ar/output/sink.h"

namespace CLI {
class App;
}

namespace app {

// --codec, --crf and --preset; what `options` holds is the default.
void add_encoder_options(CLI::App& command, ar::VideoSinkOptions& options);

}  // namespace app
