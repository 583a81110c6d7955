#include "render/batches.h"

namespace farol::render {
namespace {

bool sameSurface(const DrawItem& a, const DrawItem& b) {
    if (!a.surface || !b.surface) return !a.surface && !b.surface;
    return *a.surface == *b.surface && a.unitFromObject == b.unitFromObject;
}

bool sameMaterial(const DrawItem& a, const DrawItem& b) {
    return a.diffuse == b.diffuse && a.ambient == b.ambient && a.specular == b.specular &&
           a.emissive == b.emissive && a.shininess == b.shininess && a.texture == b.texture &&
           a.mapping == b.mapping && a.planeS == b.planeS && a.planeT == b.planeT;
}

bool sameButPlace(const DrawItem& a, const DrawItem& b) {
    return a.mesh->id == b.mesh->id && a.inside == b.inside && a.mirrored == b.mirrored &&
           a.lightSet == b.lightSet && sameSurface(a, b) && sameMaterial(a, b);
}

}  // namespace

std::vector<Batch> batchesOf(const FramePlan& plan) {
    std::vector<Batch> batches;
    const bool apart = plan.layer == Layer::id;  // each has a colour of its own
    for (std::size_t i = 0; i < plan.items.size(); ++i) {
        if (!batches.empty() && !apart &&
            sameButPlace(plan.items[batches.back().first], plan.items[i]))
            ++batches.back().count;
        else
            batches.push_back({i, 1, false});
    }
    if (plan.instancing)
        for (Batch& batch : batches) batch.instanced = batch.count >= kLeastInstances;
    return batches;
}

}  // namespace farol::render
