#include "tests/support/read_sheet.h"

#include <fmt/format.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <sstream>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::testing {
namespace {

constexpr double kMmPerInch = 25.4;

/// @param command  takes the names of the input and of the PNG to write
cv::Mat render(const std::string& bytes, const char* input, const std::string& command) {
  const TemporaryFolder folder;
  if (!io::write_file(folder / input, bytes)) return {};
  const std::string run = fmt::format("cd '{}' && {}", folder.path().string(), command);
  if (std::system(run.c_str()) != 0) return {};
  cv::Mat image = cv::imread((folder / "page.png").string(), cv::IMREAD_COLOR);
  if (!image.empty()) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return image;
}

/// Micrometers to millimeters, as the drawing scales its recording.
constexpr double kMmPerUnit = 1e-3;

std::vector<std::vector<Vec2>> subpaths_of(const std::string& path) {
  std::vector<std::vector<Vec2>> polygons;
  std::istringstream words(path);
  double x = 0.0;
  double y = 0.0;
  for (std::string word; words >> word;) {
    if (word == "M") polygons.emplace_back();
    if ((word == "M" || word == "L") && words >> x >> y)
      polygons.back().push_back(kMmPerUnit * Vec2(x, y));
  }
  return polygons;
}

}  // namespace

cv::Mat render_pdf(const std::string& bytes, double px_per_mm) {
  return render(
      bytes, "page.pdf",
      fmt::format("pdftoppm -singlefile -png -r {:.6f} page.pdf page", px_per_mm * kMmPerInch));
}

cv::Mat render_svg(const std::string& bytes, double px_per_mm) {
  // 96 dots per inch are the size that the SVG has by its millimeters.
  return render(bytes, "page.svg",
                fmt::format("rsvg-convert -d {0:.6f} -p {0:.6f} -b white page.svg -o page.png",
                            px_per_mm * kMmPerInch));
}

std::vector<std::vector<Vec2>> polygons_of(const std::string& svg) {
  std::vector<std::vector<Vec2>> polygons;
  // As Cairo 1.16 and 1.18 write them.
  const std::regex path("<path [^>]*fill(?::|=\")rgb[^>]* d=\"([^\"]*)\"");
  const std::regex scaled(R"(matrix\(0\.001, ?0, ?0, ?0\.001, ?0, ?0\))");
  // Only what is drawn in micrometers, and scaled once.
  if (!std::regex_search(svg, scaled)) return polygons;
  for (auto found = std::sregex_iterator(svg.begin(), svg.end(), path);
       found != std::sregex_iterator(); ++found) {
    const auto subpaths = subpaths_of((*found)[1]);
    polygons.insert(polygons.end(), subpaths.begin(), subpaths.end());
  }
  return polygons;
}

}  // namespace flytri::testing
