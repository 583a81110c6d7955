#include "grade/structure/dress_mesh.h"

#include <cmath>

#include "core/text.h"
#include "generator/registry.h"
#include "grade/structure/dressing.h"
#include "grade/structure/messages.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

using scene::Model;

/// Replaces the mesh; one of another size goes into a group that scales it back.
void takeMesh(Outline& outline, int item, const Outline::Item& theirs,
              const glm::dmat4& mineFromTheirs) {
    Outline::Item& mine = itemAt(outline, item);
    const Model model = modelOfReference(theirs);
    mine.model.source = model.source;
    mine.model.file = model.file;
    mine.model.command = model.command;
    mine.model.revolve = model.revolve;
    mine.model.uv = model.uv;
    mine.model.autoLod = model.autoLod;
    mine.mesh = theirs.mesh;
    if (mineFromTheirs == glm::dmat4(1.0)) return;
    const auto parts = decomposed(mineFromTheirs);
    if (!parts) return;
    Outline::Node node;
    node.parent = mine.node;
    for (const scene::Transform& part : *parts) {
        Link link;
        link.transform = part;
        link.id = outline.nextLink++;
        node.links.push_back(link);
    }
    mine.node = static_cast<int>(outline.nodes.size());
    outline.nodes.push_back(std::move(node));
}

Message exchanged(const generator::Argument& first, const generator::Argument& second,
                  const std::string& shape) {
    return causeMessage<"part.finding/exchanged">("first"_arg = lowerCase(first.name),
                                                  "second"_arg = lowerCase(second.name),
                                                  "shape"_arg = shape);
}

/// Explains another form; for shapes by their names and arguments.
template <typename Explain>
void explainShape(const Outline::Item& a, const Outline::Item& b, const Explain& explain) {
    const scene::ShapeCall &expected = a.model.source.shape, &actual = b.model.source.shape;
    if (expected.entry == nullptr || actual.entry == nullptr)
        return explain("model.shape", causeMessage<"part.finding/surface">());
    const Message values = twoValues(generator::textOf(actual), generator::textOf(expected));
    if (expected.entry != actual.entry)
        return explain("model.shape",
                       causeMessage<"part.finding/shape">("value"_arg = actual.entry->name,
                                                          "expected"_arg = expected.entry->name),
                       values, actual.entry->name + " " + expected.entry->name);
    const std::vector<generator::Argument>& arguments = expected.entry->arguments;
    for (std::size_t k = 0; k + 1 < arguments.size(); ++k) {
        scene::ShapeCall swapped = actual;
        std::swap(swapped.arguments[k], swapped.arguments[k + 1]);
        if (swapped == expected)
            return explain("model.swapped-arguments",
                           exchanged(arguments[k], arguments[k + 1], actual.entry->name), values,
                           std::to_string(k));
    }
    std::vector<std::string> names;
    bool isLarge = false;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const double right = expected.arguments[k].value, value = actual.arguments[k].value;
        if (std::abs(right - value) <= 1e-6 * std::abs(right)) continue;
        names.push_back(lowerCase(arguments[k].name));
        isLarge = value > right;
    }
    const std::string& shape = actual.entry->name;
    const Message finding = names.size() != 1
                                ? causeMessage<"part.finding/arguments">(
                                      "arguments"_arg = listOf(names), "shape"_arg = shape)
                            : isLarge ? causeMessage<"part.finding/argument-large">(
                                            "argument"_arg = names.front(), "shape"_arg = shape)
                                      : causeMessage<"part.finding/argument-small">(
                                            "argument"_arg = names.front(), "shape"_arg = shape);
    explain("model.arguments", finding, values, joined(names, " "));
}

