#pragma once

#include <stdexcept>
#include <string>

namespace ar {

// The input cannot be read, or a device was lost: the program ends with status 3. The message names the file or
// device, what was found, and on a second line what to do.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ar
