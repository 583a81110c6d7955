#pragma once

#include <memory>
#include <string>

#include "core/lru_cache.h"
#include "render/renderer.h"
#include "scene/scene.h"

namespace farol::render {

/// A job read and resolved: every file it names is known to be there.
struct Prepared {
    scene::Scene scene;
    Diagnostics diagnostics;  ///< info and warnings; with missing=placeholder also errors
    std::shared_ptr<const scene::Assets> assets;
    bool animated = false;  ///< something depends on the time
};

/// Reads the document (or, by the ending of the name, a mesh file on its own) and resolves its
/// files. Throws Error with all findings when one is an error, or in strict a warning; with
/// missing=placeholder only where the document itself cannot be read.
Prepared prepare(const Job& job);

/// LRU cache of prepared scenes, by Job::identity and the options that affect reading. Jobs
/// without an identity are not cached.
class PreparedCache {
  public:
    explicit PreparedCache(std::size_t most) : kept_(most) {}
    /// Throws as prepare does; failures are not cached.
    std::shared_ptr<const Prepared> get(const Job& job);

  private:
    LruCache<std::string, std::shared_ptr<const Prepared>> kept_;
};

/// Makes errors of warnings where the job is strict. Throws Error with all of `diagnostics` where
/// one is an error and the job does not ask for placeholders.
void refuseErrors(Diagnostics& diagnostics, const Job& job);

}  // namespace farol::render
