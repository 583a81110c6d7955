#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/image.h"
#include "render/gl_facts.h"
#include "render/gl_source.h"
#include "render/options.h"
#include "render/plan/report.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::render {

class CostBudget;
struct Prepared;

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
    /// A zip or tar of the document and its files (scene/files/archive.h), in place of name, xml
    /// and assets; it is opened where the scene is read. Empty: there is none.
    std::string archive = {};
    /// Of the document among its assets; empty: at their top.
    std::string path = {};
    /// Leaves nothing out that cannot be seen: tests show that the picture is the same.
    bool drawUnseen = false;
    /// Draws magenta where light, place or normal is NaN or infinite: for tests.
    bool markNotFinite = false;
};

/// Wall time of each stage, ms.
struct StageTimes {
    double parseMs = 0, geometryMs = 0, drawMs = 0, readbackMs = 0, encodeMs = 0;
};

struct Picture {
    std::string bytes;        ///< encoded
    std::string contentType;  ///< "image/png"
    int width = 0, height = 0;
    Diagnostics diagnostics;  ///< info and warnings; with missing=placeholder also errors
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
    /// The time range of an animation, seconds: the scene's own time range, else one loop
    /// (scene/loop.h) from 0.
    std::optional<glm::dvec2> playS;
    scene::Camera camera;
    std::int64_t triangles = 0;
    int models = 0, lights = 0, textures = 0;
    std::int64_t textureBytes = 0;       ///< of the files, undecoded
    std::vector<ModelElement> elements;  ///< that are drawn, in document order
    std::vector<std::uint32_t> copies;   ///< the element of the number i + 1 in a layer=id picture
};

/// Draws scenes with its own GL context. Not shareable between threads: each thread makes
/// its own. Caches change the time taken, never the bytes.
class Renderer {
  public:
    /// Begins to load the GL's libraries. The first call of another function makes the GL context,
    /// for its thread, and throws std::runtime_error where this machine has no such GL.
    explicit Renderer(GlSource source = GlSource::automatic);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Throws Error (option.*, xml.*, scene.*, asset.*, shape.*, mesh.*, image.*, limit.*).
    Picture render(const Job& job);
    /// The same without encoding: the pixels go to `image`, Picture::bytes stays empty.
    Picture draw(const Job& job, image::Image& image);
    /// Draws a scene that was read, or changed since, by the job's name and options; nothing of it
    /// is kept for other frames. Throws as render does.
    Picture draw(const std::shared_ptr<const Prepared>& scene, const Job& job, image::Image& image);
    /// Budget of the frames that follow; without bound until one is assigned. A frame
    /// over it is refused: render and draw throw Error limit.cost.
    CostBudget& budget();
    /// Facts of the GL at hand.
    const GlFacts& gl() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads and resolves without GL. Throws the errors of Renderer::render that need no GL.
SceneReport inspect(const Job& job);

/// "farol 0.2.0 build 0123456789abcdef": the version, and the build id of the program and of the
/// libraries that draw, for /version and ETags. Loads the libraries of the source.
std::string version(GlSource source = GlSource::automatic);

}  // namespace farol::render
