#pragma once

#include <memory>

#include "tests/lab/uvc_descriptors.h"

namespace ar::testing {

// A USB webcam made of software: it speaks USB/IP to the kernel's virtual host controller (vhci-hcd), so that the stock
// uvcvideo driver, and V4L2 and libcamera above it, serve its pictures. Runs on a thread of its own; needs root. Bulk
// transfers, not isochronous ones: that differs inside the driver only.
class Webcam {
 public:
  // Plugs it in. Throws std::runtime_error where there is no such controller.
  explicit Webcam(WebcamModel model);
  ~Webcam();  // pulls it out
  Webcam(const Webcam&) = delete;
  Webcam& operator=(const Webcam&) = delete;

  void pull_out();
  void plug_in();                 // at the same port
  void hang(bool hangs);          // answers nothing while it hangs
  void hold_pictures(bool hold);  // answers, but gives no pictures: the first is then the first of all
  void damage_next_picture();     // sends half of it, with the class's error bit set
  void cut_next_picture();        // sends half of it and says nothing

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace ar::testing
