#include "render/gl/program.h"

#include <array>
#include <span>
#include <stdexcept>

#include "scene/embedded.h"

namespace farol {
std::span<const EmbeddedFile> shaderFiles();
}

namespace farol::render::gl {
namespace {

std::string_view shaderText(const std::string& name) {
    for (const EmbeddedFile& file : shaderFiles())
        if (file.name == name) return file.bytes;
    throw std::logic_error("no shader " + name);
}

/// Deletes the shader once it is linked (or not).
class Shader {
  public:
    Shader(const Api& api, GLenum type, const std::string& name, const std::string& defines)
        : api_(api), shader_(api.CreateShader(type)) {
        const std::string head = "#version 450 core\n" + defines;
        const std::string_view common =
            name.starts_with("model") ? shaderText("common.glsl") : std::string_view{};
        const std::string_view surface =
            name == "model.frag" ? shaderText("surface.glsl") : std::string_view{};
        const std::string_view texture =
            name == "model.frag" ? shaderText("texture.glsl") : std::string_view{};
        const std::string_view body = shaderText(name);
        const std::string text = head + std::string(common) + std::string(texture) +
                                 std::string(surface) + std::string(body);
        const GLchar* const data = text.data();
        const auto size = static_cast<GLint>(text.size());
        api_.ShaderSource(shader_, 1, &data, &size);
        api_.CompileShader(shader_);
        GLint done = 0;
        api_.GetShaderiv(shader_, GL_COMPILE_STATUS, &done);
        if (done) return;
        std::array<GLchar, 2048> log{};
        api_.GetShaderInfoLog(shader_, static_cast<GLsizei>(log.size()), nullptr, log.data());
        api_.DeleteShader(shader_);
        throw std::runtime_error("shader " + name + " does not compile: " + log.data() + defines);
    }
    ~Shader() { api_.DeleteShader(shader_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return shader_; }

  private:
    const Api& api_;
    GLuint shader_;
};

}  // namespace

const LinkedProgram& ProgramCache::get(const ProgramKey& key) {
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    // The block's binding stands in the text, so that no call is needed to set it.
    const Shader vertex(api_, GL_VERTEX_SHADER, key.stage + ".vert", key.defines);
    const Shader fragment(api_, GL_FRAGMENT_SHADER, key.stage + ".frag", key.defines);
    LinkedProgram linked;
    linked.program = Program(api_);
    const GLuint program = linked.program.name();
    api_.AttachShader(program, vertex.name());
    api_.AttachShader(program, fragment.name());
    api_.LinkProgram(program);
    GLint done = 0;
    api_.GetProgramiv(program, GL_LINK_STATUS, &done);
    if (!done) {
        std::array<GLchar, 2048> log{};
        api_.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw std::runtime_error("program " + key.stage + " does not link: " + log.data());
    }
    const auto at = [&](const char* name) { return api_.GetUniformLocation(program, name); };
    linked.viewFromObject = at("viewFromObject");
    linked.normalFromObject = at("normalFromObject");
    linked.clipFromView = at("clipFromView");
    linked.worldFromView = at("worldFromView");
    linked.materialDiffuse = at("materialDiffuse");
    linked.materialBase = at("materialBase");
    linked.materialAmbient = at("materialAmbient");
    linked.materialSpecular = at("materialSpecular");
    linked.materialShininess = at("materialShininess");
    linked.unitFromObject = at("unitFromObject");
    linked.unitEye = at("unitEye");
    linked.surfaceLengths = at("surfaceLengths");
    linked.surfaceForm = at("surfaceForm");
    linked.surfaceUv = at("surfaceUv");
    linked.surfaceDiscs = at("surfaceDiscs");
    linked.balance = at("balance");
    linked.seenFrom = at("seenFrom");
    linked.lightCount = at("lightCount");
    linked.plainColor = at("plainColor");
    linked.planeS = at("planeS");
    linked.planeT = at("planeT");
    linked.nearest = at("nearest");
    linked.tangents = at("tangents");
    return programs_.emplace(key, std::move(linked)).first->second;
}

}  // namespace farol::render::gl
