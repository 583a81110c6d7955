#pragma once

#include <optional>
#include <pugixml.hpp>

#include "core/message.h"
#include "scene/repair/document.h"

/// Detects XML of other programs.
namespace farol::scene {

/// Returns the message for a root element of another known language, else nothing.
std::optional<Message> foreignRoot(pugi::xml_node root);

/// Returns the message for a <scene> or <world> that holds nothing that can be drawn and has
/// elements of another program, else nothing. `isWhole`: the document is well-formed, so that its
/// unknown elements are not parts of a broken scene.
std::optional<Message> foreignContent(pugi::xml_node root, bool isWhole);

}  // namespace farol::scene
