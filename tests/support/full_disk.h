/// @file  Makes writes fail as on a full disk.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace flytri {

/// While it exists, limits the file size of this process, so that write() fails as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes_left) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit = {bytes_left, former_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &former_); }

 private:
  rlimit former_{};
};

}  // namespace flytri
