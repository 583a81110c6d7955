#pragma once

#include <string>

namespace farol::grade {

/// Returns a line of a document and its neighbours, with their numbers: "4   <group>\n5 > ...".
std::string excerptOf(const std::string& xml, int line);

}  // namespace farol::grade
