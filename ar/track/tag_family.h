#pragma once

#include <apriltag.h>

#include <memory>
#include <string>

namespace ar {

using FamilyPtr = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

// The library's codes of a family, by the names of tag_families(). Throws std::runtime_error that names an unknown one
// and lists the known ones.
FamilyPtr make_family(const std::string& name);

}  // namespace ar
