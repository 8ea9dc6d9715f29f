#include "tests/testing/desktop.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

// The display that the server chose, whose number it writes when it is ready.
std::string read_display(int descriptor) {
  std::string number = ":";
  pollfd waiting{descriptor, POLLIN, 0};
  char c = 0;
  while (poll(&waiting, 1, 20'000) == 1 && read(descriptor, &c, 1) == 1 && c != '\n') number += c;
  if (number.size() < 2) throw std::runtime_error("Xvfb does not start");
  return number;
}

bool begins_with(Display* display, Window window, const std::string& title) {
  char* name = nullptr;
  if (XFetchName(display, window, &name) == 0 || name == nullptr) return false;
  const bool begins = std::string(name).starts_with(title);
  XFree(name);
  return begins;
}

// The uppermost window of that title, shown; 0 where there is none.
Window find(Display* display, const std::string& title) {
  Window root = 0;
  Window parent = 0;
  Window* windows = nullptr;
  unsigned count = 0;
  if (XQueryTree(display, DefaultRootWindow(display), &root, &parent, &windows, &count) == 0) return 0;
  Window found = 0;
  for (unsigned i = 0; i < count; ++i) {
    XWindowAttributes attributes;
    const bool shown =
        XGetWindowAttributes(display, windows[i], &attributes) != 0 && attributes.map_state == IsViewable;
    if (shown && begins_with(display, windows[i], title)) found = windows[i];
  }
  XFree(windows);
  return found;
}

}  // namespace

struct Desktop::Connection {
  explicit Connection(const std::string& name) : display(XOpenDisplay(name.c_str())) {
    if (display == nullptr) throw std::runtime_error("cannot reach the X server " + name);
  }
  ~Connection() { XCloseDisplay(display); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Display* display;
};

bool Desktop::available() {
  return run({"Xvfb", "-help"}).status != 127;
}

Desktop::Desktop(int width, int height) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  char screen[40];
  std::snprintf(screen, sizeof screen, "%dx%dx24", width, height);
  server_ = fork();
  if (server_ == 0) {
    const int number = dup(ends[1]);  // which stays open in the server
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    execlp("Xvfb", "Xvfb", "-displayfd", std::to_string(number).c_str(), "-screen", "0", screen, "-nolisten", "tcp",
           nullptr);
    _exit(127);
  }
  close(ends[1]);
  name_ = read_display(ends[0]);
  close(ends[0]);
  connection_ = std::make_unique<Connection>(name_);
}

Desktop::~Desktop() {
  connection_.reset();
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

bool Desktop::has_window(const std::string& title) const {
  return find(connection_->display, title) != 0;
}

Desktop::Window Desktop::take_window(const std::string& title) {
  const Window window = find(connection_->display, title);
  if (window == 0) throw std::runtime_error("no window is called " + title);
  XSetInputFocus(connection_->display, window, RevertToParent, CurrentTime);
  XSync(connection_->display, False);
  return window;
}

Rectangle Desktop::place_of(Window window) const {
  XWindowAttributes attributes;
  XGetWindowAttributes(connection_->display, window, &attributes);
  return {attributes.x, attributes.y, attributes.width, attributes.height};
}

void Desktop::resize(Window window, int width, int height) {
  XResizeWindow(connection_->display, window, static_cast<unsigned>(width), static_cast<unsigned>(height));
  XSync(connection_->display, False);
}

void Desktop::ask_to_close(Window window) {
  Display* display = connection_->display;
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  event.xclient.data.l[1] = CurrentTime;
  XSendEvent(display, window, False, NoEventMask, &event);
  XSync(display, False);
}

void Desktop::press(const std::string& key) {
  Display* display = connection_->display;
  const KeyCode code = XKeysymToKeycode(display, XStringToKeysym(key.c_str()));
  XTestFakeKeyEvent(display, code, True, CurrentTime);
  XTestFakeKeyEvent(display, code, False, CurrentTime);
  XSync(display, False);
}

void Desktop::click(int x, int y) {
  Display* display = connection_->display;
  XTestFakeMotionEvent(display, -1, x, y, CurrentTime);
  XTestFakeButtonEvent(display, 1, True, CurrentTime);
  XTestFakeButtonEvent(display, 1, False, CurrentTime);
  XSync(display, False);
}

Screenshot Desktop::screenshot() const {
  Display* display = connection_->display;
  Screenshot shot{DisplayWidth(display, 0), DisplayHeight(display, 0), {}};
  XImage* image = XGetImage(display, DefaultRootWindow(display), 0, 0, static_cast<unsigned>(shot.width),
                            static_cast<unsigned>(shot.height), AllPlanes, ZPixmap);
  if (image == nullptr) throw std::runtime_error("no screenshot");
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const unsigned long rgb = XGetPixel(image, x, y);
      shot.pixels.push_back({static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
                             static_cast<std::uint8_t>(rgb)});
    }
  }
  XDestroyImage(image);
  return shot;
}

}  // namespace cli
