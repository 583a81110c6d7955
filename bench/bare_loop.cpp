#include "bench/bare_loop.h"

#include <GL/glcorearb.h>
// osmesa.h brings the old gl.h, which must come after glcorearb.h.
#include <GL/osmesa.h>
#include <libdeflate.h>

#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace farol::bench {
namespace {

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 view;
uniform mat3 normals;
uniform mat4 clip;
out vec3 eyePosition;
out vec3 eyeNormal;
out vec2 textureUv;
void main() {
    vec4 eye = view * vec4(position, 1.0);
    eyePosition = eye.xyz;
    eyeNormal = normals * normal;
    textureUv = uv;
    gl_Position = clip * eye;
}
)";

constexpr const char* kFragment = R"(#version 450 core
in vec3 eyePosition;
in vec3 eyeNormal;
in vec2 textureUv;
struct Light { vec4 position, spot, attenuation, diffuse, ambient, specular; };
layout(std140, binding = 0) uniform Lights { Light lights[16]; };
uniform int lightCount;
uniform vec3 emissive, ambient, diffuse, specular, globalAmbient;
uniform float shininess;
uniform sampler2D image;
out vec4 color;
void main() {
    vec3 n = normalize(eyeNormal);
    vec3 sum = emissive + ambient * globalAmbient;
    for (int i = 0; i < lightCount; ++i) {
        vec3 l = lights[i].position.xyz;
        float strength = 1.0;
        if (lights[i].position.w != 0.0) {
            l -= eyePosition;
            float d = length(l);
            l /= d;
            strength = 1.0 / (lights[i].attenuation.x + d * lights[i].attenuation.y +
                              d * d * lights[i].attenuation.z);
            if (lights[i].spot.w > -2.0) {
                float c = -dot(l, lights[i].spot.xyz);
                strength *= c < lights[i].spot.w ? 0.0 : pow(c, lights[i].attenuation.w);
            }
        }
        float lambert = max(dot(n, l), 0.0);
        vec3 h = normalize(l + vec3(0.0, 0.0, 1.0));
        float glint = lambert > 0.0 ? pow(max(dot(n, h), 0.0), shininess) : 0.0;
        sum += strength * (ambient * lights[i].ambient.rgb +
                           lambert * diffuse * lights[i].diffuse.rgb +
                           glint * specular * lights[i].specular.rgb);
    }
    color = vec4(clamp(sum, 0.0, 1.0) * texture(image, textureUv).rgb, 1.0);
}
)";

// name, type of pointer
#define BARE_FUNCTIONS(X)                                                      \
    X(AttachShader, PFNGLATTACHSHADERPROC)                                     \
    X(BindBuffer, PFNGLBINDBUFFERPROC)                                         \
    X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                                 \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                               \
    X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)                             \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                                       \
    X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                               \
    X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                               \
    X(BufferData, PFNGLBUFFERDATAPROC)                                         \
    X(Clear, PFNGLCLEARPROC)                                                   \
    X(ClearColor, PFNGLCLEARCOLORPROC)                                         \
    X(ClearDepth, PFNGLCLEARDEPTHPROC)                                         \
    X(ClipControl, PFNGLCLIPCONTROLPROC)                                       \
    X(CompileShader, PFNGLCOMPILESHADERPROC)                                   \
    X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                   \
    X(CreateShader, PFNGLCREATESHADERPROC)                                     \
    X(DepthFunc, PFNGLDEPTHFUNCPROC)                                           \
    X(DrawElements, PFNGLDRAWELEMENTSPROC)                                     \
    X(Enable, PFNGLENABLEPROC)                                                 \
    X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)               \
    X(Finish, PFNGLFINISHPROC)                                                 \
    X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC)               \
    X(FrontFace, PFNGLFRONTFACEPROC)                                           \
    X(GenBuffers, PFNGLGENBUFFERSPROC)                                         \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                               \
    X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)                             \
    X(GenTextures, PFNGLGENTEXTURESPROC)                                       \
    X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                               \
    X(GenerateMipmap, PFNGLGENERATEMIPMAPPROC)                                 \
    X(GetError, PFNGLGETERRORPROC)                                             \
    X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                     \
    X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                         \
    X(LinkProgram, PFNGLLINKPROGRAMPROC)                                       \
    X(PixelStorei, PFNGLPIXELSTOREIPROC)                                       \
    X(RenderbufferStorageMultisample, PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC) \
    X(ShaderSource, PFNGLSHADERSOURCEPROC)                                     \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                         \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                   \
    X(Uniform1f, PFNGLUNIFORM1FPROC)                                           \
    X(Uniform1i, PFNGLUNIFORM1IPROC)                                           \
    X(Uniform3fv, PFNGLUNIFORM3FVPROC)                                         \
    X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)                             \
    X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)                             \
    X(UseProgram, PFNGLUSEPROGRAMPROC)                                         \
    X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                       \
    X(Viewport, PFNGLVIEWPORTPROC)

