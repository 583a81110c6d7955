#pragma once

#include <cstdint>
#include <initializer_list>

namespace farol::render {

/// Features that a shader is compiled with; render/gl/program.cpp has their table of #defines.
enum class Feature : std::uint8_t {
    // Output other than colour.
    layerId,
    layerNormal,
    layerDepth,
    // Lighting: where it is computed, and which terms it has.
    lightCount,  ///< counted; every model's shader has it
    unlit,
    chess,
    flat,
    gouraud,
    phong,
    positional,
    spot,
    specular,
    localViewer,
    separateSpecular,
    shadowed,       ///< counted: lights with shadow maps, the first of all
    shadowCascade,  ///< counted: those of several parallel maps, the first of these
    shadowCube,     ///< counted: those of six maps, the next
    markNotFinite,
    // Texture.
    textured,
    filterMipmap,
    filterAnisotropic,
    mappingSphere,
    texgenObject,
    texgenEye,
    supersampled,  ///< a pixel of the target is a part of one of the image
    vertexColor,   ///< the mesh's own colours modulate, as a texture does
    // Opacity.
    alphaTest,   ///< pixels under half opacity are left out
    eachSample,  ///< counted: the GL's samples are tested one by one
    blended,     ///< premultiplied colour and opacity
    peeled,      ///< surfaces behind the layer before and in front of opaque ones
    // Exact surface behind a mesh.
    surface,
    surfaceCaps,
    surfaceProfile,
    surfaceWrapsV,
    surfaceRay,       ///< a step along the pixel's ray leads to it
    surfaceTwoSteps,  ///< or two
    surfaceTurnFromX,
    surfaceDiscUv,
    exactDepth,  ///< pixels have the surface's own depth, not its mesh's
    // Geometry.
    carried,       ///< what fragments read comes from vertices, not from uniforms
    eyePositions,  ///< vertices were placed in double (MeshData::eyePositions)
    instanced,
    // Whole windows.
    skybox,
    layer,    ///< pixels of a target of the same size
    resolve,  ///< counted: the samples of a pixel
};
inline constexpr int kFeatures = static_cast<int>(Feature::resolve) + 1;

class FeatureSet {
  public:
    constexpr FeatureSet() = default;
    constexpr FeatureSet(std::initializer_list<Feature> features) {
        for (const Feature feature : features) add(feature);
    }
    static constexpr FeatureSet all() {
        FeatureSet set;
        set.bits_ = ~std::uint64_t{0};
        return set;
    }
    constexpr bool has(Feature feature) const { return (bits_ & bit(feature)) != 0; }
    constexpr bool hasAny(const FeatureSet& other) const { return (bits_ & other.bits_) != 0; }
    constexpr void add(Feature feature) { bits_ |= bit(feature); }
    constexpr void remove(Feature feature) { bits_ &= ~bit(feature); }
    constexpr FeatureSet operator|(const FeatureSet& other) const {
        return of(bits_ | other.bits_);
    }
    constexpr FeatureSet operator&(const FeatureSet& other) const {
        return of(bits_ & other.bits_);
    }
    auto operator<=>(const FeatureSet&) const = default;

  private:
    static constexpr std::uint64_t bit(Feature feature) {
        return std::uint64_t{1} << static_cast<unsigned>(feature);
    }
    static constexpr FeatureSet of(std::uint64_t bits) {
        FeatureSet set;
        set.bits_ = bits;
        return set;
    }
    std::uint64_t bits_ = 0;
};
static_assert(kFeatures <= 64);

/// Features of shading models that use lights.
inline constexpr FeatureSet kLitFeatures{Feature::flat, Feature::gouraud, Feature::phong};

}  // namespace farol::render
