#include "ui/gpu/shader_program.h"

#include <sstream>

#include "ui/gpu/asset_path.h"

namespace flytri::ui {
namespace {

void delete_shader(GLuint name) { glDeleteShader(name); }
using Shader = GlObject<delete_shader>;

/// The text of a shader with its includes in place.
Result<std::string> shader_text(std::string_view name) {
  Result<std::string> text = read_asset("shaders/" + std::string(name));
  if (!text) return text;
  std::istringstream lines(*text);
  std::string whole;
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kInclude = "#include \"";
    if (!line.starts_with(kInclude)) {
      whole += line + '\n';
      continue;
    }
    const std::size_t end = line.rfind('"');
    Result<std::string> part =
        shader_text(std::string_view(line).substr(kInclude.size(), end - kInclude.size()));
    if (!part) return part;
    whole += *part;
  }
  return whole;
}

Result<Shader> compile(GLenum kind, std::string_view name) {
  const Result<std::string> text = shader_text(name);
  if (!text) return tl::unexpected(text.error());
  Shader shader(glCreateShader(kind));
  const char* source = text->c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(2000, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return fail(ErrorCode::kBadFormat,
              "shader {} does not compile: {}. Reinstall flytri, or update the graphics "
              "driver",
              name, log);
}

}  // namespace

void delete_program(GLuint name) { glDeleteProgram(name); }

Result<ShaderProgram> ShaderProgram::load(std::string_view vertex, std::string_view fragment) {
  const Result<Shader> vertex_shader = compile(GL_VERTEX_SHADER, vertex);
  if (!vertex_shader) return tl::unexpected(vertex_shader.error());
  const Result<Shader> fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
  if (!fragment_shader) return tl::unexpected(fragment_shader.error());
  ShaderProgram program(glCreateProgram());
  const GLuint name = program.object_.name();
  glAttachShader(name, vertex_shader->name());
  glAttachShader(name, fragment_shader->name());
  glLinkProgram(name);
  GLint linked = GL_FALSE;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::string log(2000, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(name, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return fail(ErrorCode::kBadFormat,
              "shaders {} and {} do not link: {}. Reinstall flytri, or update the graphics "
              "driver",
              vertex, fragment, log);
}

void ShaderProgram::use() const { glUseProgram(object_.name()); }

GLint ShaderProgram::location(const char* name) const {
  return glGetUniformLocation(object_.name(), name);
}

void ShaderProgram::set(const char* name, int value) const { glUniform1i(location(name), value); }
void ShaderProgram::set(const char* name, float value) const { glUniform1f(location(name), value); }
void ShaderProgram::set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(location(name), 1, value.data());
}
void ShaderProgram::set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(location(name), 1, value.data());
}
void ShaderProgram::set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(location(name), 1, value.data());
}
void ShaderProgram::set(const char* name, const Eigen::Matrix3f& value) const {
  glUniformMatrix3fv(location(name), 1, GL_FALSE, value.data());
}
void ShaderProgram::set(const char* name, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

}  // namespace flytri::ui
