// Makes a textured model from a recording and a calibration.
//     reconstruct_recording RECORDING CALIBRATION.json MODEL.glb
#include <flytri/core/io/calibrations/calibration_file.h>
#include <flytri/core/io/models/model.h>
#include <flytri/core/io/recordings/recording.h>
#include <flytri/core/reconstruct/reconstruct.h>

#include <cstdio>

flytri::Result<void> reconstruct_recording(const char* folder, const char* calibration_file,
                                           const char* model_file) {
  const auto recording = flytri::io::open_recording(folder);
  if (!recording) return tl::unexpected(recording.error());
  const auto calibration = flytri::io::read_calibration(calibration_file);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto reconstruction = flytri::reconstruct::reconstruct(
      *recording, *calibration, {}, flytri::Workers(), flytri::Progress());
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  return flytri::io::write_model(model_file, reconstruction->model);
}

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: reconstruct_recording RECORDING CALIBRATION.json MODEL.glb\n", stderr);
    return 2;
  }
  const auto written = reconstruct_recording(argv[1], argv[2], argv[3]);
  if (!written) {
    std::fprintf(stderr, "%s\n", written.error().message.c_str());
    return 1;
  }
  std::printf("wrote %s\n", argv[3]);
}
