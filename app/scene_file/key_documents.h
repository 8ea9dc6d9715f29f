#pragma once

#include <string>

namespace app {

// What docs/scene-file.md says from its first heading "## Keys" on: every key of the scene file and of tag map files
// with type, unit, range, default, meaning and example, and the sky models, as Markdown.
std::string scene_key_reference();

// The whole of data/scene.schema.json: JSON Schema, draft 7, by which editors complete and check scene files.
std::string scene_schema();

// The document with its key reference replaced by what the tables say now. Throws std::runtime_error where the heading
// is missing.
std::string with_key_reference(const std::string& document);

}  // namespace app
