#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grade/images/flip.h"
#include "image/image.h"
#include "scene/files/assets.h"
#include "scene/scene.h"
#include "tests/support/ray_caster/tracer.h"

/// A scene beside its exact pictures: what the renderer draws of it, however divided, measured
/// against the independent ray caster of tests/support/ray_caster.
namespace farol::bench {

/// A document without what the reference does not draw (mesh files, skyboxes, chess textures,
/// pictures behind the scene), in the reference's model and as XML.
struct Subject {
    scene::Scene scene;  ///< resolved
    std::shared_ptr<const scene::Assets> assets;
    std::vector<std::string> leftOut;  ///< "165 models of mesh files"

    /// The document with every curved shape cut in `divisions` a full turn (8..256) in place of
    /// its own; 0: all left open, for the renderer to choose.
    std::string xml(int divisions) const;
};

/// Throws Error for a document that cannot be read.
Subject readSubject(const std::string& xml, std::shared_ptr<const scene::Assets> assets);

/// R1 and, where `cap` is over 1, R2 of at most cap x cap rays a pixel, at `timeS`.
struct Exact {
    reference::Picture centers, areas;
    std::shared_ptr<const grade::FlipPicture> flipAreas;  ///< R2 in 8 bits; null without R2
};

/// Throws std::invalid_argument for a scene that the reference does not cover.
Exact exactOf(const Subject& subject, int width, int height, int cap);

struct Errors {
    int interiorPixels = 0;
    double interiorRms = 0.0;   ///< against R1, inside outlines, levels of 255
    double interiorP999 = 0.0;  ///< 99.9th percentile of the same
    double areasRms = 0.0;      ///< against R2, all pixels, levels of 255
    double flipMean = 0.0;      ///< against R2 in 8 bits, all pixels, 0..1
    double flipObjects = 0.0;   ///< the same over pixels that show an object or its outline
};

/// Of a picture of the size that `exact` has.
Errors errorsOf(const Exact& exact, const image::Image& image);

}  // namespace farol::bench
