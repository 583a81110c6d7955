#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "grade/requirements/requirement.h"
#include "grade/rubric/rubric_form.h"

/// The keys of requirements with their types and ranges, for the visitors of rubric_form.h.
namespace farol::grade {

inline constexpr std::size_t kMaxRequirements = 64;

/// Ids that are known at a place of a rubric.
class KnownIds {
  public:
    /// Refuses an id that is there already.
    template <typename Form>
    void add(const Form& form, const std::string& id) {
        form.template require<"rubric.range/twice">(!has(id), "id");
        ids_.push_back(id);
    }
    /// Reads the id of objects that are defined before.
    template <typename Form>
    void refer(Form& form, const std::string& key, std::string& id, const char* about) const {
        form.text(key, id, about);
        form.requireKnown(id.empty() || has(id), key, id, ids_);
    }

  private:
    bool has(const std::string& id) const {
        return std::find(ids_.begin(), ids_.end(), id) != ids_.end();
    }
    std::vector<std::string> ids_;
};

template <typename Form>
void describeInterval(Form& form, const std::string& key, std::optional<NumberRange>& interval,
                      double most, const char* about) {
    form.maybe(key, interval, NumberRange{0.0, most}, about, [&](Form& inner, NumberRange& value) {
        inner.number("least", value.least, 0, most);
        inner.number("most", value.most, 0, most);
        inner.template require<"rubric.range/least">(value.least <= value.most, "least");
    });
}

template <typename Form>
void describeSelector(Form& form, Selector& select, const KnownIds& known) {
    static const std::vector<std::string_view> kEffects(kEffectWords.all().begin(),
                                                        kEffectWords.all().end());
    form.someOf("shape", select.shapes, shapeWords(),
                "Shapes by their form, whatever file or command they come from; file: a mesh file "
                "that is none of them.");
    form.text("name", select.name,
              "Pattern with * and ?, in any case: name, id or file of the model, or the name of a "
              "group around it.");
    form.flag("textured", select.isTextured,
              "Has a texture whose image is in the submission and can be read.");
    form.flag("emissive", select.isEmissive, "Its material shines by itself.");
    form.flag("moves", select.moves, "Its middle moves with the time.");
    form.flag("turns", select.turns, "A rotation with a time acts on it.");
    form.flag("buried", select.isBuried,
              "All of it is inside another solid, at each of the rubric's times.");
    form.maybe("depth", select.depth, Selector::Depth{}, "Number of groups around it.",
               [](Form& inner, Selector::Depth& depth) {
                   inner.integer("least", depth.least, 0, 256);
                   inner.integer("most", depth.most, 0, 256);
                   inner.template require<"rubric.range/least">(depth.least <= depth.most, "least");
               });
    form.maybe("curve", select.curve, Selector::Curve{}, "Moves along a curve.",
               [](Form& inner, Selector::Curve& curve) {
                   inner.integer("points", curve.points, 1, 1000, "At least so many.");
                   inner.flag("align", curve.align, "null: either.");
               });
    form.maybe("material", select.material, Selector::Look{},
               "Brightness of its colours, the mean of the channels; shininess.",
               [](Form& inner, Selector::Look& look) {
                   describeInterval(inner, "diffuse", look.diffuse, 1, "");
                   describeInterval(inner, "ambient", look.ambient, 1, "");
                   describeInterval(inner, "specular", look.specular, 1, "");
                   describeInterval(inner, "emissive", look.emissive, 1, "");
                   describeInterval(inner, "shininess", look.shininess, 128, "");
               });
    known.refer(form, "turnsAbout", select.turnsAbout,
                "Goes all the way round one of these objects with the time.");
    known.refer(form, "below", select.below,
                "Hangs from the group of one of these objects, and moves with it.");
    known.refer(form, "above", select.above, "One of these objects hangs from its group.");
    known.refer(form, "not", select.isNot, "Is none of these objects.");
    form.maybe("seen", select.seen, Selector::Seen{}, "Covers pixels of the image.",
               [](Form& inner, Selector::Seen& seen) {
                   inner.integer("pixels", seen.pixels, 1, 1'000'000, "At least so many.");
                   inner.integer("times", seen.times, 1, 8, "At so many of the rubric's times.");
               });
    form.someOf("matters", select.matters, kEffects,
                "Its pixels change where this is left out of the image.");
}

template <typename Form>
void describeDefinition(Form& form, Definition& definition, KnownIds& known) {
    form.requiredText("id", definition.id, "The name of these objects in the rubric.");
    form.object("select", [&](Form& inner) { describeSelector(inner, definition.select, known); });
    known.add(form, definition.id);
}

template <typename Form>
void describeRequirement(Form& form, Requirement& requirement, KnownIds& known) {
    form.requiredText("id", requirement.id, "Unique; overrides.csv and later keys name it.");
    form.requiredText("text", requirement.text, "What is asked for, as the student reads it.");
    form.number("points", requirement.points, 0, 10'000);
    form.maybe("select", requirement.select, Selector{}, "Objects of the scene.",
               [&](Form& inner, Selector& select) { describeSelector(inner, select, known); });
    form.maybe("light", requirement.light, LightSelector{}, "Lights of the scene.",
               [&](Form& inner, LightSelector& light) {
                   inner.word("type", light.type, scene::kLightTypeWords, "null: any.");
                   known.refer(inner, "near", light.near, "Stands at one of these objects.");
                   inner.number("within", light.within, 0, 1000,
                                "How far from the object's middle, times its radius.");
                   known.refer(inner, "lights", light.lights,
                               "Half of these objects, of those that are visible, change without "
                               "the light.");
               });
    form.maybe("mesh", requirement.mesh, MeshSelector{},
               "Mesh files of the submission that are what farol generate makes.",
               [](Form& inner, MeshSelector& mesh) {
                   inner.requiredText("file", mesh.file,
                                      "Pattern with * and ? of the file's name.");
                   inner.requiredText("shape", mesh.shape,
                                      "Words as farol generate takes them: sphere 1 10 10.");
                   const std::string problem = problemOfShape(mesh.shape);
                   inner.template require<"rubric.range/shape">(
                       problem.empty() || !Form::kReads, "shape", "problem"_arg = uncut(problem));
               });
    const int kinds = int{requirement.select.has_value()} + int{requirement.light.has_value()} +
                      int{requirement.mesh.has_value()};
    form.template require<"rubric.type/kind">(kinds == 1, "");
    known.refer(form, "each", requirement.each,
                "All of these objects must match; count and atMost are not used then.");
    form.integer("count", requirement.count, 1, 100'000, "At least so many.");
    form.integer("atMost", requirement.atMost, 1, 100'000);
    form.flag("partial", requirement.partial, "Points for the share that is there.");
    form.word("distinct", requirement.distinct, kDistinctWords,
              "Count matches with equal images, or equal meshes, once.");
    form.maybe("order", requirement.order, Order{},
               "In the order of one property, another must not fall.",
               [](Form& inner, Order& order) {
                   inner.word("by", order.by, kOrderWords, "");
                   inner.word("rising", order.rising, kOrderWords, "");
               });
    if (requirement.order) {
        const auto isOrbital = [](OrderKey key) {
            return key == OrderKey::orbit || key == OrderKey::period;
        };
        const bool isOrbit =
            isOrbital(requirement.order->by) || isOrbital(requirement.order->rising);
        form.template require<"rubric.range/orbit">(
            !isOrbit || (requirement.select && !requirement.select->turnsAbout.empty()), "order");
    }
    if (requirement.select || (!Form::kReads && !Form::kWrites)) known.add(form, requirement.id);
}

template <typename Form>
void describeManual(Form& form, ManualCriterion& manual) {
    form.requiredText("id", manual.id, "The criterion's name in overrides.csv.");
    form.requiredText("text", manual.text, "What is marked, as the student reads it.");
    form.number("points", manual.points, 0, 10'000);
}

}  // namespace farol::grade