struct Gl {
#define BARE_MEMBER(name, type) type name = nullptr;
    BARE_FUNCTIONS(BARE_MEMBER)
#undef BARE_MEMBER
    void load() {
#define BARE_LOAD(name, type)                                        \
    name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name)); \
    if (!name) throw std::runtime_error("this GL has no gl" #name);
        BARE_FUNCTIONS(BARE_LOAD)
#undef BARE_LOAD
    }
};

void appendU32(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift));
}

void appendChunk(std::string& out, const std::string& typeAndBytes) {
    appendU32(out, static_cast<std::uint32_t>(typeAndBytes.size() - 4));
    out += typeAndBytes;
    appendU32(out, libdeflate_crc32(0, typeAndBytes.data(), typeAndBytes.size()));
}

}  // namespace

std::string bareEncode(const std::vector<std::uint8_t>& rgba, int width, int height) {
    std::string out("\x89PNG\r\n\x1a\n", 8);
    std::string head("IHDR");
    appendU32(head, static_cast<std::uint32_t>(width));
    appendU32(head, static_cast<std::uint32_t>(height));
    head += std::string("\x08\x02\x00\x00\x00", 5);
    appendChunk(out, head);
    const std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    std::vector<std::uint8_t> rows(h * (1 + 3 * w));
    std::uint8_t* to = rows.data();
    for (std::size_t y = 0; y < h; ++y) {
        const std::uint8_t* from = &rgba[y * w * 4];
        *to++ = 1;
        for (int c = 0; c < 3; ++c) *to++ = from[c];
        for (std::size_t x = 1; x < w; ++x, from += 4)
            for (int c = 0; c < 3; ++c) *to++ = static_cast<std::uint8_t>(from[4 + c] - from[c]);
    }
    libdeflate_compressor* deflate = libdeflate_alloc_compressor(1);
    std::string body("IDAT");
    body.resize(4 + libdeflate_zlib_compress_bound(deflate, rows.size()));
    body.resize(4 + libdeflate_zlib_compress(deflate, rows.data(), rows.size(), body.data() + 4,
                                             body.size() - 4));
    libdeflate_free_compressor(deflate);
    appendChunk(out, body);
    appendChunk(out, "IEND");
    return out;
}

namespace {

struct Vertex {
    glm::vec3 position{0.0F}, normal{0.0F};
    glm::vec2 uv{0.0F};
};

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

struct BareLoop::State {
    render::FramePlan plan;
    OSMesaContext context = nullptr;
    Gl gl;
    std::vector<std::uint8_t> window;  ///< OSMesa's buffer, top row first
    GLuint program = 0, multisampled = 0, lights = 0, white = 0;
    std::vector<GLuint> arrays, textures;

    GLuint shader(GLenum type, const char* text) const {
        const GLuint name = gl.CreateShader(type);
        gl.ShaderSource(name, 1, &text, nullptr);
        gl.CompileShader(name);
        return name;
    }
    void attach(GLenum point, GLenum format) const {
        GLuint buffer = 0;
        gl.GenRenderbuffers(1, &buffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, plan.style.samples, format,
                                          plan.view.size.x, plan.view.size.y);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer);
    }
    GLuint texture(int width, int height, const std::uint8_t* rgba) const {
        GLuint name = 0;
        gl.GenTextures(1, &name);
        gl.BindTexture(GL_TEXTURE_2D, name);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      rgba);
        gl.GenerateMipmap(GL_TEXTURE_2D);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        return name;
    }
    GLuint array(const generator::Mesh& mesh) const {
        std::vector<Vertex> vertices(mesh.positions().size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            vertices[i].position = mesh.positions()[i];
            if (!mesh.normals().empty()) vertices[i].normal = mesh.normals()[i];
            if (!mesh.uvs().empty()) vertices[i].uv = mesh.uvs()[i];
        }
        GLuint name = 0, buffers[2] = {0, 0};
        gl.GenVertexArrays(1, &name);
        gl.BindVertexArray(name);
        gl.GenBuffers(2, buffers);
        gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                      vertices.data(), GL_STATIC_DRAW);
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices().size() * 4),
                      mesh.indices().data(), GL_STATIC_DRAW);
        gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(0));
        gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(12));
        gl.VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(24));
        for (GLuint i = 0; i < 3; ++i) gl.EnableVertexAttribArray(i);
        return name;
    }
    GLint at(const char* name) const { return gl.GetUniformLocation(program, name); }
};

