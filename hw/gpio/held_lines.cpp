#include "hw/gpio/held_lines.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>

namespace flytri::gpio {

gpio_v2_line_values values_of(const std::vector<int>& values) {
  gpio_v2_line_values bits{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    bits.mask |= std::uint64_t{1} << i;
    if (values[i] != 0) bits.bits |= std::uint64_t{1} << i;
  }
  return bits;
}

gpio_v2_line_request output_request(const std::vector<unsigned>& lines,
                                    const std::vector<int>& values, std::string_view consumer) {
  gpio_v2_line_request request{};
  consumer.copy(request.consumer, std::size(request.consumer) - 1);
  request.num_lines =
      static_cast<std::uint32_t>(std::min<std::size_t>(lines.size(), std::size(request.offsets)));
  std::copy_n(lines.begin(), request.num_lines, request.offsets);
  request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
  request.config.num_attrs = 1;
  gpio_v2_line_config_attribute& attribute = request.config.attrs[0];
  const gpio_v2_line_values bits = values_of(values);
  attribute.attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
  attribute.attr.values = bits.bits;
  attribute.mask = bits.mask;
  return request;
}

int set_lines(int descriptor, const gpio_v2_line_values& values) {
  gpio_v2_line_values sent = values;
  return ioctl(descriptor, GPIO_V2_LINE_SET_VALUES_IOCTL, &sent) == 0 ? 0 : errno;
}

HeldLines::~HeldLines() { close(descriptor_); }

}  // namespace flytri::gpio
