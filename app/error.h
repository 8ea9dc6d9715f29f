#pragma once

#include <stdexcept>

namespace app {

// The command line does not fit together: the program ends with status 2. First line what, second line what to do.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace app
