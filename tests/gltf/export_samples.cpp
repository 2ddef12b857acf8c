/// @file  Writes a textured and a colored .glb into the folder given on the command line.
#include <cstdio>
#include <filesystem>

#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "tests/support/colored_sphere.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  const flytri::Result<void> written =
      flytri::io::create_folder(folder)
          .and_then([&] {
            return flytri::io::write_model(folder / "textured.glb", flytri::textured_sphere());
          })
          .and_then([&] {
            return flytri::io::write_model(folder / "colored.glb", flytri::colored_sphere());
          });
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 1;
}
