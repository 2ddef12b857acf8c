/// @file  flytri make: the slides of the projectors and the targets of the calibration, at true
/// scale.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/design_options.h"
#include "app/cli/drawing_files.h"
#include "app/cli/output_files.h"
#include "hw/sheets/slide_sheet.h"
#include "hw/sheets/target_sheets.h"
#include "hw/shots/simulated_shots.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct MakeArguments {
  fs::path output;
  DesignArguments design;
  double projector_focal_mm = 0.0;
  std::vector<double> dots_mm;
  bool force = false;

  [[nodiscard]] Result<simulated::SensorModel> sensor() const {
    return design.layout().map([&](const simulated::SensorLayout& layout) {
      simulated::SensorModel model = make_sensor(layout);
      if (!dots_mm.empty()) model.dots = {dots_mm[0], dots_mm[1], dots_mm[2]};
      return model;
    });
  }
};

/// NAME.svg and vertical: NAME-vertical.svg.
fs::path slide_path(const fs::path& output, Pattern pattern) {
  fs::path path = output;
  path.replace_filename(fmt::format("{}-{}{}", output.stem().string(), to_string(pattern),
                                    output.extension().string()));
  return path;
}

Result<void> make_slides(const MakeArguments& arguments) {
  std::vector<fs::path> paths;
  paths.reserve(kPatterns.size());
  for (const Pattern pattern : kPatterns) paths.push_back(slide_path(arguments.output, pattern));
  if (auto checked = check_drawing_files(paths, arguments.force); !checked) return checked;
  const auto sensor = arguments.sensor();
  if (!sensor) return tl::unexpected(sensor.error());
  std::vector<sheets::SlideSheet> slides;
  for (const Pattern pattern : kPatterns) {
    auto slide = sheets::slide_sheet(sensor->projector(pattern), arguments.projector_focal_mm);
    if (!slide) return tl::unexpected(slide.error());
    slides.push_back(*std::move(slide));
  }
  std::vector<DrawingFile> files;
  for (std::size_t i = 0; i < slides.size(); ++i)
    files.push_back({paths[i], slides[i].sheet.drawing});
  if (auto written = write_drawings(files); !written) return written;
  for (const Pattern pattern : kPatterns) {
    const sheets::Slide& slide = slides[static_cast<std::size_t>(pattern)].slide;
    print_out("{}: {} lines, {:.2f} µm wide, {:.3f} mm before the lens\n", to_string(pattern),
              slide.line_middle_mm.size(), 1e3 * slide.line_width_mm, slide.distance_mm);
  }
  return {};
}

using MakeTarget = Result<sheets::TargetSheet> (*)(const simulated::SensorModel&, double);

Result<void> make_target(const MakeArguments& arguments, MakeTarget make) {
  if (auto checked = check_drawing_files({arguments.output}, arguments.force); !checked) {
    return checked;
  }
  const auto sensor = arguments.sensor();
  if (!sensor) return tl::unexpected(sensor.error());
  const auto target = make(*sensor, shots::plan_of(*sensor).z_mm.back());
  if (!target) return tl::unexpected(target.error());
  const Vec2 size_mm = target->most_mm - target->least_mm;
  if (auto written = write_drawings({{arguments.output, target->sheet.drawing}}); !written) {
    return written;
  }
  print_out("{:.1f} x {:.1f} mm on {}\n", size_mm.x(), size_mm.y(), target->sheet.paper);
  return {};
}

CLI::App* add_sheet(CLI::App& make, const char* name, const char* help, MakeArguments& arguments) {
  CLI::App* command = make.add_subcommand(name, help);
  command->add_option("-o,--output", arguments.output, "File to write: .svg or .pdf")->required();
  add_design_options(*command, arguments.design);
  add_force_option(*command, arguments.force);
  return command;
}

}  // namespace

void add_make_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<MakeArguments>();
  CLI::App* make = app.add_subcommand("make", "Draw slides and calibration targets at true scale");
  make->require_subcommand(1);

  CLI::App* slides = add_sheet(*make, "slides", "Draw the slide of each projector", *arguments);
  slides
      ->add_option("--projector-focal-mm", arguments->projector_focal_mm,
                   "Focal length of the lens of the projectors, mm")
      ->required();
  slides->footer(
      "Writes NAME-vertical and NAME-horizontal.\n"
      "Example: flytri make slides -o slide.pdf --projector-focal-mm 12");
  slides->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return make_slides(*arguments); };
  });

  CLI::App* target = add_sheet(*make, "target", "Draw the dot target", *arguments);
  target
      ->add_option("--dots", arguments->dots_mm,
                   "Dots, mm: pitch, diameter, large diameter. Default: those of the sensor")
      ->expected(3);
  target->footer("Example: flytri make target -o dots.pdf");
  target->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) {
      return make_target(*arguments, sheets::dot_sheet);
    };
  });

  CLI::App* hand_board =
      add_sheet(*make, "hand-board", "Draw the dotted board for a calibration by hand", *arguments);
  hand_board->footer("Example: flytri make hand-board -o hand-board.pdf");
  hand_board->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) {
      return make_target(*arguments, sheets::hand_board_sheet);
    };
  });

  CLI::App* board = add_sheet(*make, "board", "Draw the white board", *arguments);
  board->footer("Example: flytri make board -o board.pdf");
  board->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) {
      return make_target(*arguments, sheets::board_sheet);
    };
  });
}

}  // namespace flytri::cli
