#include "ui/window/window.h"

#include <epoxy/gl.h>
// After epoxy, which brings the functions of OpenGL.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace flytri::ui {
namespace {

/// The error message of GLFW.
std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "unknown reason" : text;
}

void set_hints() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 24);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
}

/// Maps keys of the number pad to the ordinary keys.
int twin_of(int key) {
  switch (key) {
    case GLFW_KEY_KP_ADD:
      return GLFW_KEY_EQUAL;
    case GLFW_KEY_KP_SUBTRACT:
      return GLFW_KEY_MINUS;
    case GLFW_KEY_KP_ENTER:
      return GLFW_KEY_ENTER;
    default:
      return key;
  }
}

/// The key by the letter printed on it: Z is Z on a German keyboard, too. GLFW itself names keys by
/// their place on an American keyboard.
int printed_key(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return twin_of(key);
  const int sign = std::toupper(static_cast<unsigned char>(name[0]));
  if (sign >= 'A' && sign <= 'Z') return sign;
  if (sign == '+') return GLFW_KEY_EQUAL;
  if (sign == '-') return GLFW_KEY_MINUS;
  return twin_of(key);
}

InputQueue& queue_of(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window))->input();
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  if (key == GLFW_KEY_UNKNOWN) return;
  queue_of(window).push(KeyEvent{printed_key(key, scancode), modifiers, action != GLFW_RELEASE,
                                 action == GLFW_REPEAT});
}

void on_character(GLFWwindow* window, unsigned code) {
  queue_of(window).push(CharacterEvent{code});
}

/// GLFW reports the pointer in screen coordinates, which are not always pixels.
void on_pointer(GLFWwindow* window, double x, double y) {
  int width = 0, height = 0, width_px = 0, height_px = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &width_px, &height_px);
  queue_of(window).push(PointerEvent{static_cast<float>(x * width_px / std::max(width, 1)),
                                     static_cast<float>(y * height_px / std::max(height, 1))});
}

void on_button(GLFWwindow* window, int button, int action, int /*modifiers*/) {
  queue_of(window).push(ButtonEvent{button, action == GLFW_PRESS});
}

void on_wheel(GLFWwindow* window, double x, double y) {
  queue_of(window).push(WheelEvent{static_cast<float>(x), static_cast<float>(y)});
}

/// The screen that shows this place; the first screen if none does.
GLFWmonitor* monitor_at(int x, int y) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    const bool holds = mode != nullptr && x >= left && x < left + mode->width && y >= top &&
                       y < top + mode->height;
    if (holds) return monitors[i];
  }
  return glfwGetPrimaryMonitor();
}

}  // namespace

Window::Window(GLFWwindow* window) : window_(window), partial_swap_(PartialSwap::find()) {
  listen();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
  if (glfwInit() == GLFW_FALSE) {
    return fail(ErrorCode::kNotFound,
                "no window can be opened: {}; start flytri on a desktop, or set DISPLAY",
                glfw_reason());
  }
  set_hints();
  GLFWwindow* window = glfwCreateWindow(options.size.width_px, options.size.height_px,
                                        options.title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    const std::string reason = glfw_reason();
    glfwTerminate();
    return fail(ErrorCode::kNotFound,
                "no window with OpenGL 3.3 can be opened: {}; check the graphics driver", reason);
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(options.waits_for_screen ? 1 : 0);
  return std::unique_ptr<Window>(new Window(window));
}

void Window::on_refresh(GLFWwindow* window) {
  static_cast<Window*>(glfwGetWindowUserPointer(window))->wants_refresh_ = true;
}

void Window::listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowRefreshCallback(window_, on_refresh);
  glfwSetKeyCallback(window_, on_key);
  glfwSetCharCallback(window_, on_character);
  glfwSetCursorPosCallback(window_, on_pointer);
  glfwSetMouseButtonCallback(window_, on_button);
  glfwSetScrollCallback(window_, on_wheel);
}

void Window::poll() { glfwPollEvents(); }

bool Window::keeps_its_size() {
  const ImageSize size = framebuffer_size();
  return size == std::exchange(shown_size_, size);
}

void Window::show(const Framebuffer& picture, const std::vector<PixelBox>& changed) {
  const bool was_asked = std::exchange(wants_refresh_, false);
  if (changed.empty() && !was_asked) return;
  if (partial_swap_ && !was_asked) {
    picture.copy_to_window(changed);
    if (keeps_its_size()) {
      for (const PixelBox& part : changed) partial_swap_->show(part);
      return;
    }
  }
  picture.copy_to_window({picture.area()});
  glfwSwapBuffers(window_);
}

bool Window::is_full_screen() const { return glfwGetWindowMonitor(window_) != nullptr; }

void Window::set_full_screen(bool is_full) {
  if (is_full == is_full_screen()) return;
  auto& [left, top, width, height] = place_;
  if (!is_full) return glfwSetWindowMonitor(window_, nullptr, left, top, width, height, 0);
  glfwGetWindowPos(window_, &left, &top);
  glfwGetWindowSize(window_, &width, &height);
  GLFWmonitor* monitor = monitor_at(left + width / 2, top + height / 2);
  const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  if (mode == nullptr) return;
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

bool Window::has_focus() const { return glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0; }

bool Window::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::keep_open() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

ImageSize Window::framebuffer_size() const {
  ImageSize size;
  glfwGetFramebufferSize(window_, &size.width_px, &size.height_px);
  return size;
}

double Window::content_scale() const {
  float x = 1.0F, y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return static_cast<double>(x);
}

}  // namespace flytri::ui
