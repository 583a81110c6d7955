#include "grade/grader.h"

#include <algorithm>
#include <cmath>

#include "grade/client_area.h"
#include "grade/compare.h"
#include "grade/lent_assets.h"
#include "grade/measures.h"
#include "grade/scenes.h"
#include "grade/score.h"
#include "grade/ssim.h"
#include "grade/views.h"
#include "render/encode.h"
#include "render/image_file.h"
#include "render/lru.h"
#include "render/plan.h"
#include "render/stopwatch.h"
#include "scene/digest.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMeshBytes = std::size_t{128} << 20U;
constexpr std::size_t kReferences = 8;  // tasks of one class
constexpr int kJpegQuality = 82;
constexpr int kNearlyPx = 8;  // a picture of about the window's size was cut by hand

/// Names a scene and all its files.
std::string identityOf(const render::Job& job) {
    std::string all =
        job.name + '\n' + scene::contentDigest(job.xml) + scene::contentDigest(job.archive);
    if (job.assets)
        for (const std::string& path : job.assets->list())
            all += '\n' + path + '\n' + job.assets->version(path);
    return scene::contentDigest(all);
}

/// A reference with what all comparisons share.
struct Reference {
    std::string picture;   ///< bytes, where it is a picture
    render::Image screen;  ///< the picture, its frame cut off
    render::Job job;
    std::vector<double> timesS;
    Tree tree;
    std::vector<Shot> shots;
    std::vector<Frame> frames;
};

/// Ids of the submission's pieces become those of the reference's that they stand for; what has
/// no partner gets numbers of its own.
void translate(std::vector<std::uint32_t>& ids, const SceneComparison& found) {
    std::vector<std::uint32_t> to(found.extra.size() + 1, 0);
    const auto theirs = static_cast<std::uint32_t>(found.mineOf.size());
    for (std::size_t j = 0; j < found.extra.size(); ++j)
        to[j + 1] = theirs + 1 + static_cast<std::uint32_t>(j);
    for (std::size_t i = 0; i < found.mineOf.size(); ++i)
        if (found.mineOf[i]) to[*found.mineOf[i] + 1] = static_cast<std::uint32_t>(i) + 1;
    for (std::uint32_t& id : ids) id = id < to.size() ? to[id] : 0;
}

/// True if more pixels than a driver's rounding makes differ by more than two levels.
bool differs(const render::Image& a, const render::Image& b) {
    if (a.width != b.width || a.height != b.height) return true;
    constexpr int kRounding = 2;
    constexpr double kShare = 5e-5;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            if (std::abs(a.pixels[c] - b.pixels[c]) > kRounding) {
                ++count;
                break;
            }
    return static_cast<double>(count) >
           std::max(3.0, kShare * static_cast<double>(a.pixels.size() / 4));
}

/// What was handed out stands behind the job's own files; nothing where the rubric lends none.
std::shared_ptr<const LentAssets> lend(render::Job& job, const Reference& reference,
                                       const Rubric& rubric) {
    if (!rubric.lend || !reference.job.assets) return nullptr;
    if (!job.assets) job.assets = std::make_shared<scene::BundleAssets>();
    auto lent = std::make_shared<const LentAssets>(job.assets, reference.job.assets);
    job.assets = lent;
    return lent;
}