/// Explains normals, winding and texture coordinates of a mesh of the same form.
template <typename Explain>
void explainSurface(const Surface& surface, bool textured, const Explain& explain) {
    constexpr double kMinShare = 0.85;  // of the corners: seams and poles are their own
    const bool inward = surface.normalsOpposite > kMinShare,
               reversed = surface.windingReversed > kMinShare;
    if (inward && reversed)
        return explain("model.inside-out", causeMessage<"part.finding/inside-out">());
    if (reversed) return explain("model.winding", causeMessage<"part.finding/winding">());
    if (inward)
        return explain("model.normals-inward", causeMessage<"part.finding/normals-inward">());
    if (surface.normalsSame < kMinShare && surface.normalsUntransposed > kMinShare)
        return explain("model.normal-matrix", causeMessage<"part.finding/normal-matrix">());
    if (surface.normalsSame < kMinShare && surface.normalsOfFaces > kMinShare)
        return explain("model.flat-normals", causeMessage<"part.finding/flat">());
    if (surface.normalsSame < kMinShare)
        return explain("model.normals", causeMessage<"part.finding/normals">());
    if (!surface.hasUvs || !textured || surface.uvSame > kMinShare) return;
    if (surface.uvUpsideDown > kMinShare)
        return explain("texture.upside-down", causeMessage<"part.finding/uv-upside-down">());
    if (surface.uvMirrored > kMinShare)
        return explain("texture.mirrored", causeMessage<"part.finding/uv-mirrored">());
    if (surface.uvBoth > kMinShare)
        return explain("texture.turned", causeMessage<"part.finding/uv-turned">());
    if (surface.uvSwapped > kMinShare)
        return explain("texture.swapped-uv", causeMessage<"part.finding/uv-swapped">());
    explain("texture.coordinates", causeMessage<"part.finding/texture-coordinates">());
}

}  // namespace

MeshDresser::MeshDresser(const SearchContext& context, DressFixes& out)
    : context_(context), out_(out), poses_(posesOf(out.mine, context.timesS.front())) {}

/// Whether the item's transforms make up for the other size of its mesh.
bool MeshDresser::standsBy(int i, int j, const Likeness& form) const {
    const glm::dmat4& expected =
        context_.theirSide.poses.front()[static_cast<std::size_t>(theirs(i).node)];
    const glm::dmat4& world = poses_[static_cast<std::size_t>(mine(j).node)];
    return isSamePlace(expected, world * form.mineFromTheirs, boundsOf(*theirs(i).mesh),
                       symmetryOf(theirs(i)), context_.sceneSize);
}

void MeshDresser::compare(int i, int j) {
    const Outline::Item &a = theirs(i), &b = mine(j);
    if (a.model.twoSided != b.model.twoSided) {
        const bool right = a.model.twoSided;
        out_.add(i, j, "model.culling",
                 {right ? causeMessage<"part.finding/culled">()
                        : causeMessage<"part.finding/culled-not">(),
                  {}},
                 "", b.model.where,
                 [j, right](Outline& o) { itemAt(o, j).model.twoSided = right; });
    }
    if (b.isReversed)
        out_.add(i, j, "model.winding", {causeMessage<"part.finding/winding">(), {}}, "",
                 b.model.where, [j](Outline& o) { itemAt(o, j).isReversed = false; });
    if (b.lacksMesh)
        return out_.add(i, j, "model.file-missing",
                        {causeMessage<"part.finding/mesh-file">("file"_arg = b.model.file), {}},
                        b.model.file, b.model.where, [j, a](Outline& o) {
                            takeMesh(o, j, a, glm::dmat4(1.0));
                            itemAt(o, j).material = a.material;
                            itemAt(o, j).model.texture = modelOfReference(a).texture;
                        });
    const Likeness& form = context_.forms.compare(a, b);
    const bool textured =
        a.model.texture.has_value() && a.model.texture->mapping == scene::Mapping::mesh;
    const bool isMadeUpFor = form.mineFromTheirs == glm::dmat4(1.0) || standsBy(i, j, form);
    if (form.isOneForm() && form.surface.isSame(textured) && isMadeUpFor) {
        compareDivisions(i, j);
        return;
    }
    const glm::dmat4 way = form.isOneForm() && isMadeUpFor ? form.mineFromTheirs : glm::dmat4(1.0);
    const auto apply = [j, a, way](Outline& o) { takeMesh(o, j, a, way); };
    const auto explain = [&](const char* code, const Message& finding, const Message& values = {},
                             const std::string& kind = "") {
        out_.add(i, j, code, {finding, values}, kind, b.model.where, apply);
    };
    if (!form.isOneForm()) return explainShape(a, b, explain);
    if (!isMadeUpFor) {
        if (a.model.source.shape.entry != nullptr && b.model.source.shape.entry != nullptr)
            return explainShape(a, b, explain);
        return explain("model.arguments", causeMessage<"part.finding/mesh-size">());
    }
    explainSurface(form.surface, textured, explain);
}

