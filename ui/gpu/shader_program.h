/// @file  A vertex and a fragment shader from assets/shaders, compiled and linked.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "ui/gpu/gl_object.h"

namespace flytri::ui {

void delete_program(GLuint name);

class ShaderProgram {
 public:
  ShaderProgram() = default;
  /// @param vertex, fragment  names in assets/shaders, such as "splat.vert". A line `#include "x"`
  ///                          is replaced by the content of assets/shaders/x.
  /// @errors  kNotFound, kNotPermitted; kBadFormat with the driver's log.
  [[nodiscard]] static Result<ShaderProgram> load(std::string_view vertex,
                                                  std::string_view fragment);

  void use() const;
  /// The program must be in use. Ignores a uniform that the shaders do not use.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix3f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  explicit ShaderProgram(GLuint name) : object_(name) {}
  [[nodiscard]] GLint location(const char* name) const;
  GlObject<delete_program> object_;
};

}  // namespace flytri::ui
