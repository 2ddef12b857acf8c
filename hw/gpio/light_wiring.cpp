#include "hw/gpio/light_wiring.h"

#include <string_view>

#include "core/base/check_options.h"

namespace flytri::gpio {

namespace {

void check_line(const LineMatch& line, std::string_view light, OptionCheck& check) {
  check.must(light, "empty", !line.name.empty() || line.offset, "the name or the number of a line");
  check.must(light, "a name and a number", line.name.empty() || !line.offset, "only one of them");
  if (line.offset) check.not_negative(light, *line.offset);
}

bool same(const LineMatch& a, const LineMatch& b) {
  return a.name == b.name && a.offset == b.offset;
}

}  // namespace

Result<void> LightWiring::validate() const {
  OptionCheck check("LightWiring");
  check.must("chip", "empty", !(chip.label.empty() && chip.serial.empty() && chip.bus_path.empty()),
             "a label, serial number or bus path");
  check_line(vertical, "vertical", check);
  check_line(horizontal, "horizontal", check);
  check.must("horizontal", "the same line as another light", !same(vertical, horizontal),
             "a line of its own");
  if (flash) {
    check_line(*flash, "flash", check);
    check.must("flash", "the same line as another light",
               !same(*flash, vertical) && !same(*flash, horizontal), "a line of its own");
  }
  return check.nested(limits).result();
}

}  // namespace flytri::gpio
