/// @file  flytri-lab plot: draws the errors of a study over the arch or over the views.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "app/cli/drawing_files.h"
#include "app/lab/chart.h"
#include "app/lab/studies.h"
#include "core/base/median.h"
#include "core/io/files/file_bytes.h"

namespace flytri::lab {
namespace {

using Json = nlohmann::ordered_json;

struct PlotArguments {
  std::filesystem::path study, output;
  bool force = false;
};

constexpr drawing::Color kBlue{0.05, 0.35, 0.65}, kOrange{0.80, 0.40, 0.05};
constexpr drawing::Color kPale{0.60, 0.70, 0.80};

/// Deviations at the places of a part of the arch.
struct Stretch {
  std::vector<double> off_um;
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double off : off_um) sum += off;
    return sum / static_cast<double>(off_um.size());
  }
  [[nodiscard]] double deviation() const {
    const double middle = mean();
    double sum = 0.0;
    for (const double off : off_um) sum += (off - middle) * (off - middle);
    return std::sqrt(sum / static_cast<double>(off_um.size()));
  }
};

constexpr double kStretch_mm = 2.0;

/// By number of the stretch along the arch.
std::map<int, Stretch> stretches_of(const Json& places) {
  std::map<int, Stretch> stretches;
  for (const Json& place : places) {
    if (place.at(1).is_null()) continue;
    const int number = static_cast<int>(std::floor(place.at(0).get<double>() / kStretch_mm));
    stretches[number].off_um.push_back(place.at(1));
  }
  return stretches;
}

double middle_of(int stretch) { return (stretch + 0.5) * kStretch_mm; }

/// Error over the arch.
Chart standard_tests_chart(const Json& records) {
  Chart chart{"How far the scanned crowns are off, along the arch",
              fmt::format("Mean of each {} mm, above the true surface; {} scans of {} views",
                          kStretch_mm, records.size(), records.front().at("views").get<int>()),
              "along the arch from its middle, mm",
              "off by, µm",
              {}};
  std::map<int, Stretch> all;
  for (const Json& record : records) {
    Curve curve{chart.curves.empty() ? "one scan" : "", {}, {}, kPale, true};
    for (const auto& [number, stretch] : stretches_of(record.at("places"))) {
      curve.points.emplace_back(middle_of(number), stretch.mean());
      auto& off = all[number].off_um;
      off.insert(off.end(), stretch.off_um.begin(), stretch.off_um.end());
    }
    chart.curves.push_back(std::move(curve));
  }
  Curve mean{"all, and standard deviation", {}, {}, kBlue, false};
  for (const auto& [number, stretch] : all) {
    mean.points.emplace_back(middle_of(number), stretch.mean());
    mean.band.emplace_back(stretch.mean() - stretch.deviation(),
                           stretch.mean() + stretch.deviation());
  }
  chart.curves.push_back(std::move(mean));
  return chart;
}

/// The median of all scans with white noise, and the range from the least to the largest.
Curve over_views(const Json& records, const char* stage, const char* name,
                 const drawing::Color& color) {
  Curve curve{name, {}, {}, color, false};
  const Json& first = records.front().at("white").at(stage).at("by_view_um");
  for (std::size_t i = 0; i < first.size(); ++i) {
    std::vector<double> errors;
    for (const Json& record : records) {
      errors.push_back(record.at("white").at(stage).at("by_view_um").at(i));
    }
    std::sort(errors.begin(), errors.end());
    const double views = records.front().at("views").get<double>();
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(first.size());
    curve.points.emplace_back(views * share, quantile_of(errors, 0.5));
    curve.band.emplace_back(errors.front(), errors.back());
  }
  return curve;
}

/// Error over the views.
Chart table2_chart(const Json& records) {
  return {"How far each view is off",
          fmt::format("RMS displacement of its points, best fit, white noise of 30 µm; median and "
                      "range of {} scans",
                      records.size()),
          "view",
          "off by, µm",
          {over_views(records, "live", "real-time", kOrange),
           over_views(records, "final", "optimized together", kBlue)}};
}

Result<void> run(const PlotArguments& arguments) {
  if (auto checked = cli::check_drawing_files({arguments.output}, arguments.force); !checked) {
    return checked;
  }
  const auto text = io::read_file(arguments.study);
  if (!text) return tl::unexpected(text.error());
  const auto study = merged({*text}, {arguments.study.string()});
  if (!study) return tl::unexpected(study.error());
  const std::string name = (*study)["study"];
  const bool is_table2 = name == kTable2Printer.name;
  if (!is_table2 && name != kStandardTestsPrinter.name) {
    return fail(ErrorCode::kBadOption,
                "{}: is a study \"{}\"; only table2 and standard-tests have a plot",
                arguments.study.string(), name);
  }
  try {
    const Json& records = (*study)["records"];
    const drawing::Drawing page =
        draw_chart(is_table2 ? table2_chart(records) : standard_tests_chart(records));
    return cli::write_drawings({{arguments.output, page}});
  } catch (const nlohmann::json::exception&) {
    return fail(ErrorCode::kBadFormat, "a record of {} is incomplete; run the study again",
                arguments.study.string());
  }
}

}  // namespace

void add_plot_command(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = lab.add_subcommand(
      "plot", "Draw the errors of a study: table2 over the views, standard-tests over the arch");
  command->add_option("STUDY", arguments->study, "A whole study, .json")->required();
  command->add_option("-o,--output", arguments->output, "The drawing, .svg or .pdf")->required();
  cli::add_force_option(*command, arguments->force);
  command->footer("Example: flytri-lab plot table2.json -o views.svg");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::lab
