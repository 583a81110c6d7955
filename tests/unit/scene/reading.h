#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "scene/files/assets.h"
#include "scene/read/reader.h"

/// Shared by the tests of the reader: one call, either outcome.
namespace farol::scene::test {

struct Outcome {
    std::optional<Scene> scene;  ///< empty when refused
    Diagnostics diagnostics;

    const Diagnostic* find(const std::string& code) const {
        const auto found =
            std::find_if(diagnostics.begin(), diagnostics.end(),
                         [&code](const Diagnostic& one) { return one.code == code; });
        return found == diagnostics.end() ? nullptr : &*found;
    }
    std::string text() const {
        std::string all = scene ? "read\n" : "refused\n";
        for (const Diagnostic& one : diagnostics)
            all += one.code + " " + std::to_string(one.where.line) + ":" +
                   std::to_string(one.where.column) + " " + one.message + "\n";
        return all;
    }
};

inline Outcome tryRead(const std::string& xml, const ReadOptions& options = {},
                       std::map<std::string, std::string> files = {}) {
    const BundleAssets assets(std::move(files));
    Outcome outcome;
    try {
        ReadResult result = read(xml, options, assets);
        outcome.scene = std::move(result.scene);
        outcome.diagnostics = std::move(result.diagnostics);
    } catch (const Error& error) {
        outcome.diagnostics = error.diagnostics();
    }
    return outcome;
}

inline std::string world(const std::string& body) { return "<world>" + body + "</world>"; }
inline std::string group(const std::string& body) {
    return "<world><group>" + body + "</group></world>";
}
inline std::string transform(const std::string& body) {
    return "<world><group><transform>" + body + "</transform></group></world>";
}
inline std::string model(const std::string& inside) {
    return "<world><group><models><model file=\"a.3d\">" + inside +
           "</model></models></group></world>";
}
inline std::string light(const std::string& attributes) {
    return "<world><lights><light " + attributes + "/></lights></world>";
}
inline std::string camera(const std::string& inside) {
    return "<world><camera>" + inside + "</camera></world>";
}
inline std::string scene2017(const std::string& body) { return "<scene>" + body + "</scene>"; }
inline std::string scene2020(const std::string& body) {
    return "<scene><colors><color name=\"c\" r=\"0.5\" g=\"0.25\" b=\"1\" a=\"1\"/></colors>" +
           body + "</scene>";
}

}  // namespace farol::scene::test
