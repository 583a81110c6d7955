#include "core/message.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "core/messages.h"
#include "core/number.h"

using namespace farol;

namespace {

constexpr MessageRow kRows[] = {
    {"scene.thing", "no <{name}>[; did you mean \"{suggestion}\"?]", {"cone", "cube"}},
    {"scene.thing/number", "\"{value}\" {problem}[ (line {line})]", {"1,5", "is no number", "3"}},
    {"scene.plain", "nothing to draw"},
};

template <FixedString kId, FixedString... kNames>
Message row(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kRows, kCoreMessages>(arguments...);
}

}  // namespace

TEST_CASE("a message fills its placeholders and leaves out parts without a value") {
    const Message both = row<"scene.thing">("suggestion"_arg = "torus", "name"_arg = "tours");
    CHECK(both.text == "no <tours>; did you mean \"torus\"?");
    CHECK(both.code() == "scene.thing");
    CHECK(row<"scene.thing">("name"_arg = "x", "suggestion"_arg = "").text == "no <x>");
    CHECK(row<"scene.plain">().text == "nothing to draw");
}

TEST_CASE("values are bounded, and braces in them are text") {
    const std::string longText(5000, 'a');
    const auto text = [](const auto& value) {
        return row<"scene.thing">("name"_arg = value, "suggestion"_arg = "").text;
    };
    CHECK(text(longText) == "no <" + std::string(60, 'a') + "...>");
    CHECK(text(uncut(longText)) == "no <" + std::string(kMaxArgumentBytes, 'a') + "...>");
    CHECK(text("{suggestion}[]\n") == "no <{suggestion}[] >");
    CHECK(text(12) == "no <12>");
    CHECK(text(0.25) == "no <0.25>");
}

TEST_CASE("an argument may be a message, which is rendered in the other language too") {
    const Message comma = parseNumber("1,5").problem;
    const Message message =
        row<"scene.thing/number">("value"_arg = "1,5", "problem"_arg = comma, "line"_arg = 7);
    CHECK(message.text == "\"1,5\" has a decimal comma; write \"1.5\" (line 7)");
    CHECK(message.code() == "scene.thing");
    const Diagnostic found = diagnosticOf(Severity::error, message);
    CHECK(found.id == "scene.thing/number");
    const FindTemplate portuguese = [](std::string_view id) -> std::optional<std::string_view> {
        if (id == "part.number-comma") return "tem uma virgula; escreva \"{suggestion}\"";
        return std::nullopt;
    };
    CHECK(renderTemplate("[linha {line}: ]{value} {problem}", found.arguments, portuguese) ==
          "linha 7: 1,5 tem uma virgula; escreva \"1.5\"");
    // Without the inner template its English text stands.
    CHECK(renderTemplate("{problem}", found.arguments) == "has a decimal comma; write \"1.5\"");
}

TEST_CASE("templates that are wrong render without a fault") {
    CHECK(renderTemplate("{missing} a", {}) == " a");
    CHECK(renderTemplate("a {open", {}) == "a ");
    CHECK(renderTemplate("a [open", {}).starts_with("a "));
    CHECK(renderTemplate("]}a", {}) == "]}a");
    CHECK(renderTemplate("[]", {}).empty());
    MessageArguments cycle(1);
    cycle[0].name = "x";
    cycle[0].id = "part.x";
    CHECK(renderTemplate("{x}", cycle, [](std::string_view) { return "{x}"; }).empty());
}

TEST_CASE("an error of a message has its code and arguments") {
    const Error error(row<"scene.thing">("name"_arg = "a", "suggestion"_arg = "b"), {"f", 2, 3});
    CHECK(error.code() == "scene.thing");
    CHECK(error.primary().id == "scene.thing");
    CHECK(error.primary().arguments.size() == 2);
    CHECK(error.primary().where == Location{"f", 2, 3});
    CHECK(error.what() == std::string("no <a>; did you mean \"b\"?"));
}

TEST_CASE("samples belong to the placeholders in their order") {
    const MessageArguments samples = sampleArguments(kRows[1]);
    REQUIRE(samples.size() == 3);
    CHECK(samples[2].name == "line");
    CHECK(renderTemplate(kRows[1].text, samples) == "\"1,5\" is no number (line 3)");
}
