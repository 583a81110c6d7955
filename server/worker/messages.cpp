#include "server/worker/messages.h"

#include <concepts>
#include <map>

#include "server/worker/wire.h"

// visit() lies beside the types it is for, where it is found by them. Each names all fields of its
// structure, so that one that is added and not sent does not compile.
namespace farol {

constexpr Severity lastOf(Severity) { return Severity::error; }

template <typename Value, typename Type>
concept Is = std::same_as<std::remove_const_t<Value>, Type>;

template <typename Archive, Is<Location> T>
void visit(Archive& archive, T& value) {
    auto& [file, line, column] = value;
    archive(file, line, column);
}

template <typename Archive, Is<Diagnostic> T>
void visit(Archive& archive, T& value) {
    auto& [severity, code, where, message, field] = value;
    archive(severity, code, where, message, field);
}

namespace scene {
constexpr Shading lastOf(Shading) { return Shading::phong; }
constexpr Filter lastOf(Filter) { return Filter::anisotropic; }
constexpr Viewer lastOf(Viewer) { return Viewer::local; }
constexpr Specular lastOf(Specular) { return Specular::separate; }

template <typename Archive, Is<Bundle> T>
void visit(Archive& archive, T& value) {
    auto& [main, files] = value;
    archive(main, files);
}

template <typename Archive, Is<Camera> T>
void visit(Archive& archive, T& value) {
    auto& [eye, target, up, fovDeg, near, far, where] = value;
    archive(eye, target, up, fovDeg, near, far, where);
}
}  // namespace scene

namespace render {
constexpr Format lastOf(Format) { return Format::webp; }
constexpr Layer lastOf(Layer) { return Layer::id; }

template <typename Archive, Is<PictureOptions> T>
void visit(Archive& archive, T& value) {
    auto& [width, height, eye, target, up, azimuthDeg, elevationDeg, distance, fovDeg, near, far,
           timeS, shading, samples, filter, errorPx, budgetMs, axes, curves, focus, debug,
           background, entity, format, quality, layer, viewer, specular, scale] = value;
    archive(width, height, eye, target, up, azimuthDeg, elevationDeg, distance, fovDeg, near, far,
            timeS, shading, samples, filter, errorPx, budgetMs, axes, curves, focus, debug,
            background, entity, format, quality, layer, viewer, specular, scale);
}

template <typename Archive, Is<Stats> T>
void visit(Archive& archive, T& value) {
    auto& [instances, culled, drawCalls, textures, lights, triangles, culledGroups, betweenSamples,
           texturesSkipped, lightsSkipped] = value;
    archive(instances, culled, drawCalls, textures, lights, triangles, culledGroups, betweenSamples,
            texturesSkipped, lightsSkipped);
}

template <typename Archive, Is<StageTimes> T>
void visit(Archive& archive, T& value) {
    auto& [parseMs, geometryMs, drawMs, readbackMs, encodeMs] = value;
    archive(parseMs, geometryMs, drawMs, readbackMs, encodeMs);
}

template <typename Archive, Is<Quality> T>
void visit(Archive& archive, T& value) {
    auto& [samples, errorPx, expectedMs, within] = value;
    archive(samples, errorPx, expectedMs, within);
}

template <typename Archive, Is<Picture> T>
void visit(Archive& archive, T& value) {
    auto& [bytes, contentType, width, height, diagnostics, camera, stats, times, quality] = value;
    archive(bytes, contentType, width, height, diagnostics, camera, stats, times, quality);
}

template <typename Archive, Is<ModelElement> T>
void visit(Archive& archive, T& value) {
    auto& [id, name, file, where] = value;
    archive(id, name, file, where);
}

template <typename Archive, Is<SceneReport> T>
void visit(Archive& archive, T& value) {
    auto& [diagnostics, title, description, width, height, animated, plays, camera, triangles,
           models, lights, textures, textureBytes, elements, copies] = value;
    archive(diagnostics, title, description, width, height, animated, plays, camera, triangles,
            models, lights, textures, textureBytes, elements, copies);
}
}  // namespace render

namespace server {
template <typename Archive, Is<Turntable> T>
void visit(Archive& archive, T& value) {
    auto& [frames, fps, apng] = value;
    archive(frames, fps, apng);
}

template <typename Archive, Is<MeshJob> T>
void visit(Archive& archive, T& value) {
    auto& [words, format] = value;
    archive(words, format);
}

template <typename Archive, Is<GradeReply> T>
void visit(Archive& archive, T& value) {
    auto& [json, points, most, passed, refused, pictures, readMs, drawMs, compareMs] = value;
    archive(json, points, most, passed, refused, pictures, readMs, drawMs, compareMs);
}

template <typename Archive, Is<CompareReply> T>
void visit(Archive& archive, T& value) {
    auto& [json, diff, heat] = value;
    archive(json, diff, heat);
}

namespace worker {
constexpr Task lastOf(Task) { return Task::check; }
constexpr Outcome lastOf(Outcome) { return Outcome::memory; }

template <typename Archive, Is<Hello> T>
void visit(Archive& archive, T& value) {
    auto& [fault, gl, sandbox] = value;
    archive(fault, gl, sandbox);
}

template <typename Archive, Is<Reply> T>
void visit(Archive& archive, T& value) {
    auto& [outcome, diagnostics, message, picture, report, mesh, bundle, grade, compare] = value;
    archive(outcome, diagnostics, message, picture, report, mesh, bundle, grade, compare);
}

namespace {
using Files = std::vector<std::pair<std::string, std::string>>;

/// Reads one message that is T and nothing more.
template <typename T>
T unpack(std::string_view bytes) {
    T value;
    Unpacker unpacker(bytes);
    unpacker(value);
    unpacker.end();
    return value;
}

template <typename T>
std::string packed(const T& value) {
    Packer packer;
    packer(value);
    return packer.take();
}
}  // namespace

/// A job: a served folder by its path, a bundle by its files.
void packJob(Packer& packer, const render::Job& job) {
    const auto& [name, xml, assets, options, strict, identity, archive, drawUnseen] = job;
    std::string folder;
    Files files;
    if (const auto* served = dynamic_cast<const scene::FolderAssets*>(assets.get())) {
        folder = served->root();
    } else if (assets) {
        for (const std::string& path : assets->list())
            if (auto bytes = assets->read(path)) files.emplace_back(path, std::move(*bytes));
    }
    packer(name, xml, folder, files, options, strict, identity, archive, drawUnseen);
}

void unpackJob(Unpacker& unpacker, render::Job& job) {
    std::string folder;
    Files files;
    unpacker(job.name, job.xml, folder, files, job.options, job.strict, job.identity, job.archive,
             job.drawUnseen);
    if (!folder.empty())
        job.assets = std::make_shared<scene::FolderAssets>(folder);
    else
        job.assets = std::make_shared<scene::BundleAssets>(std::map<std::string, std::string>(
            std::make_move_iterator(files.begin()), std::make_move_iterator(files.end())));
}

std::string pack(const Request& request) {
    const auto& [task, job, mesh, turntable, notice, grade, compare] = request;
    const auto& [first, second, crop, mask, pictures] = compare;
    Packer packer;
    packer(task, mesh, turntable, notice, grade.rubric, grade.reference.picture,
           grade.reference.task, grade.submission.picture, grade.submission.task, crop, mask,
           pictures, first.picture, second.picture);
    packJob(packer, job);
    packJob(packer, grade.reference.job);
    packJob(packer, first.job);
    packJob(packer, second.job);
    return packer.take();
}

Request unpackRequest(std::string_view bytes) {
    Request request;
    Unpacker unpacker(bytes);
    GradeJob& grade = request.grade;
    CompareJob& compare = request.compare;
    unpacker(request.task, request.mesh, request.turntable, request.notice, grade.rubric,
             grade.reference.picture, grade.reference.task, grade.submission.picture,
             grade.submission.task, compare.crop, compare.mask, compare.pictures,
             compare.first.picture, compare.second.picture);
    unpackJob(unpacker, request.job);
    unpackJob(unpacker, grade.reference.job);
    unpackJob(unpacker, compare.first.job);
    unpackJob(unpacker, compare.second.job);
    unpacker.end();
    grade.submission.job = request.job;
    return request;
}

std::string pack(const Reply& reply) { return packed(reply); }
Reply unpackReply(std::string_view bytes) { return unpack<Reply>(bytes); }
std::string pack(const Hello& hello) { return packed(hello); }
Hello unpackHello(std::string_view bytes) { return unpack<Hello>(bytes); }

}  // namespace worker
}  // namespace server
}  // namespace farol
