#pragma once

#include <string>

namespace farol::scene {

/// The tables of the language as an XML schema (api/scene.xsd): all spellings in all dialects that
/// need no repair.
std::string xmlSchema();

}  // namespace farol::scene
