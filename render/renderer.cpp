#include "render/renderer.h"

#include <cctype>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "core/stopwatch.h"
#include "core/workers.h"
#include "generator/registry.h"
#include "image/format.h"
#include "image/image_file.h"
#include "render/gl/library.h"
#include "render/gl/llvmpipe.h"
#include "render/gl/painter.h"
#include "render/plan/background.h"
#include "render/plan/camera.h"
#include "render/plan/chess_board.h"
#include "render/plan/cost.h"
#include "render/plan/instances.h"
#include "render/plan/messages.h"
#include "render/plan/overlay.h"
#include "render/plan/plan.h"
#include "render/plan/quality.h"
#include "render/plan/skybox.h"
#include "render/plan/texture_levels.h"
#include "render/plan/visibility.h"
#include "render/prepare.h"
#include "render/texture_prefetch.h"
#include "scene/animation.h"
#include "scene/loop.h"

namespace farol::render {
namespace {

constexpr std::size_t kMeshBytes = std::size_t{256} << 20;
constexpr std::size_t kScenes = 64;  // at most 50,000 elements each
constexpr std::size_t kPlacedBytes = std::size_t{64} << 20;

struct PlacedKey {
    const Prepared* prepared;  // alive as long as the entry is
    double timeS;              // 0 where nothing moves
    bool curves;
    auto operator<=>(const PlacedKey&) const = default;
};
struct KeptPlaces {
    std::shared_ptr<const Prepared> prepared;
    Placed placed;
};

UndecodedTexture openTexture(const TextureRef& ref, const scene::Assets& assets) {
    if (ref.chess) return {0, 0, false, [&ref](std::string&) { return chessBoard(*ref.chess); }};
    auto bytes = assets.read(ref.path);
    if (!bytes)
        throw Error(message<"asset.missing/image-file">("file"_arg = uncut(ref.path)), ref.where);
    const image::ImageSize size = image::imageSize(*bytes, ref.path, ref.where);
    // Shared, for a copy of the function is no copy of the file.
    const auto file = std::make_shared<const std::string>(std::move(*bytes));
    return {size.width, size.height, size.mayHaveAlpha, [&ref, file](std::string& damage) {
                return image::decodeImage(*file, ref.path, ref.where, &damage);
            }};
}

/// The debug overlay. No times of the clock: the same request must give the same bytes.
std::string describe(const FramePlan& frame, double timeS) {
    std::array<char, 400> text{};
    const Stats& stats = frame.stats;
    std::snprintf(text.data(), text.size(),
                  "time %.3f s   %d x %d px, %d samples\n%d of %d models, %lld triangles\n"
                  "%d draw calls, %d lights, %d textures\neye %.4g %.4g %.4g",
                  timeS, frame.view.size.x, frame.view.size.y, frame.style.samples,
                  stats.instances - stats.culled, stats.instances,
                  static_cast<long long>(stats.triangles), stats.drawCalls, stats.lights,
                  stats.textures, frame.camera.eye.x, frame.camera.eye.y, frame.camera.eye.z);
    return text.data();
}

void addElements(SceneReport& report, const InstanceList& list) {
    std::map<const scene::Model*, std::uint32_t> known;
    for (const Instance& instance : list.instances) {
        const scene::Model& model = *instance.model;
        const auto [at, isNew] =
            known.emplace(&model, static_cast<std::uint32_t>(report.elements.size()));
        if (isNew)
            report.elements.push_back({model.id, model.name,
                                       model.file.empty() ? model.command : model.file,
                                       model.where});
        report.copies.push_back(at->second);
    }
}

/// Whether next to nothing shows of a scene that has models. A skybox or a picture behind them
/// hides that from the pixels; then the plan alone decides.
bool isBlank(const FramePlan& frame, const image::Image& image) {
    const Stats& stats = frame.stats;
    if (frame.style.layer != Layer::color || stats.instances == 0) return false;
    if (stats.instances == stats.culled) return true;
    return frame.style.skyboxTexture < 0 && frame.style.backgroundTexture < 0 &&
           isNearlyBlank(image);
}

/// Adds findings about meshes and textures; in strict that is an error.
void takeFindings(Diagnostics& diagnostics, const Diagnostics& findings, const Job& job) {
    diagnostics.insert(diagnostics.end(), findings.begin(), findings.end());
    refuseErrors(diagnostics, job);
}

/// Warnings that the size of a texture's image gives. Throws as imageSize: a damaged head is news
/// to the author.
Diagnostics checkSize(const TextureRef& ref, const scene::Assets& assets) {
    const UndecodedTexture texture = openTexture(ref, assets);
    Diagnostics warnings;
    for (const TextureNote& note : sizeNotes(ref.cube, texture.width, texture.height, GlFacts{}))
        warnings.push_back(findingOf(note, ref));
    return warnings;
}

/// Likewise of the image behind the scene, as option or scene name it, and of the skybox.
Diagnostics checkSurroundings(const scene::Scene& scene, const PictureOptions& options,
                              const scene::Assets& assets) {
    Diagnostics warnings;
    const auto add = [&](const std::string& path, bool isCube, const Location& where) {
        if (path.empty()) return;
        TextureRef ref;
        ref.path = path;
        ref.cube = isCube;
        ref.where = where;
        for (Diagnostic& one : checkSize(ref, assets)) warnings.push_back(std::move(one));
    };
    add(chooseBackground(scene, options, assets).path, false,
        options.background ? Location{} : scene.background.where);
    if (scene.skybox) add(scene.skybox->path, true, scene.skybox->where);
    return warnings;
}

}  // namespace

struct Renderer::State {
    explicit State(GlSource from) : source(from) {
        gl::setMesaVariables(from);
        decoders.emplace(std::max(1U, std::thread::hardware_concurrency()));
        library = std::async(std::launch::async, gl::loadLibraries, from);
    }

