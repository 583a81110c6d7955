#include "grade/structure/fix.h"

#include "core/text.h"
#include "generator/entry.h"
#include "grade/structure/messages.h"

namespace farol::grade {
namespace {

Message groupBy(const Outline& outline, int node, bool withLine) {
    if (node <= 0) return causeMessage<"part.who/scene">();
    const Outline::Node& one = outline.nodes[static_cast<std::size_t>(node)];
    if (!one.name.empty()) return causeMessage<"part.who/group">("name"_arg = one.name);
    return causeMessage<"part.who/group-number">(
        "number"_arg = one.number,
        "line"_arg = withLine && one.where.line > 0 ? std::to_string(one.where.line) : "");
}

}  // namespace

std::string meshNameOf(const scene::Model& model) {
    if (model.source.kind == scene::ModelSource::Kind::shape && model.source.shape.entry != nullptr)
        return model.source.shape.entry->name;
    return shown(model.file.empty() ? model.command : model.file);
}

Message nameOfNode(const Outline& outline, int node) { return groupBy(outline, node, true); }

Message nameOfNodeAlone(const Outline& outline, int node) { return groupBy(outline, node, false); }

Message nameOfItem(const Outline& outline, int item) {
    const Outline::Item& one = outline.items[static_cast<std::size_t>(item)];
    const std::string given = !one.model.name.empty() ? one.model.name : one.model.id;
    if (!given.empty()) return causeMessage<"part.who/model">("name"_arg = given);
    const Outline::Node& group = outline.nodes[static_cast<std::size_t>(one.node)];
    if (group.name.empty())
        return causeMessage<"part.who/model-number">("number"_arg = one.number,
                                                     "mesh"_arg = meshNameOf(one.model));
    int count = 0;
    for (const Outline::Item& other : outline.items)
        count += other.node == one.node && !other.isGone ? 1 : 0;
    if (count == 1) return causeMessage<"part.who/model">("name"_arg = group.name);
    return causeMessage<"part.who/model-of">("mesh"_arg = meshNameOf(one.model),
                                             "group"_arg = group.name);
}

}  // namespace farol::grade
