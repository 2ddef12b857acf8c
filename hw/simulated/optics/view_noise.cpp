#include "hw/simulated/optics/view_noise.h"

#include <cmath>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/random.h"

namespace flytri::simulated {
namespace {

// A Gaussian kernel whose squares sum to one, so that it keeps the variance of white noise.
std::vector<double> unit_energy_gaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> kernel;
  double energy = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(sigma > 0.0 ? std::exp(-0.5 * i * i / (sigma * sigma)) : 1.0);
    energy += kernel.back() * kernel.back();
  }
  for (double& weight : kernel) weight /= std::sqrt(energy);
  return kernel;
}

std::vector<double> correlated_normals(std::size_t count, const std::vector<double>& kernel,
                                       Random& random) {
  std::vector<double> white(count + kernel.size() - 1);
  for (double& value : white) value = random.normal();
  std::vector<double> smooth(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < kernel.size(); ++k) smooth[i] += kernel[k] * white[i + k];
  return smooth;
}

void add_normal_noise(Profile& profile, const ViewNoise& noise, const std::vector<double>& kernel,
                      Random& random) {
  const std::vector<double> normals = correlated_normals(profile.points.size(), kernel, random);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    profile.points[i].position_mm.z() += noise.sigma_mm * normals[i];
    profile.points[i].deviation_mm = Vec3f(0.0F, 0.0F, static_cast<float>(noise.sigma_mm));
  }
}

void add_measured_noise(Profile& profile, Pattern pattern, const MeasuredNoise& noise,
                        Random& random) {
  const std::vector<NoiseSample> samples = noise.draw(pattern, profile, random);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    profile.points[i].position_mm.z() += samples[i].off_mm;
    // As in a real view: what the localization states of each sample, not its true noise.
    profile.points[i].deviation_mm = Vec3f(0.0F, 0.0F, samples[i].stated_mm);
  }
}

}  // namespace

Result<void> ViewNoise::validate() const {
  return OptionCheck("ViewNoise")
      .not_negative("sigma_mm", sigma_mm)
      .in_range("correlation_samples", correlation_samples, 0.0, 1000.0)
      .result();
}

View add_noise(const View& ideal, const ViewNoise& noise, std::uint64_t stream) {
  const std::vector<double> kernel = unit_energy_gaussian(noise.correlation_samples);
  Random random(noise.seed, stream);
  View noisy = ideal;
  for (Profile& profile : noisy.profiles) {
    if (noise.measured) {
      add_measured_noise(profile, noisy.pattern, *noise.measured, random);
    } else {
      add_normal_noise(profile, noise, kernel, random);
    }
  }
  return noisy;
}

}  // namespace flytri::simulated
