#include "server/store/scene_file.h"

#include "core/digest.h"
#include "core/number.h"
#include "scene/files/assets.h"

namespace farol::server::store {
namespace {

using std::string_view;

constexpr string_view kMagic = "farol-scene 1 ";
constexpr std::size_t kDigits = 32;

void append(std::string& out, string_view field) {
    out.append(std::to_string(field.size())).append(":").append(field);
}

/// Cuts one field off the front; nothing where there is none.
std::optional<string_view> take(string_view& rest) {
    const std::size_t colon = rest.find(':');
    if (colon == string_view::npos) return std::nullopt;
    const auto size = parseExact<std::size_t>(rest.substr(0, colon));
    rest.remove_prefix(colon + 1);
    if (!size || *size > rest.size()) return std::nullopt;
    const string_view field = rest.substr(0, *size);
    rest.remove_prefix(*size);
    return field;
}

std::int64_t secondsOf(Time time) {
    if (time == Time::max()) return 0;
    return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

Time timeOfSeconds(std::int64_t seconds) {
    return seconds == 0 ? Time::max() : Time(std::chrono::seconds(seconds));
}

}  // namespace

std::string encodeScene(const Stored& scene) {
    std::string body;
    body.reserve(scene.bundle->bytes() + 4096);
    append(body, scene.entry.listed ? "1" : "0");
    append(body, std::to_string(secondsOf(scene.entry.expires)));
    append(body, scene.bundle->main);
    for (const auto& [path, content] : scene.bundle->files) {
        append(body, path);
        append(body, content);
    }
    return std::string(kMagic) + contentDigest(body) + "\n" + body;
}

std::optional<Stored> decodeScene(string_view file) {
    constexpr std::size_t kHead = kMagic.size() + kDigits + 1;
    if (file.size() < kHead || !file.starts_with(kMagic) || file[kHead - 1] != '\n')
        return std::nullopt;
    string_view rest = file.substr(kHead);
    if (contentDigest(rest) != file.substr(kMagic.size(), kDigits)) return std::nullopt;
    const auto listed = take(rest), expires = take(rest), main = take(rest);
    if (!listed || !expires || !main) return std::nullopt;
    const auto seconds = parseExact<std::int64_t>(*expires);
    constexpr std::int64_t kLatest = 9'000'000'000;  // limit of the clock's nanoseconds
    if (!seconds || *seconds < 0 || *seconds > kLatest) return std::nullopt;
    auto bundle = std::make_shared<scene::Bundle>();
    bundle->main = *main;
    while (!rest.empty()) {
        const auto path = take(rest), content = take(rest);
        if (!path || !content || !scene::isSafePath(std::string(*path))) return std::nullopt;
        bundle->files.emplace(*path, *content);
    }
    if (bundle->files.count(bundle->main) == 0) return std::nullopt;
    Stored scene;
    scene.entry = {idOf(*bundle), *listed == "1", timeOfSeconds(*seconds), file.size()};
    scene.bundle = std::move(bundle);
    return scene;
}

}  // namespace farol::server::store
