#pragma once

#include <cstdint>

#include "render/options.h"

/// Reports that travel with an image about its plan.
namespace farol::render {

/// Counts of drawn and skipped parts of a frame.
struct Stats {
    int instances = 0;  ///< models, copies of scattered groups counted
    int culled = 0;     ///< of them not drawn: outside the view, or without any surface
    int drawCalls = 0, textures = 0, lights = 0;
    std::int64_t triangles = 0;
    int culledGroups = 0;     ///< groups found outside by one test, without testing their models
    int betweenSamples = 0;   ///< models too small to be met by a sample of any pixel
    int texturesSkipped = 0;  ///< pictures that only models sample which are not drawn
    int coarsened = 0;  ///< models whose mesh is coarser than `error` asks, as are their pixels
    double coarsening = 1.0;  ///< the factor of their error (render/plan/crowd.h)
    int coplanar = 0;         ///< models behind another in whose plane they have a face
    int exactDepth = 0;       ///< models so close to another that their pixels' depth is exact
    int cutOut = 0;           ///< models with holes: their textures' alpha is on or off
    int blended = 0;          ///< see-through models
    int peeledLayers = 0;     ///< of their surfaces, sorted in each pixel
    int occluders = 0;        ///< models whose depths are drawn before anything is shaded
    double overdraw = 1.0;    ///< shading without that over what shows of it, estimated
    int shadowMaps = 0;       ///< depth maps of lights; one that shines to all sides has up to six
    std::int64_t shadowTriangles = 0;  ///< in all of them
    std::int64_t lightsSkipped = 0;    ///< for each model: lights that add nothing to it
};

/// The choice of a budget (PictureOptions::budgetMs), and the time expected for it.
struct Quality {
    int samples = 4;
    double errorPx = kDefaultErrorPx;
    double expectedMs = 0.0;
    bool within =
        false;  ///< false: even the cheapest that may be chosen costs more than the budget
};

}  // namespace farol::render
