#include "grade/scenes.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "grade/dressing.h"
#include "grade/lights.h"
#include "grade/surface.h"
#include "grade/transforms.h"
#include "render/options.h"
#include "scene/animation.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMostPairs = 250'000;  // of pieces that are weighed against each other

class Comparer {
  public:
    Comparer(const Tree& reference, const Tree& submission, const glm::dvec2& times)
        : theirs_(reference), mine_(submission), times_(times) {
        const render::Box& box = reference.list.bounds;
        size_ = box.empty() ? 1.0 : std::max(1e-9, glm::length(box.max - box.min));
        lit_ = !reference.list.lights.empty() || !submission.list.lights.empty();
        out_.mineOf.resize(theirs_.pieces.size());
        out_.extra.assign(mine_.pieces.size(), true);
    }

    SceneComparison run() {
        matchEqual();
        matchLikely();
        for (std::size_t i = 0; i < theirs_.pieces.size(); ++i)
            if (out_.mineOf[i]) comparePair(theirs_.pieces[i], mine_.pieces[*out_.mineOf[i]]);
        tellMissing();
        tellExtra();
        add(compareLights(theirs_, mine_));
        if (theirs_.scene().camera && mine_.scene().camera)
            add(compareCameras(*theirs_.scene().camera, *mine_.scene().camera, size_));
        else if (theirs_.scene().camera)
            add({{"camera.missing", Topic::camera, "the camera is missing", {}}});
        compareSettings();
        return std::move(out_);
    }

  private:
    void add(Findings found) {
        for (Finding& one : found)
            if (told_
                    .insert({one.code, one.where.line, one.where.column,
                             one.where.line > 0 && one.code.starts_with("transform.")
                                 ? std::string()
                                 : one.message})
                    .second)
                out_.findings.push_back(std::move(one));
    }

    void match(std::size_t theirs, std::size_t mine) {
        out_.mineOf[theirs] = mine;
        out_.extra[mine] = false;
    }

    bool sameMesh(const Piece& a, const Piece& b) const {
        return a.mesh == b.mesh || a.mesh->id == b.mesh->id || a.mesh->mesh == b.mesh->mesh;
    }

    static bool sameDress(const Piece& a, const Piece& b) {
        const auto &x = a.model->texture, &y = b.model->texture;
        return a.material == b.material && x.has_value() == y.has_value() &&
               (!x || (x->path == y->path && x->chess == y->chess));
    }

    /// Pieces that are the same in all: most of a good submission.
    void matchEqual() {
        std::multimap<std::uint64_t, std::size_t> byMesh;
        for (std::size_t j = 0; j < mine_.pieces.size(); ++j)
            byMesh.emplace(mine_.pieces[j].mesh->id, j);
        for (const bool dressed : {true, false})
            for (std::size_t i = 0; i < theirs_.pieces.size(); ++i) {
                if (out_.mineOf[i]) continue;
                const Piece& theirs = theirs_.pieces[i];
                const auto [begin, end] = byMesh.equal_range(theirs.mesh->id);
                for (auto one = begin; one != end; ++one) {
                    const Piece& mine = mine_.pieces[one->second];
                    if (!out_.extra[one->second] || (dressed && !sameDress(theirs, mine)) ||
                        !samePlace(theirs.worldFromObject, mine.worldFromObject,
                                   theirs.mesh->bounds, size_))
                        continue;
                    match(i, one->second);
                    byMesh.erase(one);
                    break;
                }
            }
    }

