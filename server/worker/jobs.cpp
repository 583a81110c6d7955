#include "server/worker/jobs.h"

#include <cstdlib>
#include <new>

#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "render/encode.h"
#include "render/image_file.h"
#include "scene/archive.h"
#include "server/worker/comparison.h"
#include "server/worker/pictures.h"

namespace farol::server::worker {
namespace {

// A box in one plain colour before a background of another.
constexpr const char* kCanary = R"(<world>
  <window width="16" height="16"/>
  <camera><position x="0" y="0" z="5"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="100"/></camera>
  <group><models><model file="box_2_1.3d">
    <color><diffuse R="255" G="128" B="0"/></color></model></models></group>
</world>)";

// A lit one and a lit and textured one.
constexpr const char* kLit = R"(<world>
  <window width="16" height="16"/>
  <camera><position x="0" y="2" z="5"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="100"/></camera>
  <lights><light type="point" posX="3" posY="4" posZ="5"/></lights>
  <group><models>
    <model file="sphere_1_8_8.3d"><color><specular R="255" G="255" B="255"/>
      <shininess value="32"/></color></model>
    <model file="plane_4_1.3d"><texture file="texel.png"/></model>
  </models></group>
</world>)";

render::Job canaryJob() {
    render::Job job;
    job.name = "canary.xml";
    job.xml = kCanary;
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.shading = scene::Shading::solid;
    job.options.background = "#204060";
    job.options.samples = 1;
    job.options.axes = false;
    return job;
}

bool isColor(const render::Image& image, int x, int y, int r, int g, int b) {
    const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
    // One step for the rounding of colours on their way through float.
    return std::abs(pixel[0] - r) <= 1 && std::abs(pixel[1] - g) <= 1 &&
           std::abs(pixel[2] - b) <= 1;
}

void check(render::Renderer& renderer) {
    const render::Picture picture = renderer.render(canaryJob());
    const render::Image image = render::decodeImage(picture.bytes, "canary.png");
    if (image.width != 16 || image.height != 16)
        throw std::runtime_error("the canary picture has the wrong size");
    if (!isColor(image, 0, 0, 0x20, 0x40, 0x60) || !isColor(image, 8, 8, 255, 128, 0))
        throw std::runtime_error("the canary picture has the wrong colours");
}

std::string makeMesh(const MeshJob& job) {
    const scene::BundleAssets noFiles;
    const std::size_t triangles = generator::countTriangles(job.words, noFiles);
    if (triangles > kMaxMeshTriangles)
        throw Error("limit.triangles", "The mesh would have " + std::to_string(triangles) +
                                           " triangles; at most " +
                                           std::to_string(kMaxMeshTriangles) + " are sent.");
    const auto format = generator::io::formatOf("mesh." + job.format);
    if (!format) throw Error("option.range", "format must be 3d, obj or ply", {}, "format");
    return generator::io::encodeMesh(generator::generate(job.words, noFiles), *format);
}

GradeReply makeGrade(grade::Grader& grader, const GradeJob& job) {
    const grade::Rubric rubric =
        job.rubric.empty() ? grade::defaultRubric() : grade::readRubric(job.rubric, "rubric.json");
    GradeReply reply;
    const render::Job& given = job.submission.job;
    if (given.xml.empty() && given.archive.empty() && job.submission.picture.empty()) {
        reply.pictures = grader.picturesOf(job.reference, rubric);
        return reply;
    }
    grade::Grade made = grader.grade(job.reference, job.submission, rubric);
    reply.json = grade::toJson(made);
    reply.points = made.points;
    reply.most = made.most;
    reply.passed = made.passed;
    reply.refused = made.refused;
    reply.readMs = made.times.readMs;
    reply.drawMs = made.times.drawMs;
    reply.compareMs = made.times.compareMs;
    for (grade::ViewGrade& view : made.views) {
        reply.pictures.push_back(std::move(view.picture));
        reply.pictures.push_back(std::move(view.heat));
    }
    return reply;
}

}  // namespace

Reply work(render::Renderer& renderer, grade::Grader& grader, const Request& request) {
    Reply reply;
    try {
        switch (request.task) {
            case Task::render:
                reply.picture = renderer.render(request.job);
                break;
            case Task::inspect:
                reply.report = render::inspect(request.job);
                break;
            case Task::mesh:
                reply.mesh = makeMesh(request.mesh);
                break;
            case Task::unpack:
                reply.bundle = scene::readArchive(request.job.archive);
                break;
            case Task::turntable:
                reply.picture = turnAround(renderer, request.job, request.turntable);
                break;
            case Task::notice:
                reply.picture = drawNotice(request.notice, request.job.options);
                break;
            case Task::grade:
                reply.grade = makeGrade(grader, request.grade);
                break;
            case Task::compare:
                reply.compare = compareSubjects(renderer, request.compare);
                break;
            case Task::check:
                check(renderer);
                break;
        }
        return reply;
    } catch (const Error& error) {
        reply.outcome = Outcome::refused;
        reply.diagnostics = error.diagnostics();
    } catch (const std::bad_alloc&) {
        reply.outcome = Outcome::memory;
    } catch (const std::exception& fault) {
        reply.outcome = Outcome::broken;
        reply.message = fault.what();
    }
    return reply;
}

void warmUp(render::Renderer& renderer) {
    check(renderer);
    render::Job job;
    job.xml = kLit;
    job.assets = std::make_shared<scene::BundleAssets>(std::map<std::string, std::string>{
        {"texel.png", render::encodePng({1, 1, {0x80, 0x80, 0x80, 0xFF}})}});
    renderer.render(job);
}

}  // namespace farol::server::worker
