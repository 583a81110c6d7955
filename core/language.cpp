#include "core/language.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/embedded.h"

namespace farol {

std::span<const EmbeddedFile> languageFiles();  ///< core/languages/*.json

namespace {

/// The templates of one language.
struct Translation {
    std::map<std::string, std::string, std::less<>> templates;
    std::vector<std::string_view> ids;
};

Translation readTranslation(Language language) {
    Translation translation;
    const std::string name = std::string(kLanguageWords[language]) + ".json";
    for (const EmbeddedFile& file : languageFiles())
        if (file.name == name)
            translation.templates =
                nlohmann::json::parse(file.bytes).get<decltype(translation.templates)>();
    for (const auto& [id, text] : translation.templates) translation.ids.push_back(id);
    return translation;
}

/// Reads each file once, when its language is first asked for.
const Translation& translationOf(Language language) {
    switch (language) {
        case Language::pt: {
            static const Translation pt = readTranslation(Language::pt);
            return pt;
        }
        case Language::es: {
            static const Translation es = readTranslation(Language::es);
            return es;
        }
        case Language::cs: {
            static const Translation cs = readTranslation(Language::cs);
            return cs;
        }
        case Language::en:
            break;
    }
    static const Translation english;
    return english;
}

std::string textIn(Language language, const std::string& id, const MessageArguments& arguments,
                   const std::string& english) {
    const auto text = templateOf(language, id);
    if (!text) return english;
    return renderTemplate(*text, arguments,
                          [language](std::string_view part) { return templateOf(language, part); });
}

}  // namespace

std::optional<std::string_view> templateOf(Language language, std::string_view id) {
    const auto& templates = translationOf(language).templates;
    const auto found = templates.find(id);
    if (found == templates.end()) return std::nullopt;
    return found->second;
}

std::string textIn(Language language, const Message& message) {
    return textIn(language, message.id, message.arguments, message.text);
}

std::string textIn(Language language, const Diagnostic& finding) {
    return textIn(language, finding.id, finding.arguments, finding.message);
}

Message messageOf(const Diagnostic& finding) {
    return {finding.id, finding.message, finding.arguments};
}

Diagnostics translated(Language language, Diagnostics findings) {
    for (Diagnostic& finding : findings) finding.message = textIn(language, finding);
    return findings;
}

std::span<const std::string_view> idsOf(Language language) { return translationOf(language).ids; }

}  // namespace farol
