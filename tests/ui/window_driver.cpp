#include "tests/ui/window_driver.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace flytri::testing {
namespace {

constexpr double kPatience_s = 60.0;

/// Starts a program in the background. @return  -1 if it cannot be started
pid_t spawn(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = -1;
  if (posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) {
    return -1;
  }
  return process;
}

/// Runs xdotool, which sends events to the X server, and waits for its end.
void xdotool(std::vector<std::string> words) {
  words.insert(words.begin(), "xdotool");
  const pid_t process = spawn(words);
  int status = -1;
  if (process > 0) waitpid(process, &status, 0);
  EXPECT_EQ(status, 0) << "xdotool " << words[1] << ": is it installed?";
}

}  // namespace

std::unique_ptr<WindowDriver> WindowDriver::start(int width_px, int height_px, double scale,
                                                  const std::string& language) {
  if (std::getenv("DISPLAY") == nullptr) return nullptr;
  std::unique_ptr<WindowDriver> driver(new WindowDriver);
  const std::string socket = (driver->folder_.path() / "control").string();
  driver->process_ = spawn({FLYTRI_FAKE_WINDOW, "--width", fmt::to_string(width_px), "--height",
                            fmt::to_string(height_px), "--scale", fmt::to_string(scale),
                            "--language", language, "--control", socket});
  if (driver->process_ < 0) return nullptr;
  driver->client_ = ControlClient::connect(socket, kPatience_s);
  if (!driver->client_) return nullptr;
  driver->settle();
  return driver;
}

WindowDriver::~WindowDriver() {
  if (client_) (void)client_->ask("quit");
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

std::string WindowDriver::ask(const std::string& request) {
  const std::string answer = client_->ask(request);
  EXPECT_TRUE(answer.starts_with("ok")) << request << ": " << answer;
  return answer.size() > 3 ? answer.substr(3) : std::string();
}

void WindowDriver::cancel_all() {
  // A question in a dialog over a tool in hand: each takes one.
  for (int i = 0; i < 3; ++i) ask("do cancel");
}

void WindowDriver::show(const std::string& state) {
  ask("tell " + state);
  settle();
}

nlohmann::json WindowDriver::state() { return nlohmann::json::parse(ask("state"), nullptr, false); }

std::vector<std::string> WindowDriver::commands() {
  return state().at("commands").get<std::vector<std::string>>();
}

void WindowDriver::key(const std::string& name) {
  xdotool({"key", name});
  settle();
}

void WindowDriver::type(const std::string& text) {
  xdotool({"type", "--delay", "2", text});
  settle();
}

void WindowDriver::point(double x_px, double y_px) {
  xdotool({"mousemove", fmt::format("{:.0f}", x_px), fmt::format("{:.0f}", y_px)});
  settle();
}

std::optional<WindowDriver::Place> WindowDriver::where(const std::string& id) {
  const std::string answer = client_->ask("where " + id);
  if (!answer.starts_with("ok ")) return std::nullopt;
  Place place;
  std::istringstream(answer.substr(3)) >> place.x_px >> place.y_px >> place.width_px >>
      place.height_px;
  return place;
}

void WindowDriver::click_at(double x_px, double y_px) {
  point(x_px, y_px);
  xdotool({"click", "1"});
  settle();
}

void WindowDriver::double_click_at(double x_px, double y_px) {
  point(x_px, y_px);
  xdotool({"click", "--repeat", "2", "--delay", "1", "1"});
  settle();
}

void WindowDriver::click(const std::string& id) {
  const auto place = where(id);
  ASSERT_TRUE(place) << "nothing is called " << id;
  click_at(place->x_px + place->width_px / 2.0, place->y_px + place->height_px / 2.0);
}

void WindowDriver::press_at(double x_px, double y_px, double dx_px, double dy_px) {
  constexpr int kSteps = 4;
  point(x_px, y_px);
  xdotool({"mousedown", "1"});
  for (int i = 1; i <= kSteps; ++i) point(x_px + dx_px * i / kSteps, y_px + dy_px * i / kSteps);
}

void WindowDriver::release() {
  xdotool({"mouseup", "1"});
  settle();
}

void WindowDriver::drag_at(double x_px, double y_px, double dx_px, double dy_px) {
  press_at(x_px, y_px, dx_px, dy_px);
  release();
}

void WindowDriver::drag(const std::string& id, double dx_px, double dy_px) {
  const auto place = where(id);
  ASSERT_TRUE(place) << "nothing is called " << id;
  drag_at(place->x_px + place->width_px / 2.0, place->y_px + place->height_px / 2.0, dx_px, dy_px);
}

void WindowDriver::wheel(int clicks) {
  for (int i = 0; i < std::abs(clicks); ++i) xdotool({"click", clicks > 0 ? "4" : "5"});
  settle();
}

}  // namespace flytri::testing
