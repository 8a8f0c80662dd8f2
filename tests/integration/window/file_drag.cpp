#include "file_drag.h"

#include <stdexcept>

#ifdef ETENDUE_X11
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <chrono>
#include <cstdio>
#include <memory>
#endif

namespace etendue::test {

#ifndef ETENDUE_X11

bool can_drag_files() { return false; }

void drag_files(const std::string&, unsigned long, const std::vector<std::filesystem::path>&) {
  throw std::runtime_error("the tests were built without Xlib");
}

#else

namespace {

constexpr long kVersion = 5;
constexpr auto kTimeout = std::chrono::seconds(20);

// "file:///a%20b": all bytes except letters, digits and a few others are percent-encoded.
std::string uri_of(const std::filesystem::path& file) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/-_.~";
  std::string uri = "file://";
  for (const char c : file.string()) {
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    uri += kPlain.find(c) == std::string_view::npos ? code : std::string(1, c);
  }
  return uri;
}

// The client that owns the dragged files.
class Source {
 public:
  Source(const std::string& display, Window target) : display_(XOpenDisplay(display.c_str())), target_(target) {
    if (!display_) throw std::runtime_error("the display cannot be opened");
    window_ = XCreateSimpleWindow(get(), DefaultRootWindow(get()), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(get(), atom("XdndSelection"), window_, CurrentTime);
  }

  void drop(const std::string& uris) {
    uris_ = uris;
    const auto own = static_cast<long>(window_);
    send("XdndEnter", {own, kVersion << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
    send("XdndPosition", {own, 0, middle_of_target(), CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    if ((wait_for("XdndStatus") & 1) == 0) throw std::runtime_error("the window refuses the files");
    send("XdndDrop", {own, 0, CurrentTime, 0, 0});
    // GLFW 3.3 answers with the length of the list instead of a flag.
    if (wait_for("XdndFinished") == 0) throw std::runtime_error("the window did not take the files");
  }

 private:
  struct Closer {
    void operator()(Display* display) const { XCloseDisplay(display); }
  };
  struct Data {
    long values[5];
  };

  Display* get() const { return display_.get(); }
  Atom atom(const char* name) const { return XInternAtom(get(), name, False); }

  // Coordinates of the display, as XdndPosition packs them.
  long middle_of_target() const {
    XWindowAttributes attributes;
    XGetWindowAttributes(get(), target_, &attributes);
    int x = 0, y = 0;
    Window child;
    XTranslateCoordinates(get(), target_, DefaultRootWindow(get()), attributes.width / 2, attributes.height / 2, &x, &y,
                          &child);
    return (static_cast<long>(x) << 16) | y;
  }

  void send(const char* message, const Data& data) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data.values[i];
    XSendEvent(get(), target_, False, NoEventMask, &event);
    XFlush(get());
  }

  // Answers requests for the list of files until this message comes, and returns its flags.
  long wait_for(const char* message) const {
    const Atom expected = atom(message);
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    while (std::chrono::steady_clock::now() < end) {
      pollfd connection{.fd = ConnectionNumber(get()), .events = POLLIN, .revents = 0};
      if (XPending(get()) == 0 && poll(&connection, 1, 100) <= 0) continue;
      if (XPending(get()) == 0) continue;
      XEvent event;
      XNextEvent(get(), &event);
      if (event.type == SelectionRequest) answer(event.xselectionrequest);
      if (event.type == ClientMessage && event.xclient.message_type == expected) return event.xclient.data.l[1];
    }
    throw std::runtime_error(std::string("there is no ") + message);
  }

  void answer(const XSelectionRequestEvent& request) const {
    XChangeProperty(get(), request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(uris_.data()), static_cast<int>(uris_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(get(), request.requestor, False, NoEventMask, &event);
    XFlush(get());
  }

  std::unique_ptr<Display, Closer> display_;
  Window target_;
  Window window_ = 0;
  std::string uris_;
};

}  // namespace

bool can_drag_files() { return true; }

void drag_files(const std::string& display, unsigned long window, const std::vector<std::filesystem::path>& files) {
  std::string uris;
  for (const auto& file : files) uris += uri_of(file) + "\r\n";
  Source(display, window).drop(uris);
}

#endif

}  // namespace etendue::test
