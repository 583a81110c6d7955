#pragma once

#include <string>
#include <vector>

#include "generator/entry.h"

namespace farol::generator {

/// Parses words such as {"cone", "1", "2", "4", "3"}; level arguments may be left out, or be
/// "auto". Throws Error shape.unknown or shape.argument: the message names the argument and its
/// range. With `notes`, arguments that are too many are left out and lengths in the other known
/// order exchanged (ShapeEntry::isExchanged), each with a note; without, they are errors.
ShapeCall parseCall(const std::vector<std::string>& words, std::vector<Message>* notes = nullptr);

/// Returns the text of a call, "cone 1 2 auto 3": parseCall of its words (splitWords) gives the
/// same call. A file name of several words is in quotes, which splitWords does not
/// join again; still no two calls have the same text.
std::string textOf(const ShapeCall& call);

/// True for a finite number as scenes write it: "000", ".5", "+1", "1e3", "2.5f".
bool parseNumber(const std::string& word, double& value);

}  // namespace farol::generator
