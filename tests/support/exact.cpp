#include "tests/support/exact.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "generator/registry.h"
#include "generator/sources.h"
#include "image/image_file.h"
#include "scene/read/reader.h"
#include "scene/write/writer.h"

namespace farol::bench {
namespace {

/// The divisions that a dialect of the field writes most often: twice as many divisions round as
/// along, one stack where the side is straight, a quarter a patch (four make a turn).
int divisionsOf(const std::string& shape, std::size_t place, int divisions) {
    if (shape == "patch") return std::max(1, divisions / 4);
    if (place == 0) return divisions;
    const bool straight =
        shape == "cone" || shape == "cylinder" || shape == "frustum" || shape == "ring";
    return straight ? 1 : std::max(2, divisions / 2);
}

void divide(scene::Model& model, int divisions) {
    scene::ShapeCall call = model.source.shape;
    const generator::ShapeEntry* shape = call.entry;
    model.autoLod = true;
    // Flat shapes look the same at any number; they stay at the plan's.
    if (divisions == 0 || !shape || shape->name == "box" || shape->name == "plane") return;
    std::size_t place = 0;
    for (std::size_t i = 0; i < shape->arguments.size(); ++i)
        if (shape->arguments[i].isLevel())
            call.arguments[i] = {scene::ShapeArgument::Form::written,
                                 static_cast<double>(divisionsOf(shape->name, place++, divisions))};
    model.autoLod = false;
    model.file.clear();
    model.revolve.reset();
    model.command = generator::textOf(call);
}

void divide(std::vector<scene::Group>& groups, int divisions) {
    for (scene::Group& group : groups) {
        for (scene::Model& model : group.models) divide(model, divisions);
        divide(group.groups, divisions);
    }
}

/// The ray caster reads a model's command, and knows neither generator comments nor aliases.
void nameShapes(std::vector<scene::Group>& groups) {
    for (scene::Group& group : groups) {
        for (scene::Model& model : group.models)
            if (model.source.kind == scene::ModelSource::Kind::shape)
                model.command = generator::textOf(model.source.shape);
        nameShapes(group.groups);
    }
}

using Counts = std::map<std::string, int>;

bool covered(const scene::Model& model, Counts& left) {
    if (model.source.kind != scene::ModelSource::Kind::shape)
        return ++left["models of mesh files"], false;
    if (model.texture && model.texture->chess) return ++left["models with chess textures"], false;
    if (model.uv == scene::UvLayout::layout2017) return ++left["models laid out as in 2017"], false;
    return true;
}

void prune(std::vector<scene::Group>& groups, Counts& left) {
    for (scene::Group& group : groups) {
        std::erase_if(group.models,
                      [&](const scene::Model& model) { return !covered(model, left); });
        prune(group.groups, left);
    }
}

void collectFiles(const std::vector<scene::Group>& groups, const scene::Assets& assets,
                  reference::Files& files) {
    for (const scene::Group& group : groups) {
        for (const scene::Model& model : group.models) {
            if (const std::string& file = model.source.shape.file;
                !file.empty() && !files.texts.contains(file)) {
                if (const auto text = assets.read(file)) files.texts[file] = *text;
                if (const auto text = generator::builtinFile(file)) files.texts[file] = *text;
            }
            if (!model.texture || files.pictures.contains(model.texture->file)) continue;
            const auto bytes = assets.read(model.texture->path);
            if (!bytes) continue;  // makeWorld names what is wanting
            const image::Image image = image::decodeImage(*bytes, model.texture->path);
            reference::Pixels pixels{image.width, image.height, {}};
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                (i % 4 == 3 ? pixels.alpha : pixels.rgb).push_back(image.pixels[i]);
            files.pictures[model.texture->file] = std::move(pixels);
        }
        collectFiles(group.groups, assets, files);
    }
}

/// The picture of 8 bits a channel that is nearest to the exact one. FLIP compares pictures that
/// are shown, and is steep near zero: against values that no display has, even this one scores
/// 0.013 on the primitives.
grade::FloatImage shown(const reference::Picture& picture) {
    grade::FloatImage image(picture.width, picture.height);
    const auto level = [](double value) {
        return static_cast<float>(std::round(255.0 * glm::clamp(value, 0.0, 1.0)) / 255.0);
    };
    for (std::size_t i = 0; i < picture.color.size(); ++i) {
        image.red.values[i] = level(picture.color[i].r);
        image.green.values[i] = level(picture.color[i].g);
        image.blue.values[i] = level(picture.color[i].b);
    }
    return image;
}

glm::dvec3 levels(const image::Image& image, std::size_t at) {
    const std::uint8_t* p = &image.pixels[4 * at];
    return {p[0], p[1], p[2]};
}

}  // namespace

std::string Subject::xml(int divisions) const {
    scene::Scene copy = scene;
    divide(copy.groups, divisions);
    copy.generatorComments.clear();  // commands say the same
    for (const auto& [file, words] : scene.generatorComments)
        if (divisions == 0) copy.generatorComments[file] = words;
    return scene::write(copy);
}

Subject readSubject(const std::string& xml, std::shared_ptr<const scene::Assets> assets) {
    Subject subject;
    subject.assets = std::move(assets);
    scene::Scene& scene = subject.scene;
    scene = scene::read(xml, {}, *subject.assets).scene;
    Diagnostics found;
    generator::resolve(scene, *subject.assets, found);
    Counts left;
    prune(scene.groups, left);
    if (scene.skybox) ++left["skybox"];
    if (!scene.entityFile.empty()) ++left["entity"];
    if (!scene.background.file.empty()) ++left["picture behind the scene"];
    scene.skybox.reset();
    scene.entity.reset();
    scene.entityFile.clear();
    scene.background.file.clear();
    scene.background.path.clear();
    for (const auto& [what, count] : left)
        subject.leftOut.push_back(std::to_string(count) + " " + what);
    return subject;
}

Exact exactOf(const Subject& subject, int width, int height, int cap) {
    scene::Scene scene = subject.scene;
    nameShapes(scene.groups);
    reference::Files files;
    collectFiles(scene.groups, *subject.assets, files);
    reference::Options options;
    options.width = width;
    options.height = height;
    options.viewer = scene.settings.viewer.value_or(scene::Viewer::infinite);
    options.specular = scene.settings.specular.value_or(scene::Specular::single);
    if (scene.background.color) options.background = glm::dvec3(*scene.background.color);
    const reference::World world = reference::makeWorld(scene, files, options);
    Exact exact;
    exact.centers = reference::traceCenters(world);
    if (cap > 1) {
        exact.areas = reference::traceAreas(world, cap);
        exact.flipAreas = std::make_shared<const grade::FlipPicture>(shown(exact.areas));
    }
    return exact;
}

Errors errorsOf(const Exact& exact, const image::Image& image) {
    Errors errors;
    std::vector<double> all;
    double squares = 0.0;
    for (std::size_t i = 0; i < exact.centers.color.size(); ++i) {
        if (exact.centers.id[i] == 0 || exact.centers.edge[i] != reference::kInterior) continue;
        const glm::dvec3 off = glm::abs(levels(image, i) - 255.0 * exact.centers.color[i]);
        squares += glm::dot(off, off);
        for (int c = 0; c < 3; ++c) all.push_back(off[c]);
        ++errors.interiorPixels;
    }
    if (!all.empty()) {
        errors.interiorRms = std::sqrt(squares / static_cast<double>(all.size()));
        const auto place = std::min(all.size() - 1, all.size() * 999 / 1000);
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(place), all.end());
        errors.interiorP999 = all[place];
    }
    if (!exact.flipAreas) return errors;
    squares = 0.0;
    for (std::size_t i = 0; i < exact.areas.color.size(); ++i) {
        const glm::dvec3 off = levels(image, i) - 255.0 * exact.areas.color[i];
        squares += glm::dot(off, off);
    }
    errors.areasRms = std::sqrt(squares / (3.0 * static_cast<double>(exact.areas.color.size())));
    const grade::Plane flip =
        grade::flip(*exact.flipAreas, grade::FlipPicture(grade::FloatImage(image)));
    errors.flipMean = grade::summarize(flip).mean;
    grade::Mask objects;
    for (std::size_t i = 0; i < exact.areas.id.size(); ++i)
        objects.counts.push_back(exact.areas.id[i] != 0 || exact.areas.edge[i] != 0 ? 1 : 0);
    errors.flipObjects = grade::summarize(flip, objects).mean;
    return errors;
}

}  // namespace farol::bench
