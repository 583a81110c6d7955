#include "scene/repair/document.h"

#include "scene/messages.h"
#include "scene/read/tables.h"

namespace farol::scene {

Document::Document(std::string_view source, const std::string& name, const ReadLimits& limits,
                   Findings& findings)
    : lines_(source, name), repaired_(repair(source, lines_, limits, findings)) {
    buffer_ = std::move(repaired_.text);
    const pugi::xml_parse_result result = parsed_.load_buffer_inplace(
        buffer_.data(), buffer_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result && !findings.failed())
        findings.error(message<"xml.syntax">("problem"_arg = result.description()),
                       lines_.at(repaired_.origin(static_cast<std::size_t>(result.offset))));
}

pugi::xml_node Document::root() const {
    for (const pugi::xml_node child : parsed_.children())
        if (child.type() == pugi::node_element && isSceneRoot(child.name())) return child;
    return parsed_.document_element();
}

Location Document::at(pugi::xml_node element) const {
    const std::size_t name = origin(element.name());
    return lines_.at(name > 0 ? name - 1 : 0);
}

Location Document::at(pugi::xml_attribute attribute) const {
    return lines_.at(origin(attribute.name()));
}

Location Document::atValue(pugi::xml_attribute attribute) const {
    // An empty value may be a constant of the parser's, outside the buffer.
    if (attribute.value()[0] == '\0') return at(attribute);
    return lines_.at(origin(attribute.value()));
}

std::size_t Document::origin(const char* place) const {
    return repaired_.origin(static_cast<std::size_t>(place - buffer_.data()));
}

}  // namespace farol::scene
