#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/sky/sky_model.h"

namespace render {

// Turbidities that a model takes; outside them the nearest is used.
struct TurbidityLimits {
  double least = 1.0;
  double most = 20.0;
};

// A sky model as it is known by name. The scene file, --model, the panel, messages and documents read this.
struct SkyModelInfo {
  // As a person writes it: "perez", or "cie:1 to cie:15" and "image:FILE" where an argument follows the colon.
  std::string written;
  // What such a word begins with, "cie:"; empty where the whole word is `written`.
  std::string prefix = {};
  // Every word that names the model, as far as they can be listed: none for "image:FILE".
  std::vector<std::string> words = {};
  std::string summary = {};                                 // Markdown, one line
  std::optional<TurbidityLimits> turbidity = std::nullopt;  // absent: any
  bool quick = true;  // made anew within a few milliseconds: what the live panel offers
  // The cloudless sky by day and at dusk, without night. Throws std::runtime_error where the argument names nothing.
  std::function<std::unique_ptr<SkyModel>(const SkyOptions&, const SunPosition&)> make = {};

  bool is_named_by(const std::string& word) const;
};

// All models, in the order of the documents. A new one is made in a file of its own and listed in sky_model_list.h.
const std::vector<SkyModelInfo>& sky_models();

// The model that the word names, "cie:12" say; nullptr where there is none. Whether the argument after a colon means
// something only the model itself knows.
const SkyModelInfo* find_sky_model(const std::string& word);

// "perez, preetham, ..., image:FILE or none": what may be written, for messages and help.
std::string known_sky_models();

}  // namespace render