BareLoop::BareLoop(const render::FramePlan& plan, const std::vector<image::Image>& textures)
    : state_(new State) {
    State& s = *state_;
    s.plan = plan;
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              32,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    s.context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!s.context) throw std::runtime_error("OSMesa gives no GL 4.5 core context");
    s.window.resize(static_cast<std::size_t>(plan.view.size.x) *
                    static_cast<std::size_t>(plan.view.size.y) * 4);
    OSMesaMakeCurrent(s.context, s.window.data(), GL_UNSIGNED_BYTE, plan.view.size.x,
                      plan.view.size.y);
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    s.gl.load();
    const Gl& gl = s.gl;
    s.program = gl.CreateProgram();
    gl.AttachShader(s.program, s.shader(GL_VERTEX_SHADER, kVertex));
    gl.AttachShader(s.program, s.shader(GL_FRAGMENT_SHADER, kFragment));
    gl.LinkProgram(s.program);
    GLint linked = 0;
    gl.GetProgramiv(s.program, GL_LINK_STATUS, &linked);
    if (!linked) throw std::runtime_error("the bare loop's shader does not link");
    if (plan.style.samples > 1) {
        gl.GenFramebuffers(1, &s.multisampled);
        gl.BindFramebuffer(GL_FRAMEBUFFER, s.multisampled);
        s.attach(GL_COLOR_ATTACHMENT0, GL_RGBA8);
        s.attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24);
    }
    const std::uint8_t white[] = {255, 255, 255, 255};
    s.white = s.texture(1, 1, white);
    for (const image::Image& image : textures) {
        // Bottom row first, as texture coordinates run.
        image::Image flipped = image;
        const std::size_t stride = static_cast<std::size_t>(image.width) * 4;
        for (int y = 0; y < image.height; ++y)
            std::copy_n(&image.pixels[static_cast<std::size_t>(y) * stride], stride,
                        &flipped.pixels[static_cast<std::size_t>(image.height - 1 - y) * stride]);
        s.textures.push_back(s.texture(image.width, image.height, flipped.pixels.data()));
    }
    for (const render::DrawItem& item : plan.items) s.arrays.push_back(s.array(item.mesh->mesh));
    std::vector<render::EyeLight> lights = plan.lightSets.at(0);
    if (lights.size() > 16) throw std::runtime_error("the bare loop takes 16 lights");
    lights.resize(16);
    gl.GenBuffers(1, &s.lights);
    gl.BindBuffer(GL_UNIFORM_BUFFER, s.lights);
    gl.BufferData(GL_UNIFORM_BUFFER,
                  static_cast<GLsizeiptr>(lights.size() * sizeof(render::EyeLight)), lights.data(),
                  GL_STATIC_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, s.lights);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.DepthFunc(GL_GREATER);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_CULL_FACE);
    gl.ClearDepth(0.0);
}

BareLoop::~BareLoop() {
    OSMesaDestroyContext(state_->context);
    delete state_;
}

std::string BareLoop::frame() {
    const State& s = *state_;
    const Gl& gl = s.gl;
    const render::FramePlan& plan = s.plan;
    gl.BindFramebuffer(GL_FRAMEBUFFER, s.multisampled);
    gl.Viewport(0, 0, plan.view.size.x, plan.view.size.y);
    gl.ClearColor(plan.style.background.r, plan.style.background.g, plan.style.background.b, 1.0F);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.UseProgram(s.program);
    const glm::mat4 clip(plan.view.clip);
    gl.UniformMatrix4fv(s.at("clip"), 1, GL_FALSE, glm::value_ptr(clip));
    gl.Uniform1i(s.at("lightCount"), static_cast<GLint>(plan.lightSets[0].size()));
    gl.Uniform3fv(s.at("globalAmbient"), 1, glm::value_ptr(plan.globalAmbient));
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
        const render::DrawItem& item = plan.items[i];
        gl.UniformMatrix4fv(s.at("view"), 1, GL_FALSE, glm::value_ptr(item.viewFromObject));
        gl.UniformMatrix3fv(s.at("normals"), 1, GL_FALSE, glm::value_ptr(item.normalFromObject));
        gl.Uniform3fv(s.at("emissive"), 1, glm::value_ptr(item.emissive));
        gl.Uniform3fv(s.at("ambient"), 1, glm::value_ptr(item.ambient));
        gl.Uniform3fv(s.at("diffuse"), 1, glm::value_ptr(item.diffuse));
        gl.Uniform3fv(s.at("specular"), 1, glm::value_ptr(item.specular));
        gl.Uniform1f(s.at("shininess"), item.shininess);
        gl.BindTexture(GL_TEXTURE_2D, item.texture < 0
                                          ? s.white
                                          : s.textures[static_cast<std::size_t>(item.texture)]);
        gl.FrontFace(item.mirrored ? GL_CW : GL_CCW);
        gl.BindVertexArray(s.arrays[i]);
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(item.mesh->mesh.indices().size()),
                        GL_UNSIGNED_INT, nullptr);
    }
    if (plan.style.samples > 1) {
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, s.multisampled);
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        gl.BlitFramebuffer(0, 0, plan.view.size.x, plan.view.size.y, 0, 0, plan.view.size.x,
                           plan.view.size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl.Finish();
    if (gl.GetError() != GL_NO_ERROR) throw std::runtime_error("GL error in the bare loop");
    return bareEncode(s.window, plan.view.size.x, plan.view.size.y);
}

}  // namespace farol::bench
