#include "render/gl/program.h"

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/embedded.h"

namespace farol {
std::span<const EmbeddedFile> shaderFiles();
}

namespace farol::render::gl {
namespace {

struct FeatureName {
    Feature feature;
    const char* name;
    bool counted = false;
};

/// Features as the shaders know them, in the order of the enum.
constexpr std::array<FeatureName, kFeatures> kNames{{
    {Feature::layerId, "LAYER_ID"},
    {Feature::layerNormal, "LAYER_NORMAL"},
    {Feature::layerDepth, "LAYER_DEPTH"},
    {Feature::lightCount, "LIGHT_COUNT", true},
    {Feature::unlit, "UNLIT"},
    {Feature::chess, "CHESS"},
    {Feature::flat, "FLAT"},
    {Feature::gouraud, "GOURAUD"},
    {Feature::phong, "PHONG"},
    {Feature::positional, "POSITIONAL"},
    {Feature::spot, "SPOT"},
    {Feature::specular, "SPECULAR"},
    {Feature::localViewer, "LOCAL_VIEWER"},
    {Feature::separateSpecular, "SEPARATE_SPECULAR"},
    {Feature::shadowed, "SHADOWED", true},
    {Feature::shadowCascade, "SHADOW_CASCADE", true},
    {Feature::shadowCube, "SHADOW_CUBE", true},
    {Feature::markNotFinite, "MARK_NOT_FINITE"},
    {Feature::textured, "TEXTURED"},
    {Feature::filterMipmap, "FILTER_MIPMAP"},
    {Feature::filterAnisotropic, "FILTER_ANISOTROPIC"},
    {Feature::mappingSphere, "MAPPING_SPHERE"},
    {Feature::texgenObject, "TEXGEN_OBJECT"},
    {Feature::texgenEye, "TEXGEN_EYE"},
    {Feature::supersampled, "SUPERSAMPLED"},
    {Feature::vertexColor, "VERTEX_COLOR"},
    {Feature::alphaTest, "ALPHA_TEST"},
    {Feature::eachSample, "EACH_SAMPLE", true},
    {Feature::blended, "BLENDED"},
    {Feature::peeled, "PEELED"},
    {Feature::surface, "SURFACE"},
    {Feature::surfaceCaps, "SURFACE_CAPS"},
    {Feature::surfaceProfile, "SURFACE_PROFILE"},
    {Feature::surfaceWrapsV, "SURFACE_WRAPS_V"},
    {Feature::surfaceRay, "SURFACE_RAY"},
    {Feature::surfaceTwoSteps, "SURFACE_TWO_STEPS"},
    {Feature::surfaceTurnFromX, "SURFACE_TURN_FROM_X"},
    {Feature::surfaceDiscUv, "SURFACE_DISC_UV"},
    {Feature::exactDepth, "EXACT_DEPTH"},
    {Feature::carried, "CARRIED"},
    {Feature::eyePositions, "EYE_POSITIONS"},
    {Feature::instanced, "INSTANCED"},
    {Feature::skybox, "SKYBOX"},
    {Feature::layer, "LAYER"},
    {Feature::resolve, "RESOLVE", true},
}};
constexpr bool isInOrder() {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (static_cast<std::size_t>(kNames[i].feature) != i) return false;
    return true;
}
static_assert(isInOrder());

std::string definesOf(const ProgramKey& key) {
    std::string text;
    for (const FeatureName& row : kNames) {
        if (!key.features.has(row.feature)) continue;
        text += std::string("#define ") + row.name;
        const int count = row.feature == Feature::eachSample      ? key.samples
                          : row.feature == Feature::shadowed      ? key.shadows
                          : row.feature == Feature::shadowCascade ? key.shadowCascades
                          : row.feature == Feature::shadowCube    ? key.shadowCubes
                                                                  : key.count;
        if (row.counted) text += ' ' + std::to_string(count);
        text += '\n';
    }
    return text;
}

std::string stem(Shaders shaders) {
    return shaders == Shaders::model ? "model" : shaders == Shaders::line ? "line" : "window";
}

std::string_view shaderText(const std::string& name) {
    for (const EmbeddedFile& file : shaderFiles())
        if (file.name == name) return file.bytes;
    throw std::logic_error("no shader " + name);
}

/// Deletes the shader once it is linked (or not).
class Shader {
  public:
    Shader(const Api& api, GLenum type, const std::string& name, const std::string& defines,
           std::string_view surfaceKind)
        : api_(api), shader_(api.CreateShader(type)) {
        const std::string head = "#version 450 core\n" + defines;
        const std::string_view common =
            name.starts_with("model") ? shaderText("common.glsl") : std::string_view{};
        std::string parts;
        if (name == "model.frag")
            parts.append(shaderText("shadow.glsl"))
                .append(shaderText("texture.glsl"))
                .append(shaderText("surface.glsl"))
                .append(surfaceKind);
        const std::string text = head + std::string(common) + parts + std::string(shaderText(name));
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
    const std::string name = stem(key.shaders), defines = definesOf(key);
    // The block's binding stands in the text, so that no call is needed to set it.
    const Shader vertex(api_, GL_VERTEX_SHADER, name + ".vert", defines, {});
    const Shader fragment(api_, GL_FRAGMENT_SHADER, name + ".frag", "#define FRAGMENT\n" + defines,
                          key.surfaceKind);
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
        throw std::runtime_error("program " + name + " does not link: " + log.data());
    }
    const auto at = [&](const char* uniform) { return api_.GetUniformLocation(program, uniform); };
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
    linked.uvFrom = at("uvFrom");
    linked.mappedFrom = at("mappedFrom");
    linked.nearest = at("nearest");
    linked.tangents = at("tangents");
    linked.samplesAcross = at("samplesAcross");
    linked.opacity = at("opacity");
    linked.samplePlaces = at("samplePlaces");
    linked.shadowOffset = at("shadowOffset");
    return programs_.emplace(key, std::move(linked)).first->second;
}

}  // namespace farol::render::gl
