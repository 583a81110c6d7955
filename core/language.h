#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/enum_words.h"
#include "core/error.h"

/// Messages in other languages than English. core/languages/LANGUAGE.json maps the ids of the
/// catalogue (core/message.h) to templates with the same arguments. A message without a translation
/// stays English.
namespace farol {

enum class Language { en, pt, es, cs };
/// ISO 639-1 codes: as in --lang, Accept-Language and the name of the file.
inline constexpr EnumWords<Language, Language::cs> kLanguageWords{"en", "pt", "es", "cs"};

/// Returns the template of an id. Nothing for English, whose templates are in the tables, and for
/// an id that has no translation.
std::optional<std::string_view> templateOf(Language language, std::string_view id);

/// Returns the message's text in the language.
std::string textIn(Language language, const Message& message);
std::string textIn(Language language, const Diagnostic& finding);

/// The finding's message without its place.
Message messageOf(const Diagnostic& finding);

/// Returns the diagnostics with their texts in the language; all else stays.
Diagnostics translated(Language language, Diagnostics findings);

/// The ids that the language has a template for, sorted; none for English.
std::span<const std::string_view> idsOf(Language language);

}  // namespace farol
