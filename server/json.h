#pragma once

#include <nlohmann/json.hpp>

#include "core/language.h"
#include "render/renderer.h"
#include "server/scenes.h"

/// The service's documents (api/openapi.yaml has their schemas).
namespace farol::server {

nlohmann::json toJson(const scene::Camera& camera);
nlohmann::json toJson(const render::Stats& stats);
nlohmann::json toJson(const render::Quality& quality);
/// Title, size, camera, counts, diagnostics.
nlohmann::json toJson(const render::SceneReport& report, Language language = Language::en);
/// {"models": the elements with their places, "copies": the model of each number of a layer=id
/// picture, the first for number 1}
nlohmann::json modelsOf(const render::SceneReport& report);
/// Paths of a served scene's resources, behind the service's base path.
nlohmann::json linksOf(const ServedScene& scene, const std::string& basePath);

/// ASCII, for headers; invalid bytes become U+FFFD.
std::string asciiJson(const nlohmann::json& value);
/// Returns the value of X-Farol-Diagnostics, cut to the size of a header.
std::string diagnosticsHeader(const Diagnostics& diagnostics);

/// The document of a scene, in the gallery and at its address.
nlohmann::json describe(const ServedScene& scene, const render::SceneReport& report,
                        const Diagnostics& errors, const std::string& basePath, Language language);

}  // namespace farol::server
