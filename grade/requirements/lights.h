#pragma once

#include <string>
#include <vector>

#include "grade/requirements/select.h"

namespace farol::grade {

/// A light as a requirement sees it; `reason` says why it does not match, or is empty.
struct FoundLight {
    Message who;
    Location where;
    Message reason;
};

/// Returns the scene's lights, each copy, in document order.
std::vector<FoundLight> findLights(const LightSelector& selector, ObjectSelector& objects);

}  // namespace farol::grade
