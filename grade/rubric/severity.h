#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/enum_words.h"
#include "core/language.h"

namespace farol::grade {

/// The topics of causes: criteria of rubrics.
enum class Topic { models, transforms, textures, materials, lights, camera, animation };
inline constexpr EnumWords<Topic, Topic::animation> kTopicWords{
    "models", "transforms", "textures", "materials", "lights", "camera", "animation"};

/// A kind of mistake. A cause costs `least` if it affects hardly any of the work and `most` if it
/// affects all, in hundredths of a submission's points; an invisible cause costs nothing.
struct Kind {
    std::string_view code;
    Topic topic;
    double least, most;
};

/// Returns the description of a kind of mistake; the code itself if it has none.
std::string aboutKind(const std::string& code, Language language = Language::en);

/// The table of all kinds, by topic. It was written before any submission was marked by it: a slip
/// that one look at the picture finds costs less than a misunderstanding of how transforms compose;
/// a change of the whole image costs about a quarter of the points, never more than a third.
std::span<const Kind> kinds();

/// The row of a code. Precondition: it is in the table.
const Kind& kindOf(const std::string& code);

/// The table of docs/grading.md.
std::string kindsMarkdown();

/// Returns the cost of a cause, in hundredths: between its kind's least and most by the root of the
/// share of weighted work that it spoils, 0..1, so that a mistake in a small part still counts;
/// once and a half where the same slip stands at several places.
double costOf(const Kind& kind, double spoiled, std::size_t places);

}  // namespace farol::grade
