#include "interchange/gltf/writer.h"

#include <algorithm>
#include <cmath>

#include "interchange/messages.h"
#include "render/plan/camera.h"
#include "render/plan/plan.h"
#include "scene/animation.h"
#include "scene/loop.h"

namespace farol::interchange {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxSamples = 1'000'000;

json nodeOf(const Placement& placement) {
    json node = json::object();
    if (!(glm::length(placement.translation) <= kMaxFloat &&
          glm::length(placement.scale) <= kMaxFloat))
        throw Error(message<"limit.model/size">("max"_arg = kMaxFloat));
    if (placement.translation != glm::dvec3(0.0))
        node["translation"] = toJson(placement.translation);
    if (placement.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0))
        node["rotation"] = toJson(placement.rotation);
    if (placement.scale != glm::dvec3(1.0)) node["scale"] = toJson(placement.scale);
    return node;
}

bool cycles(const scene::Material& m) {
    return m.diffuse.cycles || m.ambient.cycles || m.specular.cycles || m.emissive.cycles;
}

bool cycles(const scene::Light& light) {
    return light.diffuse.cycles || light.ambient.cycles || light.specular.cycles;
}

/// The longest period of the scene's motions, s; 0 where nothing moves.
double longestPeriod(const std::vector<Placement>& moving) {
    double longest = 0.0;
    for (const Placement& node : moving) {
        if (node.curve != nullptr) longest = std::max(longest, node.curve->seconds);
        if (node.spin != nullptr) longest = std::max(longest, std::abs(node.spin->seconds));
    }
    return longest;
}

}  // namespace

GltfWriter::GltfWriter(const render::Job& job, std::size_t maxBytes)
    : subject_(job), document_(maxBytes) {}

void GltfWriter::leaveOut(Message feature, const Location& where) {
    subject_.findings().push_back(diagnosticOf(
        Severity::warning,
        message<"convert.left-out">("format"_arg = "glTF", "feature"_arg = feature), where));
}

void GltfWriter::approximate(Message feature, Message instead, const Location& where) {
    subject_.findings().push_back(
        diagnosticOf(Severity::warning,
                     message<"convert.approximated">("format"_arg = "glTF", "feature"_arg = feature,
                                                     "instead"_arg = instead),
                     where));
}

json GltfWriter::contentOf(const scene::Group& group, const scene::Scene& in) {
    json children = json::array();
    addLights(group.lights, children);
    for (const scene::Model& model : group.models)
        if (const std::optional<int> node = addModel(model, in)) children.push_back(*node);
    for (const scene::Group& child : group.groups) children.push_back(addGroup(child, in));
    return children;
}

int GltfWriter::addChain(const std::vector<Placement>& chain, const std::string& name,
                         json content) {
    int outer = -1;
    for (std::size_t i = chain.size(); i-- > 0;) {
        json node = nodeOf(chain[i]);
        if (i == 0 && !name.empty()) node["name"] = name;
        if (!content.empty()) node["children"] = std::move(content);
        outer = document_.add("nodes", std::move(node));
        if (chain[i].curve != nullptr || chain[i].spin != nullptr)
            moving_.push_back({outer, chain[i]});
        content = json::array({outer});
    }
    return outer;
}

int GltfWriter::addGroup(const scene::Group& group, const scene::Scene& in) {
    json content = json::array();
    if (group.scatter) {
        for (const glm::dmat4& place :
             scene::scatterMatrices(*group.scatter, group.scatter->seed)) {
            json copy{{"translation", toJson(glm::dvec3(place[3]))}};
            json children = contentOf(group, in);
            if (!children.empty()) copy["children"] = std::move(children);
            content.push_back(document_.add("nodes", std::move(copy)));
        }
    } else {
        content = contentOf(group, in);
    }
    return addChain(placementsOf(group.transforms, subject_.timeS()), group.name,
                    std::move(content));
}

void GltfWriter::addScene(const scene::Scene& scene, json& children) {
    addLights(scene.lights, children);
    for (const scene::Group& group : scene.groups) children.push_back(addGroup(group, scene));
}

int GltfWriter::addCamera() {
    const scene::Camera& camera = subject_.camera();
    const render::ViewTransform view = render::viewOf(camera, subject_.size());
    const glm::dvec2 size(subject_.size());
    document_.add("cameras", {{"type", "perspective"},
                              {"perspective",
                               {{"yfov", glm::radians(camera.fovDeg)},
                                {"aspectRatio", size.x / size.y},
                                {"znear", camera.near},
                                {"zfar", camera.far}}}});
    const glm::dquat rotation = glm::normalize(glm::quat_cast(glm::transpose(view.rotation)));
    json node{{"name", "camera"},
              {"camera", 0},
              {"translation", toJson(camera.eye)},
              {"rotation", toJson(rotation)}};
    if (subject_.scene().entity) {
        json children = json::array();
        addScene(*subject_.scene().entity, children);
        json entity{{"name", "entity"}, {"translation", toJson(render::kEntityPlace)}};
        if (!children.empty()) entity["children"] = std::move(children);
        viewerNodes_.push_back(document_.add("nodes", std::move(entity)));
    }
    if (!viewerNodes_.empty()) node["children"] = viewerNodes_;
    return document_.add("nodes", std::move(node));
}

