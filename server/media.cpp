#include "server/media.h"

#include <charconv>
#include <string_view>

#include "server/http/text.h"

namespace farol::server {
namespace {

using http::trim;
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
        const string_view one = trim(parameters.substr(0, parameters.find(';')));
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
    if (!accept || trim(*accept).empty()) return 1.0;
    int best = 0;
    double quality = 0.0;
    string_view rest = *accept;
    while (!rest.empty()) {
        const string_view item = trim(rest.substr(0, rest.find(',')));
        rest.remove_prefix(std::min(rest.size(), rest.find(',')));
        if (!rest.empty()) rest.remove_prefix(1);
        const int match = specificity(trim(item.substr(0, item.find(';'))), type);
        if (match <= best) continue;
        best = match;
        const std::size_t semicolon = item.find(';');
        quality = semicolon == string_view::npos ? 1.0 : qualityOf(item.substr(semicolon + 1));
    }
    return quality;
}

void chooseFormat(Parameters& wanted, const std::optional<std::string>& accept) {
    struct Choice {
        render::Format format;
        const char* type;
    };
    static constexpr Choice kChoices[] = {{render::Format::png, "image/png"},
                                          {render::Format::jpeg, "image/jpeg"},
                                          {render::Format::webp, "image/webp"}};
    double best = 0.0;
    for (const Choice& choice : kChoices) {
        if (wanted.formatGiven && choice.format != wanted.picture.format) continue;
        const double quality = acceptedQuality(accept, choice.type);
        if (quality <= best) continue;
        best = quality;
        wanted.picture.format = choice.format;
    }
    if (best <= 0.0)
        throw Error("http.not-acceptable",
                    "The picture can be image/png, image/jpeg or image/webp, and the Accept "
                    "header takes none of what was asked for.");
}

}  // namespace farol::server
