#include "ui/scene/coloring.h"

#include <array>

namespace flytri::ui {

namespace {

void set_undercut_colors(const ShaderProgram& program) {
  program.set("deep_undercut_mm", static_cast<float>(kDeepUndercut_mm));
  program.set("free_color", rgb_of(kFreeColor));
  constexpr std::array<const char*, 3> kDepths = {"undercut_ramp[0]", "undercut_ramp[1]",
                                                  "undercut_ramp[2]"};
  for (std::size_t i = 0; i < kDepths.size(); ++i) {
    const double share = static_cast<double>(i) / (kDepths.size() - 1);
    program.set(kDepths[i], rgb_of(undercut_color(share)));
  }
}

}  // namespace

void set_coloring(const ShaderProgram& program, const SceneOptions& options) {
  program.set("color_mode", static_cast<int>(options.color_mode));
  program.set("texture_blend", static_cast<float>(options.texture_blend));
  program.set("good_color", rgb_of(options.good_color));
  program.set("thin_color", rgb_of(options.thin_color));
  program.set("max_sigma_mm", static_cast<float>(options.max_sigma_mm));
  constexpr std::array<const char*, 5> kRamp = {"sigma_ramp[0]", "sigma_ramp[1]", "sigma_ramp[2]",
                                                "sigma_ramp[3]", "sigma_ramp[4]"};
  for (std::size_t i = 0; i < kRamp.size(); ++i) {
    program.set(kRamp[i], rgb_of(sigma_color(static_cast<double>(i) / (kRamp.size() - 1))));
  }
  program.set("contact_mm", static_cast<float>(options.contact_mm));
  program.set("far_clearance_mm", static_cast<float>(kFarClearance_mm));
  program.set("contact_color", rgb_of(kContactColor));
  program.set("penetration_color", rgb_of(kPenetrationColor));
  constexpr std::array<const char*, 4> kClearances = {"clearance_ramp[0]", "clearance_ramp[1]",
                                                      "clearance_ramp[2]", "clearance_ramp[3]"};
  for (std::size_t i = 0; i < kClearances.size(); ++i) {
    const double share = static_cast<double>(i) / (kClearances.size() - 1);
    program.set(kClearances[i], rgb_of(clearance_color(share)));
  }
  set_undercut_colors(program);
}

bool look_same(const SceneOptions& a, const SceneOptions& b) {
  return a.color_mode == b.color_mode && a.texture_blend == b.texture_blend &&
         a.good_color == b.good_color && a.thin_color == b.thin_color &&
         a.max_sigma_mm == b.max_sigma_mm && a.contact_mm == b.contact_mm &&
         a.T_open_closed.matrix() == b.T_open_closed.matrix();
}

Eigen::Vector3f rgb_of(const Color& color) { return {color[0], color[1], color[2]}; }

}  // namespace flytri::ui