    /// The rest, the likeliest first.
    void matchLikely() {
        std::vector<std::size_t> left, right;
        for (std::size_t i = 0; i < theirs_.pieces.size(); ++i)
            if (!out_.mineOf[i]) left.push_back(i);
        for (std::size_t j = 0; j < mine_.pieces.size(); ++j)
            if (out_.extra[j]) right.push_back(j);
        if (left.size() * right.size() > kMostPairs) {
            for (std::size_t k = 0; k < std::min(left.size(), right.size()); ++k)
                match(left[k], right[k]);
            return;
        }
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (std::size_t a = 0; a < left.size(); ++a)
            for (std::size_t b = 0; b < right.size(); ++b) {
                const double order =
                    std::abs(static_cast<double>(a) / static_cast<double>(left.size()) -
                             static_cast<double>(b) / static_cast<double>(right.size()));
                const double cost =
                    unlikeness(theirs_.pieces[left[a]], mine_.pieces[right[b]]) + 0.05 * order;
                if (cost < kStrangers) pairs.emplace_back(cost, left[a], right[b]);
            }
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [cost, i, j] : pairs)
            if (!out_.mineOf[i] && out_.extra[j]) match(i, j);
    }

    static constexpr double kStrangers = 1.6;

    double unlikeness(const Piece& a, const Piece& b) const {
        double sum = 0.0;
        const auto &wordsA = a.model->source.words, &wordsB = b.model->source.words;
        if (!sameMesh(a, b)) {
            const bool kin = !wordsA.empty() && !wordsB.empty() && wordsA[0] == wordsB[0];
            sum += kin ? 0.4 : 0.8;
        }
        const glm::dvec3 middleA = middleOf(a), middleB = middleOf(b);
        sum += std::min(0.8, 2.0 * glm::length(middleA - middleB) / size_);
        if (!sameDress(a, b)) sum += 0.2;
        if (!a.model->name.empty() || !b.model->name.empty())
            sum += a.model->name == b.model->name ? -0.3 : 0.1;
        if (a.steps.size() != b.steps.size()) sum += 0.1;
        return sum;
    }

    static glm::dvec3 middleOf(const Piece& piece) {
        const render::Box& box = piece.mesh->bounds;
        const glm::dvec3 middle = box.empty() ? glm::dvec3(0.0) : 0.5 * (box.min + box.max);
        return glm::dvec3(piece.worldFromObject * glm::dvec4(middle, 1.0));
    }

    void comparePair(const Piece& theirs, const Piece& mine) {
        const bool placed =
            samePlace(theirs.worldFromObject, mine.worldFromObject, theirs.mesh->bounds, size_);
        const bool equal = sameMesh(theirs, mine);
        Surface surface;
        if (!placed || !equal) surface = compareSurfaces(theirs, mine);
        const bool moves = times_.x != times_.y;
        if (!equal) {
            // Another mesh at another place may be the same surface: a scale that was baked in.
            if (!placed && surface.common < 0.9) {
                Piece there = mine;
                there.worldFromObject = theirs.worldFromObject;
                surface = compareSurfaces(theirs, there);
                add(explainPlace(theirs, mine, size_, times_));
            }
            if (compared_.insert({theirs.model, mine.model}).second)
                add(compareMeshes(theirs, mine, surface));
        } else if ((!placed && !surface.same()) ||
                   (moves && placed && !samePlaceLater(theirs, mine))) {
            add(explainPlace(theirs, mine, size_, times_));
        } else if (theirs.model->twoSided != mine.model->twoSided) {
            Surface same;
            same.compared = true;
            same.common = same.normalsSame = 1.0;
            add(compareMeshes(theirs, mine, same));
        }
        if (!dressed_.insert({theirs.model, mine.model}).second) return;
        add(compareTextures(theirs_, theirs, mine_, mine));
        add(compareMaterials(theirs, mine, lit_));
    }

    bool samePlaceLater(const Piece& theirs, const Piece& mine) const {
        const auto at = [&](const Piece& piece) {
            glm::dmat4 matrix(1.0);
            for (const Step& step : piece.steps)
                matrix = matrix * scene::matrixAt(*step.transform, times_.y);
            return matrix;
        };
        return samePlace(at(theirs), at(mine), theirs.mesh->bounds, size_);
    }

    /// Models that the submission lacks: by group, if none of the group's is there.
    void tellMissing() {
        std::map<int, std::vector<std::size_t>> byGroup;
        std::map<int, std::size_t> all;
        for (std::size_t i = 0; i < theirs_.pieces.size(); ++i) {
            ++all[theirs_.pieces[i].group];
            if (!out_.mineOf[i]) byGroup[theirs_.pieces[i].group].push_back(i);
        }
        for (const auto& [group, pieces] : byGroup) {
            const Piece& first = theirs_.pieces[pieces.front()];
            const bool whole = pieces.size() == all[group];
            const std::string inside =
                whole && first.parent > 0
                    ? " (a child of group " + std::to_string(first.parent) + " of the reference)"
                    : "";
            std::string what = whole ? "group " + std::to_string(group) +
                                           " of the reference is missing, with " + nameOf(first)
                                     : nameOf(first) + " of the reference is missing";
            if (pieces.size() > 1) what += " and " + std::to_string(pieces.size() - 1) + " more";
            add({{whole ? "group.missing" : "model.missing", Topic::models, what + inside, {}}});
        }
    }

    void tellExtra() {
        for (std::size_t j = 0; j < mine_.pieces.size(); ++j)
            if (out_.extra[j])
                add({{"model.extra", Topic::models,
                      nameOf(mine_.pieces[j]) + " is too much" +
                          inLine(mine_.pieces[j].model->where),
                      mine_.pieces[j].model->where}});
    }

    void compareSettings() {
        const auto &theirs = theirs_.scene().settings, &mine = mine_.scene().settings;
        const auto usual = scene::Shading::phong;
        const auto wanted = theirs.shading.value_or(usual), given = mine.shading.value_or(usual);
        if (wanted != given && lit_)
            add({{given == scene::Shading::flat ? "shading.flat" : "shading.mode",
                  Topic::materials,
                  given == scene::Shading::flat
                      ? std::string("the shading is flat, expected smooth")
                      : std::string("the scene asks for another shading than the reference"),
                  {}}});
        const auto &sky = theirs_.scene().skybox, &mySky = mine_.scene().skybox;
        const auto &back = theirs_.scene().background, &myBack = mine_.scene().background;
        if (sky.has_value() != mySky.has_value() ||
            (sky && theirs_.assets().read(sky->path) != mine_.assets().read(mySky->path)))
            add({{"background.skybox", Topic::textures,
                  mySky ? "the skybox is another one" : "the skybox is missing",
                  mySky ? mySky->where : Location{}}});
        if (back.color != myBack.color || back.path.empty() != myBack.path.empty() ||
            (!back.path.empty() &&
             theirs_.assets().read(back.path) != mine_.assets().read(myBack.path)))
            add({{"background.other", Topic::textures, "the background is another one",
                  myBack.where}});
    }

    const Tree &theirs_, &mine_;
    glm::dvec2 times_;
    double size_ = 1.0;
    bool lit_ = true;
    SceneComparison out_;
    std::set<std::tuple<std::string, int, int, std::string>> told_;
    std::set<std::pair<const scene::Model*, const scene::Model*>> compared_, dressed_;
};

}  // namespace

SceneComparison compareScenes(const Tree& reference, const Tree& submission,
                              const glm::dvec2& times) {
    return Comparer(reference, submission, times).run();
}

}  // namespace farol::grade
