#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/gl/box_mean.h"
#include "render/gl/mesh_store.h"
#include "render/gl/painter.h"
#include "render/gl/peeler.h"
#include "render/gl/program.h"
#include "render/gl/shadow_store.h"
#include "render/gl/target.h"
#include "render/gl/texture_store.h"

namespace farol::render::gl {

constexpr std::size_t kMeshBytes = std::size_t{256} << 20;
constexpr std::size_t kTextureBytes = std::size_t{384} << 20;

/// The maps of a light that has some.
const EyeShadowLight& shadowLightOf(const FramePlan& plan, const EyeLight& light);

/// The program of a batch in a pass.
ProgramKey keyOf(const FramePlan& plan, const Pass& pass, const Batch& batch);

/// The GL objects of a painter, which outlive a frame. painter.cpp prepares, runs and reads the
/// passes; draws.cpp has the draw calls within one.
struct Painter::State {
    std::unique_ptr<Context> context;
    const Api& api = context->api();
    const GlFacts& facts = context->facts();
    ProgramCache programs{api};
    Buffer placeBuffer{api};
    MeshStore meshes{api, placeBuffer, kMeshBytes};
    TextureStore textures{api, facts, kTextureBytes};
    std::optional<Target> target;
    std::optional<Peeler> peeler;
    ShadowStore shadows{api};
    int shadowMapsDrawn = 0;
    int peeledLayers = 0;  ///< of the frame, in the pass with most
    bool leftLayersOut = false;
    BoxMean mean;
    VertexArray lineArray{api}, emptyArray{api};
    Buffer lineBuffer{api};
    std::vector<Buffer> lightBuffers, shadowBuffers;  ///< of the light sets
    std::vector<GLuint> textureNames;
    std::vector<std::vector<TextureNote>> textureNotes;  ///< of each texture of the plan
    std::vector<image::Alpha> textureAlphas;             ///< likewise

    explicit State(std::unique_ptr<Context> with);

    /// Restores the GL state that plans change and expect to find: a plan that failed may have
    /// left it changed.
    void restoreState();

    void prepareTextures(const FramePlan& plan, const OpenTexture& open);
    void compileAhead(const FramePlan& plan);
    void prepare(FramePlan& plan, const OpenTexture& open);
    void prepareLights(const FramePlan& plan);
    void preparePlaces(const FramePlan& plan);
    void begin(const FramePlan& plan, const Pass& pass);
    void read(const FramePlan& plan, std::size_t pass, image::Image& image);
    void drawShadowMaps(const FramePlan& plan);
    void drawPass(const FramePlan& plan, const Pass& pass, int& drawCalls);
    void drawModels(const FramePlan& plan, const Pass& pass, const PassItem& models,
                    int& drawCalls);
    void drawBlended(const FramePlan& plan, const Pass& pass, const PassItem& models,
                     int& drawCalls);
    void drawPeeled(const FramePlan& plan, const Pass& pass, const PassItem& models,
                    int& drawCalls);
    void drawLayer(const Target& layer);
    glm::ivec4 viewportOf(const FramePlan& plan, const Pass& pass) const;
    void drawLines(const FramePlan& plan, const Pass& pass, const PassItem& lines, int& drawCalls);
    void drawBackdrop(const FramePlan& plan, const Pass& pass, const PassItem& backdrop,
                      int& drawCalls);
    void drawOne(const DrawItem& item, const GpuMesh& mesh, const LinkedProgram& program);
    Target::Resolver resolver(int samples);
    void setDepthRank(int rank, bool depthOnly);
    void setLights(const DrawItem& item, int count, const LinkedProgram& program);
    void setSamples(const Pass& pass, const LinkedProgram& program);
    void setScale(const Pass& pass, const LinkedProgram& program);
    void setMaterial(const FramePlan& plan, const DrawItem& item, const LinkedProgram& program);
};

}  // namespace farol::render::gl
