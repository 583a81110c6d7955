#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grade/requirements/facts.h"
#include "grade/requirements/inventory.h"
#include "grade/requirements/motion.h"
#include "grade/requirements/requirement.h"
#include "grade/requirements/solids.h"

namespace farol::grade {

/// Why an object does not match, and where its document says so.
struct Fault {
    Message reason;
    Location where;
};

/// An object that fails one condition alone.
struct NearMiss {
    std::size_t object;
    Fault fault;
    bool isOfKind;  ///< false: it has another shape or name, and may not be meant at all
};

struct Selection {
    std::vector<std::size_t> matches;  ///< in document order
    std::vector<NearMiss> near;
};

/// All that conditions are evaluated on.
struct SceneOfRequirements {
    const Inventory& inventory;
    Motion& motion;
    Solids& solids;
    SeenFacts& seen;
};

/// Finds the objects that a selector describes.
class ObjectSelector {
  public:
    explicit ObjectSelector(SceneOfRequirements scene) : scene_(scene) {}

    /// Gives an id to the objects of a selection.
    void define(const std::string& id, std::vector<std::size_t> objects);
    /// Returns the objects of an id; none where it is unknown.
    const std::vector<std::size_t>& objectsOf(const std::string& id) const;
    /// `among`: an id; empty: all objects.
    Selection select(const Selector& selector, const std::string& among);
    /// Returns the first way of the object round one of those objects.
    std::optional<Orbit> orbitAbout(std::size_t object, const std::string& id);

    /// The condition's fault of an object, or nothing where it holds.
    using Check = std::optional<Fault> (*)(ObjectSelector&, const Selector&, std::size_t);

    SceneOfRequirements& scene() { return scene_; }

  private:
    SceneOfRequirements scene_;
    std::map<std::string, std::vector<std::size_t>> defined_;
};

/// Whether a name is like a pattern: * stands for any characters, ? for one; any case.
bool isLike(std::string_view name, std::string_view pattern);

}  // namespace farol::grade
