/// @file  Aravis in C++: owned objects, and its errors as ours. Include it in .cpp files only.
#pragma once

#include <arv.h>

#include <memory>
#include <string>
#include <utility>

#include "core/base/result.h"

namespace flytri::genicam {

struct ObjectReleaser {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <typename T>
using Owned = std::unique_ptr<T, ObjectReleaser>;

struct MemoryReleaser {
  void operator()(gpointer memory) const { g_free(memory); }
};
/// An array that Aravis allocated; its entries belong to Aravis.
template <typename T>
using OwnedArray = std::unique_ptr<T, MemoryReleaser>;

/// What a camera answered: the last argument of Aravis' functions.
class ArvFailure {
 public:
  ArvFailure() = default;
  ~ArvFailure() { g_clear_error(&error_); }
  ArvFailure(const ArvFailure&) = delete;
  ArvFailure& operator=(const ArvFailure&) = delete;

  [[nodiscard]] GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }

  /// @param label  the camera in messages
  /// @param doing  the failed action, e.g. "starting the stream"
  /// @return  kNotFound: it does not answer; kInconsistent: in use; kBadOption: it does not support
  ///          the setting
  [[nodiscard]] Error told(const std::string& label, const std::string& doing) const;

 private:
  GError* error_ = nullptr;
};

}  // namespace flytri::genicam
