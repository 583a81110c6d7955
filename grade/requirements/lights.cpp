#include "grade/requirements/lights.h"

#include <algorithm>

#include "grade/requirements/messages.h"
#include "grade/rubric/metrics.h"

namespace farol::grade {
namespace {

/// The reason why the light is too far away at some time, or an empty message.
Message farFrom(const LightSelector& selector, ObjectSelector& objects,
                const Inventory::Light& light) {
    const std::vector<std::size_t>& targets = objects.objectsOf(selector.near);
    if (targets.empty())
        return requirementMessage<"part.miss/light-near-none">("id"_arg = selector.near);
    const Inventory& inventory = objects.scene().inventory;
    for (const double timeS : objects.scene().seen.timesS()) {
        const glm::dvec3 at(inventory.matrix(light.node, -1, timeS) *
                            glm::dvec4(light.light->position, 1.0));
        double least = 1e300, allowed = 0.0;
        bool isNear = false;
        for (const std::size_t target : targets) {
            const double distance = glm::length(inventory.middle(target, -1, timeS) - at);
            const double most = selector.within * inventory.radius(target, timeS) + 1e-3;
            isNear = isNear || distance <= most;
            if (distance >= least) continue;
            least = distance;
            allowed = most;
        }
        if (!isNear)
            return requirementMessage<"part.miss/light-near">("distance"_arg = shortNumber(least),
                                                              "id"_arg = selector.near,
                                                              "most"_arg = shortNumber(allowed));
    }
    return {};
}

/// The reason why the light does not light enough of the objects, or an empty message.
Message unlit(const LightSelector& selector, ObjectSelector& objects,
              const Inventory::Light& light) {
    std::size_t visible = 0, lit = 0;
    for (const std::size_t target : objects.objectsOf(selector.lights)) {
        const std::optional<bool> isLit = objects.scene().seen.isLitBy(target, light.ordinal);
        visible += isLit ? 1 : 0;
        lit += isLit && *isLit ? 1 : 0;
    }
    if (visible == 0)
        return requirementMessage<"part.miss/light-unseen">("id"_arg = selector.lights);
    if (2 * lit >= visible) return {};
    return requirementMessage<"part.miss/light-lights">("count"_arg = lit, "visible"_arg = visible,
                                                        "id"_arg = selector.lights);
}

Message reasonOf(const LightSelector& selector, ObjectSelector& objects,
                 const Inventory::Light& light) {
    if (selector.type && light.light->type != *selector.type)
        return requirementMessage<"part.miss/light-type">(
            "found"_arg = scene::kLightTypeWords[light.light->type],
            "expected"_arg = scene::kLightTypeWords[*selector.type]);
    if (!selector.near.empty()) {
        if (light.light->type == scene::LightType::directional)
            return requirementMessage<"part.miss/light-type">(
                "found"_arg = "directional", "expected"_arg = requirementMessage<"part.choice/or">(
                                                 "list"_arg = "point", "last"_arg = "spot"));
        if (Message reason = farFrom(selector, objects, light); !reason.empty()) return reason;
    }
    return selector.lights.empty() ? Message{} : unlit(selector, objects, light);
}

}  // namespace

std::vector<FoundLight> findLights(const LightSelector& selector, ObjectSelector& objects) {
    std::vector<FoundLight> out;
    for (const Inventory::Light& light : objects.scene().inventory.lights())
        out.push_back({requirementMessage<"part.light/number">(
                           "number"_arg = light.ordinal + 1,
                           "type"_arg = scene::kLightTypeWords[light.light->type]),
                       light.light->where, reasonOf(selector, objects, light)});
    return out;
}

}  // namespace farol::grade
