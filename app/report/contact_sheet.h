#pragma once

#include <filesystem>
#include <string>

namespace app {

struct ContactSheetOptions {
  int columns = 4;       // evenly spaced frames
  int cell_width = 640;  // pixels
};

// Frames of two recordings, `before` above `after`, as one PNG. Throws ar::InputError when one cannot be read and
// std::runtime_error when the sheet cannot be written.
void write_contact_sheet(const std::string& before, const std::string& after, const std::filesystem::path& sheet,
                         const ContactSheetOptions& options);

}  // namespace app
