#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cli {

// What a screen shows.
struct Screenshot {
  using Pixel = std::array<std::uint8_t, 3>;  // R'G'B'

  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;  // row by row from the top

  const Pixel& at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y) * width + x); }
};

struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const Rectangle&) const = default;
};

// A desktop that nobody sees (Xvfb, without a window manager), and hands on its keyboard and mouse. Throws
// std::runtime_error where something does not answer.
class Desktop {
 public:
  using Window = unsigned long;

  // There is an Xvfb.
  static bool available();

  Desktop(int width, int height);
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  // For DISPLAY: ":1".
  std::string name() const { return name_; }
  // A window is shown whose title begins so.
  bool has_window(const std::string& title) const;
  // That window; it gets the keyboard.
  Window take_window(const std::string& title);
  Rectangle place_of(Window window) const;
  void resize(Window window, int width, int height);
  // As its frame's button does.
  void ask_to_close(Window window);
  // A key by X's name of it: "h", "F11".
  void press(const std::string& key);
  void click(int x, int y);
  Screenshot screenshot() const;

 private:
  struct Connection;

  pid_t server_ = -1;
  std::string name_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace cli