/// The same surface, which a scene's own words divide in another way.
void MeshDresser::compareDivisions(int i, int j) {
    const Outline::Item &a = theirs(i), &b = mine(j);
    const scene::ShapeCall &expected = a.model.source.shape, &actual = b.model.source.shape;
    if (expected.entry == nullptr || expected.entry != actual.entry || expected == actual ||
        a.model.source.kind != b.model.source.kind)
        return;
    const std::vector<generator::Argument>& arguments = expected.entry->arguments;
    const auto apply = [j, a](Outline& o) { takeMesh(o, j, a, glm::dmat4(1.0)); };
    const Message values = twoValues(generator::textOf(actual), generator::textOf(expected));
    bool lengths = false, levels = false;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        const bool differs = std::abs(expected.arguments[k].value - actual.arguments[k].value) >
                             1e-6 * std::abs(expected.arguments[k].value);
        (arguments[k].isInteger() ? levels : lengths) |= differs;
    }
    if (lengths || !levels) return;  // made up for by a scale
    for (std::size_t k = 0; k + 1 < arguments.size(); ++k) {
        scene::ShapeCall swapped = actual;
        std::swap(swapped.arguments[k], swapped.arguments[k + 1]);
        if (swapped != expected) continue;
        out_.add(i, j, "model.swapped-arguments",
                 {exchanged(arguments[k], arguments[k + 1], actual.entry->name), values},
                 std::to_string(k), b.model.where, apply);
        return;
    }
    out_.add(i, j, "model.divisions",
             {causeMessage<"part.finding/divisions">("shape"_arg = actual.entry->name), values}, "",
             b.model.where, apply);
}

std::vector<Fix> otherDivisions(const SearchContext& context, const Outline& mine,
                                const Matching& matching) {
    std::vector<Fix> out;
    const Poses poses = posesOf(mine, context.timesS.front());
    for (std::size_t i = 0; i < matching.mineOf.size(); ++i) {
        const int j = matching.mineOf[i];
        if (j < 0) continue;
        const Outline::Item &a = context.theirs.items[i],
                            &b = mine.items[static_cast<std::size_t>(j)];
        const Likeness& form = context.forms.compare(a, b);
        const bool textured = a.model.texture.has_value();
        if (a.mesh->id == b.mesh->id || b.model.source.kind == scene::ModelSource::Kind::shape ||
            !form.isOneForm() || !form.surface.isSame(textured))
            continue;
        // A mesh of another size is a cause, unless a transform compensates it.
        if (form.mineFromTheirs != glm::dmat4(1.0) &&
            !isSamePlace(context.theirSide.poses.front()[static_cast<std::size_t>(a.node)],
                         poses[static_cast<std::size_t>(b.node)] * form.mineFromTheirs,
                         boundsOf(*a.mesh), symmetryOf(a), context.sceneSize))
            continue;
        Fix fix;
        fix.apply = [j, a, way = form.mineFromTheirs](Outline& o) {
            if (!itemAt(o, j).isReversed) takeMesh(o, j, a, way);
        };
        out.push_back(std::move(fix));
    }
    return out;
}

}  // namespace farol::grade
