#include "tests/hardware/usb/uvc_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hw/device/clock.h"

namespace flytri::usb {

namespace {

// Requests of the UVC class (section A.8 of its definition).
constexpr std::uint8_t kSetCurrent = 0x01;
constexpr std::uint8_t kGetMinimum = 0x82;
constexpr std::uint8_t kGetMaximum = 0x83;
constexpr std::uint8_t kGetResolution = 0x84;
constexpr std::uint8_t kGetLength = 0x85;
constexpr std::uint8_t kGetInformation = 0x86;
constexpr std::uint8_t kSetInterface = 11;
constexpr std::uint8_t kClearFeature = 1;
// Controls of the lens entity.
constexpr std::uint8_t kExposureMode = 0x02;
constexpr std::uint8_t kExposurePriority = 0x03;
constexpr std::uint8_t kExposureTime = 0x04;
constexpr std::uint8_t kFocus = 0x06;
constexpr std::uint8_t kFocusAutomatic = 0x08;
// Controls of the processing entity.
constexpr std::uint8_t kGain = 0x04;
constexpr std::uint8_t kWhiteBalance = 0x0a;
constexpr std::uint8_t kWhiteBalanceAutomatic = 0x0b;
// The negotiation of a stream uses "probe" and "commit".
constexpr std::uint8_t kCommit = 0x02;
constexpr std::size_t kNegotiationBytes = 26;
constexpr double kInterval_s = 100e-9;
constexpr double kExposureUnit_s = 100e-6;
constexpr double kMicroframe_s = 125e-6;
/// Delay, in periods, of the exposures of a camera relative to the one in `beside`.
constexpr double kBehind = 0.25;
// Bits of a payload header.
constexpr std::uint8_t kEndOfHead = 0x80;
constexpr std::uint8_t kError = 0x40;
constexpr std::uint8_t kEndOfFrame = 0x02;
constexpr std::uint8_t kHeadBytes = 2;

// Factory settings: all automatic modes on. Exposure modes are bits: manual, automatic, shutter
// priority, aperture priority.
std::vector<UvcControl> factory_controls() {
  return {{kLensEntity, kExposureMode, 1, 1, 8, 0x0f, 8},
          {kLensEntity, kExposurePriority, 1, 0, 1, 1, 1},
          {kLensEntity, kExposureTime, 4, 1, 5000, 1, 156},
          {kLensEntity, kFocus, 2, 0, 250, 5, 50},
          {kLensEntity, kFocusAutomatic, 1, 0, 1, 1, 1},
          {kProcessingEntity, kGain, 2, 0, 63, 1, 10},
          {kProcessingEntity, kWhiteBalance, 2, 2800, 6500, 10, 4600},
          {kProcessingEntity, kWhiteBalanceAutomatic, 1, 0, 1, 1, 1}};
}

double now_s() { return device::machine_clock().now_s(); }

}  // namespace

UvcCamera::UvcCamera(int port, const UvcCameraOptions& options, const LightPins& pins)
    : UsbDevice(port,
                {0x1d6b, 0x0102, 0x0100, {0xef, 2, 1}, "Flytri", options.name, options.serial}, 2,
                uvc_configuration(options.isochronous)),
      options_(options),
      pins_(pins),
      controls_(factory_controls()) {}

std::optional<Bytes> UvcCamera::control(const Setup& setup, const Bytes& data) {
  const std::uint8_t interface = setup.index & 0xff;
  if (setup.is_standard()) {
    if (setup.request == kSetInterface && interface == kStreamInterface && options_.isochronous)
      stream(setup.value != 0);
    // The host ends a bulk stream in this way.
    constexpr std::uint8_t kOfEndpoint = 2;
    if (setup.request == kClearFeature && setup.kind == kOfEndpoint && !options_.isochronous)
      stream(false);
    return std::nullopt;
  }
  return interface == kStreamInterface ? negotiate(setup, data) : answer_entity(setup, data);
}

std::optional<Bytes> UvcCamera::answer_entity(const Setup& setup, const Bytes& data) {
  const auto entity = static_cast<std::uint8_t>(setup.index >> 8);
  const auto selector = static_cast<std::uint8_t>(setup.value >> 8);
  const auto found =
      std::find_if(controls_.begin(), controls_.end(), [&](const UvcControl& candidate) {
        return candidate.entity == entity && candidate.selector == selector;
      });
  if (found == controls_.end()) return std::nullopt;
  Bytes answer;
  switch (setup.request) {
    case kSetCurrent:
      found->value = read_number(data, 0, static_cast<std::size_t>(found->bytes));
      break;
    case kGetMinimum:
      append_number(answer, found->minimum, found->bytes);
      break;
    case kGetMaximum:
      append_number(answer, found->maximum, found->bytes);
      break;
    case kGetResolution:
      append_number(answer, found->resolution, found->bytes);
      break;
    case kGetLength:
      append_number(answer, static_cast<std::uint32_t>(found->bytes), 2);
      break;
    case kGetInformation:
      answer = {3};  // can be read and set
      break;
    default:
      append_number(answer, found->value, found->bytes);
  }
  return answer;
}

std::uint32_t UvcCamera::control_value(std::uint8_t entity, std::uint8_t selector) const {
  for (const UvcControl& candidate : controls_)
    if (candidate.entity == entity && candidate.selector == selector) return candidate.value;
  return 0;
}

std::optional<Bytes> UvcCamera::negotiate(const Setup& setup, const Bytes& data) {
  if (setup.request == kSetCurrent) {
    agree(data);
    if (setup.value >> 8 == kCommit && !options_.isochronous) stream(true);
    return Bytes{};
  }
  if (setup.request == kGetLength) return Bytes{kNegotiationBytes, 0};
  if (setup.request == kGetInformation) return Bytes{3};
  Bytes agreed = {1, 0, static_cast<std::uint8_t>(format_), static_cast<std::uint8_t>(size_ + 1)};
  append_number(agreed, interval_, 4);
  agreed.resize(18);
  append_number(agreed, uvc_image_bytes(format_, kUvcSizes[size_]), 4);
  append_number(agreed, options_.isochronous ? kIsochronousBytes : kBulkBytes, 4);
  return agreed;
}

void UvcCamera::agree(const Bytes& wanted) {
  const std::uint32_t format = read_number(wanted, 2, 1);
  const std::uint32_t size = read_number(wanted, 3, 1);
  const std::uint32_t interval = read_number(wanted, 4, 4);
  if (format >= 1 && format <= 3) format_ = static_cast<UvcFormat>(format);
  if (size >= 1 && size <= kUvcSizes.size()) size_ = size - 1;
  const auto found = std::lower_bound(kUvcIntervals.begin(), kUvcIntervals.end(), interval);
  interval_ = found == kUvcIntervals.end() ? kUvcIntervals.back() : *found;
}

void UvcCamera::stream(bool on) {
  streaming_ = on;
  image_.clear();
  sent_ = 0;
  if (!on) return;
  next_frame_s_ = next_packets_s_ = now_s();
  if (options_.beside)
    next_frame_s_ = options_.beside->next_frame_s_ + kBehind * interval_ * kInterval_s;
  show(place_);
}

void UvcCamera::show(const std::string& place) {
  place_ = place;
  exposures_ = 0;
  const std::string folder = place.empty() ? options_.pictures : options_.pictures + "/" + place;
  picture_ = std::make_unique<Picture>(kUvcSizes[size_], folder, options_.color);
}

void UvcCamera::reset() {
  stream(false);
  controls_ = factory_controls();
}

void UvcCamera::execute(std::string_view word) {
  if (word == "freeze") frozen_ = true;
  if (word == "thaw") frozen_ = false;
  if (word == "short") next_short_ = true;
  if (word == "error") next_error_ = true;
  constexpr std::string_view kPlace = "place:";
  if (word.starts_with(kPlace)) show(std::string(word.substr(kPlace.size())));
}

std::uint32_t UvcCamera::number_at(double time_s) const {
  const double later = std::round((time_s - exposed_s_) / (interval_ * kInterval_s));
  const double number = exposures_ - 1.0 + (streaming_ ? later : 0.0);
  return static_cast<std::uint32_t>(std::max(number, 0.0));
}

// Takes the exposure that ends now. It is lost if the previous image is still being sent.
void UvcCamera::expose(double time_s) {
  const std::uint32_t own_number = exposures_++;
  exposed_s_ = time_s;
  if (frozen_ || !image_.empty()) return;
  const double begin_s =
      time_s - std::min(control_value(kLensEntity, kExposureTime) * kExposureUnit_s,
                        interval_ * kInterval_s);
  const std::uint32_t number = options_.beside ? options_.beside->number_at(time_s) : own_number;
  const Exposure exposure{number, pins_.share(0, begin_s, time_s), pins_.share(1, begin_s, time_s),
                          pins_.share(2, begin_s, time_s), time_s - begin_s};
  image_ = picture_->image(exposure, format_);
  if (std::exchange(next_short_, false)) image_.resize(image_.size() / 2);
  error_ = std::exchange(next_error_, false);
}

Bytes UvcCamera::next_payload(std::size_t room) {
  const std::size_t length = std::min(room - kHeadBytes, image_.size() - sent_);
  const bool last = !image_.empty() && sent_ + length == image_.size();
  const auto bits = static_cast<std::uint8_t>(kEndOfHead | frame_bit_ | (error_ ? kError : 0) |
                                              (last ? kEndOfFrame : 0));
  Bytes payload = {kHeadBytes, bits};
  append(payload, std::span(image_).subspan(sent_, length));
  sent_ += length;
  if (!last) return payload;
  image_.clear();
  sent_ = 0;
  error_ = false;
  frame_bit_ ^= 1U;
  return payload;
}

void UvcCamera::transfer_waits() { do_work(now_s()); }

void UvcCamera::send_bulk() {
  for (; !image_.empty() && !waiting_.empty(); waiting_.pop_front())
    port_.complete(waiting_.front(), next_payload(waiting_.front().length));
}

void UvcCamera::send_packets(double time_s) {
  for (; !waiting_.empty() && time_s >= next_packets_s_; waiting_.pop_front()) {
    const Transfer& transfer = waiting_.front();
    std::vector<Bytes> packets;
    for (const IsoPacket& packet : transfer.packets) packets.push_back(next_payload(packet.length));
    next_packets_s_ += kMicroframe_s * static_cast<double>(transfer.packets.size());
    port_.complete_packets(transfer, packets);
  }
}

void UvcCamera::do_work(double time_s) {
  if (streaming_ && time_s >= next_frame_s_) {
    expose(time_s);
    // If late, do not try to catch up.
    next_frame_s_ = std::max(next_frame_s_ + interval_ * kInterval_s, time_s);
  }
  if (options_.isochronous)
    send_packets(time_s);
  else if (streaming_)
    send_bulk();
}

double UvcCamera::next_work_s() const {
  const double frame_s = streaming_ ? next_frame_s_ : kNever_s;
  const double packets_s = options_.isochronous && !waiting_.empty() ? next_packets_s_ : kNever_s;
  return std::min(frame_s, packets_s);
}

}  // namespace flytri::usb
