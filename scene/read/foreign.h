#pragma once

#include <optional>
#include <pugixml.hpp>

#include "core/message.h"
#include "scene/repair/document.h"

/// Tells XML of other programs from scenes.
namespace farol::scene {

/// Returns the message for a root element that another language is known by, else nothing.
std::optional<Message> foreignRoot(pugi::xml_node root);

/// Returns the message for a <scene> or <world> that holds nothing that can be drawn and has
/// elements of another program, else nothing. `isWhole`: the document is well-formed, so that
/// elements that nobody knows are no scraps.
std::optional<Message> foreignContent(pugi::xml_node root, bool isWhole);

}  // namespace farol::scene
