#include "render/gl/shadow_store.h"

#include <algorithm>
#include <new>

#include "render/gl/program.h"

namespace farol::render::gl {
namespace {

/// Names the textures that a map's items are cut out by.
std::vector<std::string> textureKeys(const FramePlan& plan, const FramePlan& frame) {
    std::vector<std::string> keys;
    for (const DrawItem& item : frame.items) {
        if (item.texture < 0) continue;
        const TextureRef& ref = plan.textures[static_cast<std::size_t>(item.texture)];
        keys.push_back(std::to_string(static_cast<int>(ref.filter)) + (ref.clamp ? "c" : "r") +
                       ref.key);
    }
    return keys;
}

bool sameDepths(const DrawItem& a, const DrawItem& b) {
    return a.mesh->id == b.mesh->id && a.viewFromObject == b.viewFromObject &&
           a.mirrored == b.mirrored && a.firstIndex == b.firstIndex && a.indices == b.indices &&
           (a.texture < 0) == (b.texture < 0) && a.mapping == b.mapping && a.planeS == b.planeS &&
           a.planeT == b.planeT && a.uvFrom == b.uvFrom;
}

}  // namespace

void ShadowStore::bind(const FramePlan& plan) {
    api_.ActiveTexture(GL_TEXTURE0 + kShadowUnit);
    if (side_ != plan.shadowSide || layers_.size() != plan.shadowMaps.size()) {
        layers_.clear();
        side_ = 0;            // until there is storage
        depths_ = Texture();  // the old one first: two may not fit
        depths_ = Texture(api_);
        api_.BindTexture(GL_TEXTURE_2D_ARRAY, depths_.name());
        api_.TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT32F, plan.shadowSide,
                          plan.shadowSide, static_cast<GLsizei>(plan.shadowMaps.size()));
        const auto set = [&](GLenum name, GLenum value) {
            api_.TexParameteri(GL_TEXTURE_2D_ARRAY, name, static_cast<GLint>(value));
        };
        set(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        set(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);  // its colour is 0
        set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
        if (!framebuffer_) framebuffer_ = Framebuffer(api_);
        throwOnError(api_, "creating shadow maps");
        side_ = plan.shadowSide;
        layers_.resize(plan.shadowMaps.size());
    }
    api_.BindTexture(GL_TEXTURE_2D_ARRAY, depths_.name());
    api_.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
}

bool ShadowStore::has(const FramePlan& plan, std::size_t map) const {
    const Layer& layer = layers_[map];
    const FramePlan& frame = *plan.shadowMaps[map].frame;
    return layer.frame && layer.frame->passes[0].clip == frame.passes[0].clip &&
           std::equal(layer.frame->items.begin(), layer.frame->items.end(), frame.items.begin(),
                      frame.items.end(), sameDepths) &&
           layer.textures == textureKeys(plan, frame);
}

void ShadowStore::begin(std::size_t map) {
    layers_[map] = {};
    api_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    api_.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths_.name(), 0,
                                 static_cast<GLint>(map));
    if (api_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::bad_alloc();
    api_.Viewport(0, 0, side_, side_);
    constexpr float kFarthest = 0.0F;  // reversed depth
    api_.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void ShadowStore::keep(const FramePlan& plan, std::size_t map) {
    const std::shared_ptr<const FramePlan>& frame = plan.shadowMaps[map].frame;
    layers_[map] = {frame, textureKeys(plan, *frame)};
}

}  // namespace farol::render::gl