void GltfWriter::addAnimation() {
    if (moving_.empty()) return;
    const scene::Scene& scene = subject_.scene();
    double beginS = subject_.timeS(), durationS = 0.0;
    if (scene.settings.timeRangeS) {
        beginS += scene.settings.timeRangeS->x;
        durationS = scene.settings.timeRangeS->y - scene.settings.timeRangeS->x;
    } else if (const std::optional<double> loop = scene::loopSeconds(scene)) {
        durationS = *loop;
    }
    const auto samples = [&] {
        std::size_t sum = 0;
        for (const MovingNode& one : moving_) sum += countSamples(one.placement, durationS);
        return sum;
    };
    if (durationS == 0.0 || (!scene.settings.timeRangeS && samples() > kMaxSamples)) {
        std::vector<Placement> all;
        for (const MovingNode& one : moving_) all.push_back(one.placement);
        durationS = longestPeriod(all);
        approximate(message<"part.feature-loop">(), message<"part.instead-longest">(), scene.where);
    }
    if (samples() > kMaxSamples)
        throw Error(message<"limit.model/samples">("max"_arg = kMaxSamples), scene.where);
    json animation{{"name", "loop"}, {"channels", json::array()}, {"samplers", json::array()}};
    std::map<std::string, std::size_t> known;
    const auto addChannel = [&](int node, const char* path, int times, int values) {
        const json sampler{{"input", times}, {"output", values}, {"interpolation", "LINEAR"}};
        const auto [at, isNew] = known.emplace(sampler.dump(), animation["samplers"].size());
        if (isNew) animation["samplers"].push_back(sampler);
        animation["channels"].push_back(
            {{"sampler", at->second}, {"target", {{"node", node}, {"path", path}}}});
        ++written_.animations;
    };
    for (const MovingNode& one : moving_) {
        const Motion motion = sample(one.placement, beginS, durationS);
        if (motion.timesS.size() < 2) continue;
        const int times = document_.addTimes(motion.timesS);
        if (!motion.translations.empty())
            addChannel(one.node, "translation", times,
                       document_.addTranslations(motion.translations));
        if (!motion.rotations.empty())
            addChannel(one.node, "rotation", times, document_.addRotations(motion.rotations));
    }
    if (written_.animations > 0) document_.add("animations", std::move(animation));
}

void GltfWriter::noteLosses(const scene::Group& group, bool& cyclesNoted, bool& texgenNoted,
                            const Location*& groupLight) {
    if (!group.lights.empty() && groupLight == nullptr) groupLight = &group.lights.front().where;
    for (const scene::Light& light : group.lights) cyclesNoted = cyclesNoted || cycles(light);
    for (const scene::Model& model : group.models) {
        cyclesNoted = cyclesNoted || (model.material && cycles(*model.material));
        texgenNoted =
            texgenNoted || (model.texture && model.texture->mapping == scene::Mapping::texgenEye);
    }
    for (const scene::Group& child : group.groups)
        noteLosses(child, cyclesNoted, texgenNoted, groupLight);
}

void GltfWriter::noteLosses(const scene::Scene& scene) {
    bool hasCycles = std::any_of(scene.lights.begin(), scene.lights.end(),
                                 [](const scene::Light& light) { return cycles(light); });
    bool hasTexgen = false;
    const Location* groupLight = nullptr;
    for (const scene::Group& group : scene.groups)
        noteLosses(group, hasCycles, hasTexgen, groupLight);
    if (hasCycles)
        approximate(message<"part.feature-cycles">(), message<"part.instead-first-color">(),
                    scene.where);
    if (hasTexgen) leaveOut(message<"part.feature-eye-texgen">(), scene.where);
    if (groupLight != nullptr && subject_.isLit())
        approximate(message<"part.feature-group-light">(), message<"part.instead-all-lit">(),
                    *groupLight);
    if (scene.background.color || !scene.background.file.empty())
        leaveOut(message<"part.feature-background">(), scene.background.where);
    if (scene.skybox) leaveOut(message<"part.feature-skybox">(), scene.skybox->where);
    if (subject_.options().axes.value_or(scene.settings.axes.value_or(false)))
        leaveOut(message<"part.feature-axes">(), scene.where);
    if (subject_.shading() == scene::Shading::chess)
        leaveOut(message<"part.feature-chess">(), scene.where);
}

WrittenScene GltfWriter::write() {
    const scene::Scene& scene = subject_.scene();
    document_.root()["asset"] = {{"version", "2.0"}, {"generator", "farol " FAROL_VERSION}};
    json nodes = json::array();
    addScene(scene, nodes);
    nodes.push_back(addCamera());
    addAnimation();
    noteLosses(scene);
    if (scene.entity) noteLosses(*scene.entity);
    json root{{"nodes", std::move(nodes)}};
    if (!scene.title.empty()) root["name"] = scene.title;
    document_.add("scenes", std::move(root));
    document_.root()["scene"] = 0;
    written_.nodes = static_cast<std::int64_t>(document_.count("nodes"));
    written_.meshes = static_cast<std::int64_t>(document_.count("meshes"));
    written_.materials = static_cast<std::int64_t>(document_.count("materials"));
    written_.textures = static_cast<std::int64_t>(document_.count("images"));
    written_.bytes = document_.take();
    written_.diagnostics = std::move(subject_.findings());
    return std::move(written_);
}

WrittenScene writeGlb(const render::Job& job, std::size_t maxBytes) {
    return GltfWriter(job, maxBytes).write();
}

}  // namespace farol::interchange
