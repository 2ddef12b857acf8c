#include "tests/support/case_samples.h"

#include <sqlcipher/sqlite3.h>
#include <array>
#include <memory>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/base/random.h"

namespace flytri::testing {
namespace {

template <typename T>
bool same_bits_of(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool same_bits_of(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

bool same_bits_of(const Vec3f& a, const Vec3f& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(float)) == 0;
}

bool same_bits_of(const ProfilePoint& a, const ProfilePoint& b) {
  return same_bits_of(a.position_mm, b.position_mm) &&
         same_bits_of(a.deviation_mm, b.deviation_mm) && same_bits_of(a.along_px, b.along_px);
}

template <typename T, typename Same>
bool all_same(const std::vector<T>& a, const std::vector<T>& b, const Same& same) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

Profile sample_profile(int line, int point_count, Random& random) {
  Profile profile{LineIndex(line), Vec3(0.8, 0.1 * line, -0.6).normalized(), {}};
  const double x_mm = 2.0 * line - 9.0;
  for (int i = 0; i < point_count; ++i) {
    const double y_mm = 0.025 * i - 5.0;
    const Vec3 position_mm(x_mm + 0.003 * random.normal(), y_mm,
                           std::sin(x_mm + y_mm) + 0.03 * random.normal());
    // Along the camera's ray; larger for deeper points.
    const Vec3 ray = (position_mm + Vec3(10.0, 0.0, 60.0)) / 60.0;
    const Vec3f deviation_mm = (0.014 * ray * (1.0 + 0.02 * random.normal())).cast<float>();
    profile.points.push_back({position_mm, deviation_mm, static_cast<float>(100 + i)});
  }
  return profile;
}

}  // namespace

View sample_view(int frame, int line_count, int points_per_line) {
  View view{frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal,
            FrameIndex(frame),
            frame / 30.0,
            {}};
  Random random(17, static_cast<std::uint64_t>(frame));
  for (int line = 0; line < line_count; ++line) {
    view.profiles.push_back(sample_profile(line, points_per_line, random));
  }
  return view;
}

Frame sample_texture(int frame, ImageSize size) {
  cv::Mat image(size.height_px, size.width_px, CV_8UC3);
  Random random(18, static_cast<std::uint64_t>(frame));
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto noise = static_cast<int>(random.below(8));
      image.at<cv::Vec3b>(v, u) = {cv::saturate_cast<uchar>(200 * u / image.cols + noise),
                                   cv::saturate_cast<uchar>(200 * v / image.rows + noise),
                                   cv::saturate_cast<uchar>(90 + noise)};
    }
  }
  return {FrameIndex(frame), FrameKind::kTexture, frame / 30.0, image};
}

Isometry sample_pose(int number) {
  Twist twist;
  twist << 0.1 * number, -0.7, 2.0, std::sqrt(5.0 + number), -6.0 / 7.0, 7.5;
  return exp_twist(twist);
}

editing::Edit sample_edit(int number) {
  editing::Edit edit{static_cast<editing::EditKind>(number % 3), number / 7.0, {}};
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(std::sqrt(number + i + 2.0));
    edit.dabs.push_back({Vec3f(x, -x, 0.5F), Vec3f(0.6F, 0.0F, 0.8F), 0.3F * x});
  }
  return edit;
}

bool same_bits(const View& a, const View& b) {
  return a.pattern == b.pattern && a.frame == b.frame && same_bits_of(a.time_s, b.time_s) &&
         all_same(a.profiles, b.profiles, [](const Profile& p, const Profile& q) {
           return p.line == q.line && same_bits_of(p.sheet_normal, q.sheet_normal) &&
                  all_same(p.points, q.points, [](const ProfilePoint& x, const ProfilePoint& y) {
                    return same_bits_of(x, y);
                  });
         });
}

bool same_bits(const Isometry& a, const Isometry& b) {
  return std::memcmp(a.data(), b.data(), 16 * sizeof(double)) == 0;
}

bool same_bits(const editing::Edit& a, const editing::Edit& b) {
  return a.kind == b.kind && same_bits_of(a.made_at_s, b.made_at_s) &&
         all_same(a.dabs, b.dabs, [](const editing::BrushDab& x, const editing::BrushDab& y) {
           return same_bits_of(x.center_mm, y.center_mm) && same_bits_of(x.normal, y.normal) &&
                  same_bits_of(x.radius_mm, y.radius_mm);
         });
}

bool same_bits(const Frame& a, const Frame& b) {
  const cv::Mat &p = a.image, &q = b.image;
  return a.index == b.index && a.kind == b.kind && same_bits_of(a.time_s, b.time_s) &&
         p.size() == q.size() && p.type() == q.type() && p.isContinuous() && q.isContinuous() &&
         std::memcmp(p.data, q.data, p.total() * p.elemSize()) == 0;
}

Result<void> append_registered_views(io::CaseFile& file, io::ScanStage stage, int first,
                                     int count) {
  for (int i = first; i < first + count; ++i) {
    const auto view = std::make_shared<const View>(sample_view(i, 2, 20));
    if (auto done = file.append_view(stage, *view); !done) return done;
    const std::array placed = {AlignedView{view, sample_pose(i)}};
    if (auto done = file.write_poses(stage, placed); !done) return done;
    const std::array frames = {
        io::StoredFrame{FrameIndex(i), i / 30.0, FrameKind::kVertical, "registered", ""}};
    if (auto done = file.write_frames(stage, frames); !done) return done;
  }
  return {};
}

io::StoredMargin sample_margin(int points) {
  io::StoredMargin margin;
  margin.clicks_mm = {Vec3(1.0 / 3.0, 0.0, 2e-17), Vec3(-4.0, 5.5, 0.1), Vec3(3.0, -2.0, 1.0)};
  margin.margin.line.is_closed = true;
  for (int i = 0; i < points; ++i) {
    const double sigma_mm = i == 1 ? std::numeric_limits<double>::infinity() : 0.01 + 0.001 * i;
    margin.margin.line.points.push_back(
        {Vec3(std::cos(0.5 * i), std::sin(0.5 * i), i / 7.0), sigma_mm});
  }
  margin.margin.edge_share = 11.0 / 12.0;
  margin.margin.least_turn_rad = 0.7;
  return margin;
}

std::string run_sql(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  const int code = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
  const std::string message = code == SQLITE_OK ? "" : sqlite3_errmsg(database);
  sqlite3_close(database);
  return message;
}

void make_version_1(const std::filesystem::path& path) {
  (void)run_sql(path, "DROP TABLE events; PRAGMA user_version = 1;");
}

}  // namespace flytri::testing
