// Emulates USB cameras and GPIO chips on the kernel's virtual host controller.
//
//     usb_devices NAME... [--pictures FOLDER]
//
// NAME: camera (bulk), camera2 (isochronous), texture (bulk, in color; must come after camera,
// because it shows the same moments), ftdi, mcp. All devices are plugged in at the start. camera
// and texture show the pictures of FOLDER. The FIFO /tmp/usb receives commands, one per line:
// COMMAND NAME, where COMMAND is plug, unplug, or a command of the device (uvc_camera.h,
// gpio_devices.h). Changes of the light pins are appended to /tmp/lights (light_pins.h).

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "hw/device/clock.h"
#include "tests/hardware/usb/gpio_devices.h"
#include "tests/hardware/usb/uvc_camera.h"

namespace flytri::usb {
namespace {

using Devices = std::map<std::string, std::unique_ptr<UsbDevice>>;

std::unique_ptr<UsbDevice> make_device(const std::string& name, const Devices& devices,
                                       const std::string& pictures, LightPins& pins) {
  const int port = static_cast<int>(devices.size());
  if (name == "camera")
    return std::make_unique<UvcCamera>(
        port, UvcCameraOptions{"Mono Camera", "M0001", false, pictures}, pins);
  if (name == "camera2")
    return std::make_unique<UvcCamera>(port, UvcCameraOptions{"Color Camera", "C0002", true, ""},
                                       pins);
  if (name == "texture") {
    const auto camera = devices.find("camera");
    if (camera == devices.end()) return nullptr;
    return std::make_unique<UvcCamera>(
        port,
        UvcCameraOptions{"Color Camera", "C0002", false, pictures, true,
                         dynamic_cast<const UvcCamera*>(camera->second.get())},
        pins);
  }
  if (name == "ftdi") return std::make_unique<Ft232h>(port, pins);
  if (name == "mcp") return std::make_unique<Mcp2221>(port, pins);
  return nullptr;
}

// Executes complete lines.
void execute_commands(int fifo, std::string& text, Devices& devices) {
  std::array<char, 256> buffer{};
  const ssize_t length = read(fifo, buffer.data(), buffer.size());
  if (length > 0) text.append(buffer.data(), static_cast<std::size_t>(length));
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
    const std::string line = text.substr(0, end);
    text.erase(0, end + 1);
    const std::size_t space = line.find(' ');
    const auto found =
        space == std::string::npos ? devices.end() : devices.find(line.substr(space + 1));
    if (found == devices.end())
      std::fprintf(stderr, "usb_devices: unknown command: %s\n", line.c_str());
    else
      found->second->command(line.substr(0, space));
  }
}

int timeout_ms(const Devices& devices, double now_s) {
  double due_s = now_s + 1.0;
  for (const auto& [name, device] : devices) due_s = std::min(due_s, device->due_s());
  return static_cast<int>(std::ceil(std::clamp((due_s - now_s) * 1000.0, 1.0, 1000.0)));
}

[[noreturn]] void run(int fifo, Devices& devices) {
  const device::Clock clock = device::machine_clock();
  std::string commands;
  for (;;) {
    std::vector<pollfd> waiting = {{fifo, POLLIN, 0}};
    std::vector<UsbDevice*> asked;
    for (const auto& [name, device] : devices) {
      if (device->socket() < 0) continue;
      waiting.push_back({device->socket(), POLLIN, 0});
      asked.push_back(device.get());
    }
    poll(waiting.data(), waiting.size(), timeout_ms(devices, clock.now_s()));
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (waiting[i + 1].revents != 0 && asked[i]->socket() == waiting[i + 1].fd)
        asked[i]->answer();
    if (waiting[0].revents != 0) execute_commands(fifo, commands, devices);
    for (const auto& [name, device] : devices) device->work(clock.now_s());
  }
}

}  // namespace
}  // namespace flytri::usb

int main(int count, char** words) {
  using namespace flytri::usb;
  signal(SIGPIPE, SIG_IGN);
  mkfifo("/tmp/usb", 0600);
  // Also opened for writing, so that the FIFO stays open when a writer closes it.
  const int fifo = open("/tmp/usb", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  LightPins pins("/tmp/lights");
  Devices devices;
  std::string pictures;
  for (int i = 1; i + 1 < count; ++i)
    if (words[i] == std::string("--pictures")) pictures = words[i + 1];
  for (int i = 1; i < count; ++i) {
    if (words[i] == std::string("--pictures")) {
      ++i;
      continue;
    }
    auto device = make_device(words[i], devices, pictures, pins);
    if (!device) {
      std::fprintf(stderr, "usb_devices: unknown device: %s\n", words[i]);
      return 2;
    }
    device->command("plug");
    devices[words[i]] = std::move(device);
  }
  run(fifo, devices);
}
