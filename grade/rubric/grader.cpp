#include "grade/rubric/grader.h"

#include <algorithm>
#include <cmath>

#include "core/digest.h"
#include "core/lru_cache.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "grade/images/client_area.h"
#include "grade/images/compare.h"
#include "grade/images/comparison_cost.h"
#include "grade/images/measures.h"
#include "grade/messages.h"
#include "grade/rubric/drawing.h"
#include "grade/rubric/lent_assets.h"
#include "grade/rubric/score.h"
#include "grade/rubric/views.h"
#include "image/format.h"
#include "image/image_file.h"
#include "render/plan/instances.h"
#include "render/plan/plan.h"
#include "scene/animation.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMeshBytes = std::size_t{128} << 20U;
constexpr std::size_t kReferences = 8;  // tasks of one class
constexpr int kJpegQuality = 82;
constexpr int kNearlyPx = 8;           // a picture of about the window's size was cut by hand
constexpr std::size_t kMaxDrawn = 24;  // causes whose effect is drawn; more are estimated

/// Names a scene and all its files.
std::string identityOf(const render::Job& job) {
    std::string all =
        job.name + '\n' + job.path + '\n' + contentDigest(job.xml) + contentDigest(job.archive);
    if (job.assets)
        for (const std::string& path : job.assets->list())
            all += '\n' + path + '\n' + job.assets->version(path);
    return contentDigest(all);
}