void append(Diagnostics& to, Diagnostics more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

struct Grader::State {
    explicit State(render::Renderer& with) : renderer(with) {}

    std::shared_ptr<Reference> reference(const Subject& given, const Rubric& rubric,
                                         const std::string& rubricText) {
        const std::string key =
            scene::contentDigest(given.picture) + identityOf(given.job) + given.task + rubricText;
        if (const auto* known = references.find(key)) return *known;
        const Subject subject = opened(given);
        auto made = std::make_shared<Reference>();
        made->picture = subject.picture;
        made->job = subject.job;
        made->job.identity = identityOf(subject.job);
        if (subject.picture.empty()) {
            auto prepared = std::make_shared<const render::Prepared>(render::prepare(made->job));
            made->timesS = chooseTimes(rubric, prepared->scene);
            made->tree = growTree(prepared, made->timesS.front(), meshes);
            made->shots = planShots(rubric, made->tree, made->timesS);
            for (const Shot& shot : made->shots) {
                Frame frame = drawFrame(renderer, made->job, shot, partsFor(rubric));
                if (partsFor(rubric).flip) frame.flip.emplace(FloatImage(frame.color));
                made->frames.push_back(std::move(frame));
            }
        } else {
            made->screen =
                render::decodeImage(subject.picture, subject.job.name, {subject.job.name, 0, 0});
        }
        return references.put(key, std::move(made), 1);
    }

    /// Scene against scene.
    void compare(const Reference& reference, const Subject& submission, const Rubric& rubric,
                 Grade& grade, Findings& findings) {
        render::Job job = submission.job;
        const std::shared_ptr<const LentAssets> lent = lend(job, reference, rubric);
        job.identity = identityOf(job);
        render::Stopwatch watch;
        auto prepared = std::make_shared<const render::Prepared>(render::prepare(job));
        grade.diagnostics = prepared->diagnostics;
        if (lent) append(grade.diagnostics, lent->notes(prepared->scene));
        const Tree tree = growTree(prepared, reference.timesS.front(), meshes);
        grade.times.readMs += watch.lapMs();
        const SceneComparison found = compareScenes(
            reference.tree, tree, {reference.timesS.front(), reference.timesS.back()});
        findings = found.findings;
        grade.times.compareMs += watch.lapMs();
        for (std::size_t i = 0; i < reference.shots.size(); ++i) {
            const Shot& shot = reference.shots[i];
            Frame frame = drawFrame(renderer, job, shot, partsFor(rubric));
            grade.times.drawMs += watch.lapMs();
            translate(frame.ids, found);
            ViewGrade view = measure(shot.name, shot.options.timeS, reference.frames[i].color,
                                     frame.color, rubric, false, grade);
            const Frame& theirs = reference.frames[i];
            if (theirs.flip && frame.color != theirs.color) {
                const Plane seen =
                    flip(*theirs.flip, frame.color, differing(theirs.color, frame.color));
                const Summary summary = summarize(seen, contentOf(theirs.color, frame.color));
                view.flipMean = summary.mean;
                view.flipP95 = summary.p95;
            }
            if (!frame.ids.empty())
                view.coverage = uncovered(theirs.ids, frame.ids, view.width, view.height);
            const Mask same = shared(theirs.ids, frame.ids);
            if (!frame.depth.pixels.empty())
                view.depth = shareOf(beyondAPixel(theirs.depth, frame.depth, kFullDepth), same);
            if (!frame.normal.pixels.empty())
                view.normals =
                    shareOf(beyondAPixel(theirs.normal, frame.normal, kFullLevels), same);
            grade.visible = grade.visible || view.coverage > kSomePixels ||
                            view.normals > kSomePixels || view.depth > kSomePixels;
            grade.views.push_back(std::move(view));
            grade.times.compareMs += watch.lapMs();
        }
    }

    static constexpr int kFullDepth = 12;         // levels: a step of depth well beyond rounding
    static constexpr double kSomePixels = 0.002;  // what the order of triangles changes

    /// Pictures of one size: what pictures alone tell.
    static ViewGrade measure(const std::string& name, double timeS, const render::Image& theirs,
                             const render::Image& mine, const Rubric& rubric, bool axes,
                             Grade& grade) {
        ViewGrade view;
        view.name = name;
        view.timeS = timeS;
        view.width = theirs.width;
        view.height = theirs.height;
        if (theirs == mine) return view;
        Mask mask;
        hide(mask, theirs.width, theirs.height, rubric.masks);
        if (axes) hideAxes(mask, theirs, mine);
        const Plane beyond = beyondAPixel(theirs, mine, kFullLevels);
        view.difference = shareOf(beyond, both(contentOf(theirs, mine), mask));
        for (const Criterion& one : rubric.criteria)
            if (one.measure == Measure::ssim && one.weight > 0.0 && theirs.width > 2 * kSsimReach &&
                theirs.height > 2 * kSsimReach)
                view.ssim = summarize(ssim(FloatImage(theirs), FloatImage(mine)),
                                      ssimMask(mask, theirs.width, theirs.height))
                                .mean;
        grade.visible = grade.visible || differs(theirs, mine);
        view.picture = render::encodeJpeg(mine, kJpegQuality);
        if (view.difference > 0.0) view.heat = render::encodeJpeg(heatMap(beyond), kJpegQuality);
        return view;
    }

    /// A picture on either side: the scene, if there is one, drawn as large as the picture.
    void comparePictures(const Reference& reference, const Subject& submission,
                         const Rubric& rubric, Grade& grade) {
        render::Image theirs = reference.screen, mine;
        if (!submission.picture.empty())
            mine = render::decodeImage(submission.picture, submission.job.name,
                                       {submission.job.name, 0, 0});
        else
            mine = drawAs(theirs, submission.job, rubric, grade.diagnostics);
        if (reference.picture.empty()) {
            Diagnostics none;
            theirs = drawAs(mine, reference.job, rubric, none);
        }
        if (theirs.width != mine.width || theirs.height != mine.height) {
            const auto cut = [&](render::Image& image, const render::Image& like) {
                const int larger = std::max(image.width - like.width, image.height - like.height);
                if (rubric.cropAuto && larger > kNearlyPx)
                    image =
                        crop(image, clientArea(image, render::ImageSize{like.width, like.height}));
            };
            cut(theirs, mine);
            cut(mine, theirs);
            const int wide = std::min(theirs.width, mine.width),
                      high = std::min(theirs.height, mine.height);
            if (std::max(theirs.width, mine.width) - wide <= kNearlyPx &&
                std::max(theirs.height, mine.height) - high <= kNearlyPx) {
                theirs = crop(theirs, {0, 0, wide, high});
                mine = crop(mine, {0, 0, wide, high});
            }
        }
        requireSameSize(theirs.width, theirs.height, mine.width, mine.height);
        ViewGrade view = measure("picture", 0.0, theirs, mine, rubric, rubric.maskAxes, grade);
        if (partsFor(rubric).flip && theirs != mine) {
            Mask mask = contentOf(theirs, mine);
            if (rubric.maskAxes) hideAxes(mask, theirs, mine);
            const Summary summary = summarize(flip(FloatImage(theirs), FloatImage(mine)), mask);
            view.flipMean = summary.mean;
            view.flipP95 = summary.p95;
        }
        grade.views.push_back(std::move(view));
    }

    /// The scene's own view in its window's size, if the picture's content is about that large;
    /// else in the size of the content.
    render::Image drawAs(const render::Image& like, render::Job job, const Rubric& rubric,
                         Diagnostics& diagnostics) {
        job.identity = identityOf(job);
        const render::Prepared prepared = render::prepare(job);
        diagnostics = prepared.diagnostics;
        const glm::ivec2 window = render::pictureSize(prepared.scene, {});
        Rectangle area{0, 0, like.width, like.height};
        if (rubric.cropAuto) area = clientArea(like, render::ImageSize{window.x, window.y});
        const bool near = std::abs(area.width - window.x) <= kNearlyPx &&
                          std::abs(area.height - window.y) <= kNearlyPx;
        job.options.samples = rubric.samples;
        job.options.shading = rubric.shading;
        job.options.filter = rubric.filter;
        job.options.axes = rubric.axes;
        job.options.width = near ? window.x : area.width;
        job.options.height = near ? window.y : area.height;
        job.options.timeS = rubric.timesS.empty() ? 0.0 : rubric.timesS.front();
        render::Image image;
        renderer.draw(job, image);
        return image;
    }

    render::Renderer& renderer;
    render::MeshLibrary meshes{kMeshBytes};
    render::LruCache<std::string, std::shared_ptr<Reference>> references{kReferences};
};

Grader::Grader(render::Renderer& renderer) : state_(std::make_unique<State>(renderer)) {}
Grader::~Grader() = default;

std::vector<std::string> Grader::picturesOf(const Subject& reference, const Rubric& rubric) {
    const auto shown = state_->reference(reference, rubric, writeRubric(rubric));
    if (!shown->picture.empty()) {
        const Rectangle area = rubric.cropAuto
                                   ? clientArea(shown->screen)
                                   : Rectangle{0, 0, shown->screen.width, shown->screen.height};
        return {render::encodeJpeg(crop(shown->screen, area), kJpegQuality)};
    }
    std::vector<std::string> out;
    for (const Frame& frame : shown->frames)
        out.push_back(render::encodeJpeg(frame.color, kJpegQuality));
    return out;
}

Grade Grader::grade(const Subject& reference, const Subject& given, const Rubric& rubric) {
    const auto against = state_->reference(reference, rubric, writeRubric(rubric));
    Grade grade;
    grade.most = rubric.points;
    Findings findings;
    Subject submission = given;
    bool scenes = against->picture.empty();
    try {
        submission = opened(given);
        scenes = scenes && submission.picture.empty();
        if (scenes)
            state_->compare(*against, submission, rubric, grade, findings);
        else
            state_->comparePictures(*against, submission, rubric, grade);
    } catch (const Error& error) {
        grade.refused = true;
        grade.diagnostics = error.diagnostics();
        grade.views.clear();
    }
    score(grade, findings, rubric, scenes, submission.job.xml, submission.job.name);
    return grade;
}

}  // namespace farol::grade
