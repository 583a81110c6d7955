#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/options.h"
#include "scene/assets.h"
#include "scene/error.h"
#include "scene/scene.h"

namespace farol::render {

/// One picture to make: a plain function of these bytes and options.
struct Job {
    std::string name = "scene.xml";  ///< of the document, for locations
    std::string xml;                 ///< the document, or a mesh file's bytes (by name's ending)
    std::shared_ptr<const scene::Assets> assets;
    PictureOptions options;
    bool strict = false;
    /// Names the document and every file beside it: a digest that changes with any of them. Where
    /// given, the scene that was read is kept under it for the next picture; may be empty.
    std::string identity = {};
    /// A zip or tar of the document and its files (scene/archive.h), in place of name, xml and
    /// assets; it is opened where the scene is read. Empty: there is none.
    std::string archive = {};
    /// Leaves nothing out that cannot be seen: tests show that the picture is the same.
    bool drawUnseen = false;
};

/// What was drawn and what was skipped.
struct Stats {
    int instances = 0;  ///< models, copies of scattered groups counted
    int culled = 0;     ///< of them not drawn: outside the view, or without any surface
    int drawCalls = 0, textures = 0, lights = 0;
    std::int64_t triangles = 0;
    int culledGroups = 0;     ///< groups told to be outside at once, without a look at their models
    int betweenSamples = 0;   ///< models too small to be met by a sample of any pixel
    int texturesSkipped = 0;  ///< pictures that only models sample which are not drawn
    std::int64_t lightsSkipped = 0;  ///< for each model: lights that add nothing to it
};

/// Wall time of each stage, ms.
struct StageTimes {
    double parseMs = 0, geometryMs = 0, drawMs = 0, readbackMs = 0, encodeMs = 0;
};

/// What a budget chose (PictureOptions::budgetMs), and the time that it is expected to take.
struct Quality {
    int samples = 4;
    double errorPx = kDefaultErrorPx;
    double expectedMs = 0.0;
    bool within =
        false;  ///< false: even the cheapest that may be chosen costs more than the budget
};

struct Picture {
    std::string bytes;        ///< encoded
    std::string contentType;  ///< "image/png"
    int width = 0, height = 0;
    Diagnostics diagnostics;  ///< info and warnings
    scene::Camera camera;     ///< the one used, for clients that orbit from it
    Stats stats;
    StageTimes times;
    std::optional<Quality> quality;  ///< where PictureOptions::budgetMs asked for it
};

/// A model's element in the document.
struct ModelElement {
    std::string id, name;
    std::string file;  ///< of its mesh, or the command that makes it, as written
    Location where;
};

/// Facts about a scene without drawing it.
struct SceneReport {
    Diagnostics diagnostics;
    std::string title, description;
    int width = 512, height = 512;
    bool animated = false;
    /// What an animation shows: the scene's own time range, else one loop (scene/loop.h) from 0.
    std::optional<glm::dvec2> playS;
    scene::Camera camera;
    std::int64_t triangles = 0;
    int models = 0, lights = 0, textures = 0;
    std::int64_t textureBytes = 0;       ///< of the files, undecoded
    std::vector<ModelElement> elements;  ///< that are drawn, in document order
    std::vector<std::uint32_t> copies;   ///< the element of the number i + 1 in a layer=id picture
};

/// Draws scenes with one GL context of its own. Not shareable between threads: each thread makes
/// its own. Caches change the time taken, never the bytes. Create throws std::runtime_error
/// when there is no GL.
class Renderer {
  public:
    Renderer();
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Throws Error (option.*, xml.*, scene.*, asset.*, shape.*, mesh.*, image.*, limit.*).
    Picture render(const Job& job);
    /// The same without encoding: the pixels go to `image`, Picture::bytes stays empty.
    Picture draw(const Job& job, Image& image);
    /// The GL at hand: "llvmpipe (LLVM ...), 4.5 (Core Profile) Mesa 22.3.6".
    const std::string& gl() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads and resolves without GL; throws Error as Renderer::render does for what it can tell.
SceneReport inspect(const Job& job);

/// "farol 0.1.0 build 0123456789abcdef": our version and the build of all that draws (build_id.h),
/// for /version and ETags.
std::string version();

}  // namespace farol::render
