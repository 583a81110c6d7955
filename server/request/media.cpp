#include "server/request/media.h"

#include <charconv>
#include <string_view>

#include "core/text.h"
#include "server/messages.h"

namespace farol::server {
namespace {

using std::string_view;

// 3 for the type itself, 2 for its family, 1 for anything, 0 for no match.
int specificity(string_view range, string_view type) {
    if (range == type) return 3;
    if (range == "*/*" || range == "*") return 1;
    const string_view family = type.substr(0, type.find('/') + 1);
    return range.ends_with("/*") && range.substr(0, range.size() - 1) == family ? 2 : 0;
}

double qualityOf(string_view parameters) {
    while (!parameters.empty()) {
        const string_view one = trimmed(parameters.substr(0, parameters.find(';')), kLineBlanks);
        parameters.remove_prefix(std::min(parameters.size(), parameters.find(';')));
        if (!parameters.empty()) parameters.remove_prefix(1);
        if (!one.starts_with("q=") && !one.starts_with("Q=")) continue;
        double q = 1.0;
        std::from_chars(one.data() + 2, one.data() + one.size(), q);
        return q >= 0.0 && q <= 1.0 ? q : 1.0;
    }
    return 1.0;
}

}  // namespace

double acceptedQuality(const std::optional<std::string>& accept, const std::string& type) {
    if (!accept || trimmed(*accept, kLineBlanks).empty()) return 1.0;
    int best = 0;
    double quality = 0.0;
    string_view rest = *accept;
    while (!rest.empty()) {
        const string_view item = trimmed(rest.substr(0, rest.find(',')), kLineBlanks);
        rest.remove_prefix(std::min(rest.size(), rest.find(',')));
        if (!rest.empty()) rest.remove_prefix(1);
        const int match = specificity(trimmed(item.substr(0, item.find(';')), kLineBlanks), type);
        if (match <= best) continue;
        best = match;
        const std::size_t semicolon = item.find(';');
        quality = semicolon == string_view::npos ? 1.0 : qualityOf(item.substr(semicolon + 1));
    }
    return quality;
}

Language acceptedLanguage(const std::optional<std::string>& header) {
    Language best = Language::en;
    double quality = 0.0;
    const std::string text = header.value_or("");
    for (const string_view entry : split(text, ",")) {
        const string_view range = trimmed(entry.substr(0, entry.find(';')), kLineBlanks);
        const std::string word = lowerCase(range.substr(0, range.find('-')));
        const std::optional<Language> language =
            word == "*" ? Language::en : kLanguageWords.find(word);
        if (!language) continue;
        const std::size_t semicolon = entry.find(';');
        const double weight =
            semicolon == string_view::npos ? 1.0 : qualityOf(entry.substr(semicolon + 1));
        if (weight <= quality) continue;
        best = *language;
        quality = weight;
    }
    return best;
}

Language languageOf(const http::Request& request) {
    return acceptedLanguage(request.header("accept-language"));
}

void setLanguage(http::Response& response, Language language) {
    response.set("Content-Language", std::string(kLanguageWords[language]));
    response.set("Vary", "Accept-Language");
}

void chooseFormat(Parameters& wanted, const std::optional<std::string>& accept) {
    const image::Format asked = wanted.picture.format;
    double best = 0.0;
    for (std::size_t i = 0; i < image::kFormats.size(); ++i) {
        const image::Format format{static_cast<std::uint8_t>(i)};
        if (wanted.formatGiven && format != asked) continue;
        const double quality = acceptedQuality(accept, image::contentType(format));
        if (quality <= best) continue;
        best = quality;
        wanted.picture.format = format;
    }
    if (best <= 0.0)
        throw Error(message<"http.not-acceptable">(
            "known"_arg = uncut(image::listFormats(&image::FormatSpec::mime, ", ", " or "))));
}

}  // namespace farol::server
