/// @file  An emulated USB camera for the kernel's uvcvideo driver; it shows the lights of the pins.
#pragma once

#include <memory>

#include "tests/hardware/usb/light_pins.h"
#include "tests/hardware/usb/picture.h"
#include "tests/hardware/usb/usb_device.h"
#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

class UvcCamera;

struct UvcCameraOptions {
  std::string name;
  std::string serial;
  bool isochronous = false;  ///< else bulk transfers
  std::string pictures;      ///< folder, see Picture
  bool color = false;        ///< color images from the folder, in MJPEG
  /// Show the same moments as this camera, which must exist longer; null: count own exposures.
  const UvcCamera* beside = nullptr;
};

/// A control with its range.
struct UvcControl {
  std::uint8_t entity;
  std::uint8_t selector;
  int bytes;
  std::uint32_t minimum;
  std::uint32_t maximum;
  std::uint32_t resolution;
  std::uint32_t value;
};

/// Commands: "freeze": stop sending frames; "thaw": send frames again; "short": half of the next
/// frame is missing; "error": the next frame is marked as damaged; "place:NAME": show the pictures
/// of this subfolder, from the first on.
class UvcCamera final : public UsbDevice {
 public:
  UvcCamera(int port, const UvcCameraOptions& options, const LightPins& pins);

  /// Number of the exposure whose end is nearest to `time_s`, including future ones.
  [[nodiscard]] std::uint32_t number_at(double time_s) const;

 private:
  std::optional<Bytes> control(const Setup& setup, const Bytes& data) override;
  void receive(const Transfer&) override {}
  void transfer_waits() override;
  void execute(std::string_view word) override;
  void reset() override;
  void do_work(double now_s) override;
  double next_work_s() const override;

  [[nodiscard]] std::optional<Bytes> answer_entity(const Setup& setup, const Bytes& data);
  [[nodiscard]] std::optional<Bytes> negotiate(const Setup& setup, const Bytes& data);
  void agree(const Bytes& wanted);
  [[nodiscard]] std::uint32_t control_value(std::uint8_t entity, std::uint8_t selector) const;
  void stream(bool on);
  void show(const std::string& place);
  void expose(double now_s);
  void send_bulk();
  void send_packets(double now_s);
  [[nodiscard]] Bytes next_payload(std::size_t room);

  const UvcCameraOptions options_;
  const LightPins& pins_;
  std::vector<UvcControl> controls_;
  UvcFormat format_ = UvcFormat::kGrey;
  std::size_t size_ = 0;  // index
  std::uint32_t interval_ = kUvcIntervals[1];

  bool streaming_ = false;
  bool frozen_ = false;
  bool next_short_ = false;
  bool next_error_ = false;
  bool error_ = false;      // the image being sent is damaged
  double exposed_s_ = 0.0;  // end of the latest exposure
  double next_frame_s_ = 0.0;
  double next_packets_s_ = 0.0;
  std::uint32_t exposures_ = 0;
  std::string place_;  // subfolder of the pictures
  std::unique_ptr<Picture> picture_;
  Bytes image_;           // image being sent; empty: none
  std::size_t sent_ = 0;  // bytes sent of the image
  std::uint8_t frame_bit_ = 0;
};

}  // namespace flytri::usb
