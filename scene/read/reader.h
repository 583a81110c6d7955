#pragma once

#include <string>
#include <string_view>

#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::scene {

/// Bounds on a document, checked before memory is allocated for its content.
struct ReadLimits {
    std::size_t bytes = 1 << 20;
    int depth = 64;
    int elements = 50'000;
    int diagnostics = 50;
};

struct ReadOptions {
    std::string name = "scene.xml";  ///< for locations
    bool strict = false;             ///< warnings become errors
    /// Leaves out unreadable elements: errors stay in ReadResult::diagnostics. An element that is
    /// not closed ends where its parent ends.
    bool leaveOut = false;
    ReadLimits limits;
    std::string path = {};  ///< of the document among its assets; empty: at their top
};

struct ReadResult {
    Scene scene;
    Diagnostics diagnostics;  ///< info and warnings; with leaveOut also errors; document order
};

/// Reads a scene of any dialect, repairing common faults of real files (docs/scene-language.md).
/// `assets` serves includes and entities only. Throws Error with all diagnostics found (xml.*
/// errors first, then in document order) when the document is not readable XML (xml.*), is not a
/// scene (scene.*) or is over a limit (limit.*), or an included file is missing (asset.*).
ReadResult read(std::string_view xml, const ReadOptions& options, const Assets& assets);

}  // namespace farol::scene
