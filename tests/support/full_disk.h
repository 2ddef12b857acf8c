/// @file  Makes writing fail as on a full disk, for as long as the object lives.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace flytri {

/// Lowers this process's largest file size: to write() the same as a disk that is full.
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