/// True if more pixels than a driver's rounding makes differ by more than two levels.
bool differs(const image::Image& a, const image::Image& b) {
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

/// Puts the files that were handed out behind the job's own; null where the rubric has "lend" off.
std::shared_ptr<const LentAssets> lend(render::Job& job, const Reference& reference,
                                       const Rubric& rubric) {
    if (!rubric.lend || !reference.job.assets) return nullptr;
    if (!job.assets) job.assets = std::make_shared<scene::BundleAssets>();
    auto lent = std::make_shared<const LentAssets>(job.assets, reference.job.assets);
    job.assets = lent;
    return lent;
}

/// Charges a document with errors, in hundredths: two fifths if no engine opens it, else a small
/// sum for each part that was left out, beside the cost of its absence.
void chargeRepairs(const Diagnostics& diagnostics, Evidence& evidence) {
    constexpr double kCannotBeOpened = 40.0, kPart = 6.0, kMaxParts = 18.0;
    bool isBroken = false;
    double parts = 0.0;
    for (const Diagnostic& one : diagnostics) {
        if (one.severity != Severity::error) continue;
        isBroken = isBroken || one.code.starts_with("xml.");
        evidence.isUnclosed = evidence.isUnclosed || one.code == "xml.unclosed";
        // Files that are missing are causes.
        if (one.code.starts_with("scene.")) parts += kPart;
    }
    evidence.penalty = isBroken ? kCannotBeOpened : std::min(parts, kMaxParts);
}

void append(Diagnostics& to, Diagnostics more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

struct Grader::State {
    explicit State(render::Renderer& with) : renderer(with) {}

    std::shared_ptr<Reference> reference(const Subject& given, const Rubric& rubric,
                                         const std::string& rubricText) {
        const std::string key = contentDigest(given.picture.value_or("")) + identityOf(given.job) +
                                given.wanted.task + rubricText;
        if (const auto* known = references.find(key)) return *known;
        const Subject subject = opened(given);
        auto made = std::make_shared<Reference>();
        made->job = subject.job;
        made->job.identity = identityOf(subject.job);
        if (!subject.picture) {
            prepareScene(*made, rubric);
        } else {
            made->screen =
                image::decodeImage(*subject.picture, subject.job.name, {subject.job.name, 0, 0});
        }
        return references.put(key, std::move(made), 1);
    }

    void prepareScene(Reference& made, const Rubric& rubric) {
        auto prepared = std::make_shared<const render::Prepared>(render::prepare(made.job));
        made.timesS = chooseTimes(rubric, prepared->scene);
        made.scene.emplace(prepared, meshes);
        const render::InstanceList list =
            render::collect(prepared->scene, made.timesS.front(), false, *prepared->assets, meshes);
        made.shots = planShots(rubric, prepared->scene, list.bounds, made.timesS, false);
        made.fixed = planShots(rubric, prepared->scene, list.bounds, made.timesS, true);
        FrameParts parts = partsFor(rubric);
        parts.ids = true;  // the worth of each object
        std::vector<std::vector<std::uint32_t>> numbers;
        for (const Shot& shot : made.shots) {
            Frame frame = drawFrame(renderer, made.job, shot, parts);
            if (parts.flip) frame.flip.emplace(FloatImage(frame.color));
            numbers.push_back(frame.ids);
            made.frames.push_back(std::move(frame));
        }
        made.work = workOf(made.scene->outline, list, std::move(numbers));
        // Numbers of both sides name the same items.
        for (std::size_t v = 0; v < made.frames.size(); ++v)
            made.frames[v].ids = made.work.items[v];
    }

    /// Scene against scene.
    void compare(Reference& reference, const Subject& submission, const Rubric& rubric,
                 Grade& grade, Evidence& evidence, Diagnosis& diagnosis) {
        render::Job job = submission.job;
        const std::shared_ptr<const LentAssets> lent = lend(job, reference, rubric);
        job.identity = identityOf(job);
        Stopwatch watch;
        const auto prepared = std::make_shared<const render::Prepared>(render::prepare(job));
        grade.diagnostics = prepared->diagnostics;
        if (lent) append(grade.diagnostics, lent->notes(prepared->scene));
        grade.times.readMs += watch.lapMs();
        diagnosis = diagnose(*reference.scene, *prepared, reference.timesS, meshes);
        grade.traits =
            traitsOf(diagnosis, reference.scene->outline, submission.job.xml, reference.job.xml);
        keepDocument(submission, grade);
        if (!rubric.requirements.empty())
            grade.requirements =
                Requirements(rubric, renderer, meshes, prepared, submission.job).grade();
        grade.times.compareMs += watch.lapMs();
        const FrameParts parts = partsFor(rubric);
        std::vector<image::Image> handedIn;
        for (std::size_t i = 0; i < reference.shots.size(); ++i) {
            const Shot& shot = reference.shots[i];
            Frame frame = drawFrame(renderer, job, shot, parts);
            grade.times.drawMs += watch.lapMs();
            if (!frame.ids.empty()) translate(frame.ids, *prepared, shot.options.timeS, diagnosis);
            FramePair pair(reference.frames[i], frame, rubric.masks, false);
            grade.views.push_back(
                measure(shot.name, shot.options.timeS, pair, rubric.criteria, parts, grade));
            handedIn.push_back(std::move(frame.color));
            grade.times.compareMs += watch.lapMs();
        }
        gather(reference, *prepared, diagnosis, handedIn, evidence);
        chargeRepairs(prepared->diagnostics, evidence);
        grade.times.drawMs += watch.lapMs();
    }

    /// A scene by the rubric's requirements alone.
    void evaluateAlone(const Subject& submission, const Rubric& rubric, Grade& grade,
                       Evidence& evidence) {
        render::Job job = submission.job;
        job.identity = identityOf(job);
        Stopwatch watch;
        const auto prepared = std::make_shared<const render::Prepared>(render::prepare(job));
        grade.diagnostics = prepared->diagnostics;
        keepDocument(submission, grade);
        grade.times.readMs += watch.lapMs();
        grade.requirements =
            Requirements(rubric, renderer, meshes, prepared, submission.job).grade();
        grade.times.compareMs += watch.lapMs();
        const std::vector<double> timesS = chooseTimes(rubric, prepared->scene);
        const render::InstanceList list =
            render::collect(prepared->scene, timesS.front(), false, *prepared->assets, meshes);
        for (const Shot& shot : planShots(rubric, prepared->scene, list.bounds, timesS, false)) {
            const image::Image image = drawFrame(renderer, job, shot, {}).color;
            ViewGrade view;
            view.name = shot.name;
            view.timeS = shot.options.timeS;
            view.width = image.width;
            view.height = image.height;
            view.picture = image::encodeJpeg(image, kJpegQuality);
            grade.views.push_back(std::move(view));
        }
        chargeRepairs(prepared->diagnostics, evidence);
        grade.times.drawMs += watch.lapMs();
    }

    static void keepDocument(const Subject& submission, Grade& grade) {
        constexpr std::size_t kMaxDocument = 20'000;  // each byte may become three
        grade.document = toUtf8(submission.job.xml.substr(0, kMaxDocument));
    }

    /// Replaces instance numbers of the submission by the numbers of the matching items of the
    /// reference; items without a match get numbers after those.
    void translate(std::vector<std::uint32_t>& ids, const render::Prepared& prepared, double timeS,
                   const Diagnosis& diagnosis) {
        const render::InstanceList list =
            render::collect(prepared.scene, timeS, false, *prepared.assets, meshes);
        std::map<const scene::Model*, std::uint32_t> numberOf;
        const auto& items = diagnosis.submitted.items;
        const auto theirs = static_cast<std::uint32_t>(diagnosis.matching.mineOf.size());
        for (std::size_t j = 0; j < items.size(); ++j)
            numberOf[items[j].origin] = theirs + 1 + static_cast<std::uint32_t>(j);
        for (std::uint32_t i = 0; i < theirs; ++i)
            if (const int mine = diagnosis.matching.mineOf[i]; mine >= 0)
                numberOf[items[static_cast<std::size_t>(mine)].origin] = i + 1;
        std::vector<std::uint32_t> to(list.instances.size() + 1, 0);
        for (std::size_t k = 0; k < list.instances.size(); ++k)
            to[k + 1] = numberOf[list.instances[k].model];
        for (std::uint32_t& id : ids) id = id < to.size() ? to[id] : 0;
    }

    /// Measures the effect of each cause, the work that is there, and the rest of the errors.
    void gather(const Reference& reference, const render::Prepared& prepared,
                const Diagnosis& diagnosis, const std::vector<image::Image>& handedIn,
                Evidence& evidence) {
        const Outline& theirs = reference.scene->outline;
        evidence.diagnosis = &diagnosis;
        evidence.lights = static_cast<int>(theirs.lamps.size());
        evidence.hasCamera = theirs.rest.camera.has_value();
        evidence.moves = reference.scene->prepared->animated;
        evidence.present = theirs.items.empty() ? 1.0 : 0.0;
        for (std::size_t i = 0; i < theirs.items.size(); ++i)
            if (diagnosis.matching.mineOf[i] >= 0) evidence.present += reference.work.weights[i];
        evidence.present = std::min(1.0, evidence.present);
        evidence.spoiled.assign(diagnosis.causes.size(), 0.0);
        std::size_t drawable = 0, others = 0;
        for (const Cause& cause : diagnosis.causes) (isDrawn(cause) ? drawable : others) += 1;
        if (drawable + others == 0 && diagnosis.harmless.empty() && sameColors(reference, handedIn))
            return;
        RepairPainter painter(renderer, reference, prepared.assets);
        const std::vector<image::Image> right = painter.draw(diagnosis.mendedBut(-1));
        std::vector<image::Image> wanted;
        for (const Frame& frame : reference.frames) wanted.push_back(frame.color);
        evidence.unexplained = painter.spoiled(wanted, right);
        std::size_t drawn = 0;
        for (std::size_t c = 0; c < diagnosis.causes.size(); ++c) {
            const Cause& cause = diagnosis.causes[c];
            const Topic topic = kindOf(cause.code).topic;
            if (topic == Topic::camera) {
                const auto camera = diagnosis.mendedBut(static_cast<int>(c)).rest.camera;
                evidence.spoiled[c] = camera ? painter.spoiledByCamera(*camera) : 1.0;
            } else if (!isDrawn(cause) || ++drawn > kMaxDrawn) {
                for (const Fix& fix : cause.fixes)
                    for (const int item : fix.items)
                        evidence.spoiled[c] +=
                            reference.work.weights[static_cast<std::size_t>(item)];
                evidence.spoiled[c] = std::min(1.0, evidence.spoiled[c]);
            } else {
                // With one cause alone, the submission as it is shows it.
                const bool isAlone = drawable == 1 && others == 0 && diagnosis.harmless.empty();
                evidence.spoiled[c] = painter.spoiled(
                    right, isAlone ? painter.draw(diagnosis.submitted)
                                   : painter.draw(diagnosis.mendedBut(static_cast<int>(c))));
            }
        }
    }

    /// True for causes that renders measure: not missing items (counted), nor cameras.
    static bool isDrawn(const Cause& cause) {
        const Kind& kind = kindOf(cause.code);
        return kind.most > 0.0 && kind.topic != Topic::camera;
    }

    static bool sameColors(const Reference& reference, const std::vector<image::Image>& handedIn) {
        for (std::size_t i = 0; i < handedIn.size(); ++i)
            if (handedIn[i] != reference.frames[i].color) return false;
        return true;
    }

    static constexpr double kSomePixels = 0.002;  // changed by the order of triangles

    /// Measures one view by the criteria's metrics, as far as `parts` of both frames are there.
    ViewGrade measure(const std::string& name, double timeS, FramePair& pair,
                      const std::vector<Criterion>& criteria, const FrameParts& parts,
                      Grade& grade) {
        const image::Image &theirs = pair.reference().color, &mine = pair.submission().color;
        if (!pair.hasSameColors())
            spendOnComparison(renderer.budget(), theirs.width, theirs.height);
        ViewGrade view;
        view.name = name;
        view.timeS = timeS;
        view.width = theirs.width;
        view.height = theirs.height;
        grade.visible = grade.visible || (!pair.hasSameColors() && differs(theirs, mine));
        for (const MetricSpec& metric : metrics()) {
            const ImageMetric* image = metric.image();
            if (image == nullptr || !parts.covers(image->needs)) continue;
            // Layers that are rendered anyway show whether a difference is visible.
            const bool hasLayers = image->needs.hasLayers();
            if (&metric != &mainMetric() && !hasLayers && !isWeighed(metric, criteria)) continue;
            Measurement measured = image->compute(pair);
            grade.visible = grade.visible || (hasLayers && measured.loss > kSomePixels);
            view.measured.emplace(&metric, std::move(measured));
        }
        if (pair.hasSameColors()) return view;
        view.picture = image::encodeJpeg(mine, kJpegQuality);
        if (view.measured.at(&mainMetric()).loss > 0.0) {
            view.heat = image::encodeJpeg(heatMap(pair.beyond()), kJpegQuality);
            view.mask = coarseMask(pair.beyond());
        }
        return view;
    }

    static bool isWeighed(const MetricSpec& metric, const std::vector<Criterion>& criteria) {
        return std::any_of(criteria.begin(), criteria.end(), [&](const Criterion& one) {
            return one.metric == &metric && one.weight > 0.0;
        });
    }

    /// A picture on either side: the scene, if there is one, drawn as large as the picture.
    void comparePictures(const Reference& reference, const Subject& submission,
                         const Rubric& rubric, Grade& grade) {
        image::Image theirs = reference.screen.value_or(image::Image{}), mine;
        if (submission.picture) {
            const Location where{submission.job.name, 0, 0};
            std::string damage;
            mine = image::decodeImage(*submission.picture, where.file, where, &damage);
            if (!damage.empty())
                grade.diagnostics.push_back({Severity::warning,
                                             "image.damaged",
                                             where,
                                             "image \"" + where.file + "\" " + damage,
                                             {}});
        } else {
            mine = drawAs(theirs, submission.job, rubric, grade.diagnostics);
        }
        if (!reference.screen) {
            Diagnostics none;
            theirs = drawAs(mine, reference.job, rubric, none);
        }
        if (theirs.width != mine.width || theirs.height != mine.height) {
            const auto cut = [&](image::Image& image, const image::Image& like) {
                const int larger = std::max(image.width - like.width, image.height - like.height);
                if (rubric.cropAuto && larger > kNearlyPx)
                    image =
                        crop(image, clientArea(image, image::ImageSize{like.width, like.height}));
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
        FrameParts parts;
        parts.flip = true;  // computed of the colours, where no reference has it
        Frame expected, handedIn;
        expected.color = std::move(theirs);
        handedIn.color = std::move(mine);
        FramePair pair(expected, handedIn, rubric.masks, rubric.maskAxes);
        grade.views.push_back(measure("picture", 0.0, pair, pictureCriteria(rubric), parts, grade));
    }

    /// The scene's own view in its window's size, if the picture's content is about that large;
    /// else in the size of the content.
    image::Image drawAs(const image::Image& like, render::Job job, const Rubric& rubric,
                        Diagnostics& diagnostics) {
        job.identity = identityOf(job);
        const render::Prepared prepared = render::prepare(job);
        diagnostics = prepared.diagnostics;
        const glm::ivec2 window = render::pictureSize(prepared.scene, {});
        Rectangle area{0, 0, like.width, like.height};
        if (rubric.cropAuto) area = clientArea(like, image::ImageSize{window.x, window.y});
        const bool near = std::abs(area.width - window.x) <= kNearlyPx &&
                          std::abs(area.height - window.y) <= kNearlyPx;
        job.options.samples = rubric.samples;
        job.options.shading = rubric.shading;
        job.options.filter = rubric.filter;
        job.options.axes = rubric.axes;
        job.options.width = near ? window.x : area.width;
        job.options.height = near ? window.y : area.height;
        job.options.timeS = rubric.timesS.empty() ? 0.0 : rubric.timesS.front();
        image::Image image;
        renderer.draw(job, image);
        return image;
    }

    render::Renderer& renderer;
    render::MeshLibrary meshes{kMeshBytes};
    LruCache<std::string, std::shared_ptr<Reference>> references{kReferences};
};

Grader::Grader(render::Renderer& renderer) : state_(std::make_unique<State>(renderer)) {}
Grader::~Grader() = default;

std::vector<std::string> Grader::picturesOf(const Subject& reference, const Rubric& rubric) {
    if (reference.isNone()) return {};
    const auto shown = state_->reference(reference, rubric, writeRubric(rubric));
    if (shown->screen) {
        const image::Image& screen = *shown->screen;
        const Rectangle area =
            rubric.cropAuto ? clientArea(screen) : Rectangle{0, 0, screen.width, screen.height};
        return {image::encodeJpeg(crop(screen, area), kJpegQuality)};
    }
    std::vector<std::string> out;
    for (const Frame& frame : shown->frames)
        out.push_back(image::encodeJpeg(frame.color, kJpegQuality));
    return out;
}

Grade Grader::grade(const Subject& reference, const Subject& given, const Rubric& rubric) {
    const bool isAlone = reference.isNone();
    const auto against =
        isAlone ? nullptr : state_->reference(reference, rubric, writeRubric(rubric));
    Grade grade;
    grade.most = rubric.points;
    grade.manual = rubric.manual;
    Evidence evidence;
    Diagnosis diagnosis;
    Subject submission = given;
    bool scenes = isAlone || !against->screen;
    try {
        submission =
            opened(given, isAlone ? std::vector<std::string>() : filesNamedIn(against->job.xml));
        const bool isImage = scenes && submission.picture.has_value();
        scenes = scenes && !isImage;
        if (isAlone && isImage) throw Error(message<"grade.image">());
        if (submission.isFiles())
            grade.requirements = gradeFiles(rubric, *submission.job.assets);
        else if (isAlone)
            state_->evaluateAlone(submission, rubric, grade, evidence);
        else if (scenes)
            state_->compare(*against, submission, rubric, grade, evidence, diagnosis);
        else
            state_->comparePictures(*against, submission, rubric, grade);
        append(grade.diagnostics, submission.notes);
        if (isImage && !rubric.takesImages) {
            grade.similarity = 1.0 - grade.views.front().measured.at(&mainMetric()).loss;
            grade.notGraded = NotGraded{"grade.image", message<"grade.image">()};
        }
        // No requirement is met by an image.
        if (!scenes) grade.requirements = gradeFiles(rubric, scene::BundleAssets());
    } catch (const Error& error) {
        // Limits of the service for a request are not errors of the submission.
        if (error.code() == "limit.cost") throw;
        const bool isImage = submission.picture.has_value() && (isAlone || !against->screen);
        grade.notGraded = isImage && !rubric.takesImages
                              ? NotGraded{"grade.image", message<"grade.image">()}
                              : NotGraded{error.code(), messageOf(error.primary())};
        grade.diagnostics = error.diagnostics();
        grade.views.clear();
    }
    score(grade, scenes ? &evidence : nullptr, rubric, submission.job.xml, submission.job.name);
    return grade;
}

}  // namespace farol::grade