    const GlSource source;
    std::optional<Workers> decoders;  ///< of the first frame's images
    std::future<void> library;        ///< of the GL: it is loaded beside other work
    std::optional<gl::Painter> made;
    /// Waits for the GL's library the first time.
    gl::Painter& painter();

    MeshLibrary meshes{kMeshBytes};
    PreparedCache scenes{kScenes};
    CostBudget budget;
    image::Image image;  ///< of the last picture: its memory serves the next
    LruCache<PlacedKey, KeptPlaces> places{kPlacedBytes};

    const Placed& placed(const std::shared_ptr<const Prepared>& prepared, const Job& job);
    Picture draw(const Prepared& prepared, const Placed& placed, const Job& job, image::Image& out,
                 double parseMs);
};

gl::Painter& Renderer::State::painter() {
    if (!made) {
        library.wait();
        made.emplace(gl::createContext(source));
    }
    return *made;
}

const Placed& Renderer::State::placed(const std::shared_ptr<const Prepared>& prepared,
                                      const Job& job) {
    const PlacedKey key{prepared.get(), prepared->animated ? job.options.timeS : 0.0,
                        job.options.curves};
    if (const KeptPlaces* known = places.find(key)) return known->placed;
    Placed fresh =
        place(prepared->scene, job.options.timeS, job.options.curves, *prepared->assets, meshes);
    const std::size_t bytes = bytesOf(fresh);
    return places.put(key, {prepared, std::move(fresh)}, bytes).placed;
}

Renderer::Renderer(GlSource source) : state_(std::make_unique<State>(source)) {}
Renderer::~Renderer() = default;
CostBudget& Renderer::budget() { return state_->budget; }
const GlFacts& Renderer::gl() const { return state_->painter().facts(); }
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Picture Renderer::draw(const Job& job, image::Image& image) {
    Stopwatch watch;
    const std::shared_ptr<const Prepared> kept = state_->scenes.get(job);
    const double parseMs = watch.lapMs();
    return state_->draw(*kept, state_->placed(kept, job), job, image, parseMs + watch.lapMs());
}

Picture Renderer::draw(const std::shared_ptr<const Prepared>& scene, const Job& job,
                       image::Image& image) {
    const Placed once =
        place(scene->scene, job.options.timeS, job.options.curves, *scene->assets, state_->meshes);
    return state_->draw(*scene, once, job, image, 0.0);
}

Picture Renderer::State::draw(const Prepared& prepared, const Placed& placed, const Job& job,
                              image::Image& out, double parseMs) {
    Picture picture;
    Stopwatch watch;
    picture.diagnostics = prepared.diagnostics;
    if (auto note = noteCameraStart(prepared.scene, job.options))
        picture.diagnostics.push_back(std::move(*note));
    picture.times.parseMs = parseMs;

    PictureOptions options = job.options;
    picture.quality = resolveBudget(options, prepared.scene, placed);
    Skipping skipping =
        job.drawUnseen ? Skipping{false, false, false, false, false, false} : Skipping{};
    skipping.notFinite = !job.markNotFinite;
    const auto openFile = [&](const TextureRef& ref) { return openTexture(ref, *prepared.assets); };
    std::optional<TexturePrefetch> prefetch;
    if (!made && decoders) prefetch.emplace(placed.scene.textures, openFile, *decoders);
    FramePlan frame = plan(prepared.scene, placed, options, *prepared.assets, meshes,
                           painter().facts(), skipping);
    budget.spend(frame);
    if (prefetch) prefetch->keepOnly(frame.textures);
    picture.camera = frame.camera;
    takeFindings(picture.diagnostics, frame.findings, job);
    picture.times.geometryMs = watch.lapMs();

    gl::Painter::Timings timings;
    Diagnostics warnings;  // about textures and see-through layers
    painter().draw(
        frame,
        [&](const TextureRef& ref) { return prefetch ? prefetch->open(ref) : openFile(ref); }, out,
        timings, warnings);
    takeFindings(picture.diagnostics, warnings, job);
    prefetch.reset();
    decoders.reset();  // a sandbox may be closed after the first frame
    if (isBlank(frame, out))
        takeFindings(
            picture.diagnostics,
            findHidden(prepared.scene, placed.scene, frame.view, frame.style.lit, options.timeS)
                .findings,
            job);
    const double total = watch.lapMs();
    picture.times.drawMs = timings.drawMs;
    picture.times.readbackMs = timings.readbackMs;
    // The rest of the painter's time is decoding and uploading.
    picture.times.geometryMs += total - timings.drawMs - timings.readbackMs;

    if (job.options.debug && job.options.layer == Layer::color)
        drawText(out, describe(frame, job.options.timeS), std::max(1, out.height / 300));
    picture.width = out.width;
    picture.height = out.height;
    picture.stats = frame.stats;
    return picture;
}

Picture Renderer::render(const Job& job) {
    Picture picture = draw(job, state_->image);
    Stopwatch watch;
    picture.bytes = image::encode(state_->image, job.options.format, job.options.quality);
    picture.times.encodeMs = watch.lapMs();
    picture.contentType = image::contentType(job.options.format);
    return picture;
}

SceneReport inspect(const Job& job) {
    const Prepared prepared = prepare(job);
    const scene::Scene& scene = prepared.scene;
    SceneReport report;
    report.diagnostics = prepared.diagnostics;
    if (auto note = noteCameraStart(scene, job.options))
        report.diagnostics.push_back(std::move(*note));
    report.title = scene.title;
    report.description = scene.description;
    report.animated = scene::isAnimated(scene);
    report.playS = scene.settings.timeRangeS;
    if (const auto loop = scene::loopSeconds(scene); loop && !report.playS)
        report.playS = glm::dvec2(0.0, *loop);
    const glm::ivec2 size = pictureSize(scene, job.options);
    report.width = size.x;
    report.height = size.y;
    MeshLibrary meshes(kMeshBytes);
    const InstanceList list = collect(scene, job.options.timeS, false, *prepared.assets, meshes);
    report.camera =
        chooseCamera(scene, job.options, list.bounds, static_cast<double>(size.x) / size.y);
    takeFindings(report.diagnostics, checkLighting(list, job.options.timeS), job);
    const HiddenModels hidden = findHidden(scene, list, viewOf(report.camera, size),
                                           !list.lights.empty(), job.options.timeS);
    if (hidden.areAll) takeFindings(report.diagnostics, hidden.findings, job);
    report.models = static_cast<int>(list.instances.size());
    report.lights = static_cast<int>(list.lights.size());
    addElements(report, list);
    if (scene.entity)  // it is drawn after the scene, and numbered so
        addElements(report,
                    collect(*scene.entity, job.options.timeS, false, *prepared.assets, meshes));
    std::set<std::string> textures;
    for (const Instance& instance : list.instances)
        report.triangles += static_cast<std::int64_t>(instance.mesh->mesh.triangles());
    for (const TextureRef& ref : list.textures) {
        if (ref.path.empty() || !textures.insert(ref.path).second) continue;
        takeFindings(report.diagnostics, checkSize(ref, *prepared.assets), job);
        const auto bytes = prepared.assets->read(ref.path);
        report.textureBytes += bytes ? static_cast<std::int64_t>(bytes->size()) : 0;
    }
    report.textures = static_cast<int>(textures.size());
    takeFindings(report.diagnostics, checkSurroundings(scene, job.options, *prepared.assets), job);
    return report;
}

std::string version(GlSource source) {
    return std::string("farol ") + FAROL_VERSION + " build " + gl::buildIdFor(source);
}

}  // namespace farol::render
