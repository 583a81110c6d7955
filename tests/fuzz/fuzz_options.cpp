// Picture options, as the command line, a query and an upload's JSON give them.
#include <cmath>

#include "render/options.h"
#include "server/http/uri.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

void checkNumber(double value) { require(std::isfinite(value), "a number that is not finite"); }

void checkOptions(const render::PictureOptions& options) {
    for (const auto& side : {options.width, options.height})
        require(!side || (*side >= 1 && *side <= render::kMaxSide), "a side out of range");
    for (const auto& vector : {options.eye, options.target, options.up})
        for (int i = 0; vector && i < 3; ++i) checkNumber((*vector)[i]);
    for (const auto& number : {options.orbit.azimuthDeg, options.orbit.elevationDeg,
                               options.orbit.distance, options.fovDeg, options.near, options.far})
        if (number) checkNumber(*number);
    require(!options.fovDeg || (*options.fovDeg > 0 && *options.fovDeg < 180), "no field of view");
    checkNumber(options.timeS);
    require(options.errorPx.value_or(1.0) > 0, "an error that nothing can keep");
    require(options.budgetMs.value_or(1.0) > 0, "a budget that nothing can keep");
    require(options.quality >= 1 && options.quality <= 100, "a quality out of range");
    require(options.scale >= 0.1 && options.scale <= 1.0, "a scale out of range");
}

void applyLines(std::string_view text) {
    render::PictureOptions options;
    while (!text.empty()) {
        const std::string line(text.substr(0, text.find('\n')));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::size_t equals = line.find('=');
        const std::string name = line.substr(0, equals);
        try {
            render::applyOption(options, name,
                                equals == std::string::npos ? "" : line.substr(equals + 1));
            reached(name);
        } catch (const Error& error) {
            checkError(error);
            reached(name.substr(0, 12) + error.code());
            require(!error.primary().field.empty() || name.empty(), "an option without its name");
        }
        checkOptions(options);
    }
}

void applyRequest(const server::http::Fields& query, const std::string& json,
                  const std::string& accept) {
    server::ParameterRules rules;
    rules.picture = true;
    rules.ownNames = {"frames", "q"};
    try {
        server::Parameters parameters = server::readParameters(query, rules, json);
        checkOptions(parameters.picture);
        server::chooseFormat(parameters, accept);
        reached("request");
    } catch (const Error& error) {
        checkError(error);
    }
    const double quality = server::acceptedQuality(accept, "image/png");
    require(quality >= 0.0 && quality <= 1.0, "a quality out of range");
}

}  // namespace

const Target& target() {
    static const Target made = [] {
        Target out{{"txt"},
                   {"transparent", "#ff8800", "1,2,3", "{\"", "\":", "[1,2,3]", "null", "true",
                    "png", "webp", "jpeg", "q=0.5", "image/*", "*/*", "%00", "%zz", "+", "&", "="},
                   512};
        for (const render::OptionSpec& spec : render::optionSpecs())
            out.tokens.push_back(spec.name + "=");
        return out;
    }();
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol::fuzz;
    const std::string text(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    applyLines(text);
    const std::string first = text.substr(0, text.find('\n'));
    const auto parsed = farol::server::http::parseTarget(first);
    applyRequest(parsed ? parsed->query : farol::server::http::Fields{}, text, first);
    return 0;
}
