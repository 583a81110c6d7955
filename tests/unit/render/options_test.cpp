#include "render/options.h"

#include <catch2/catch.hpp>

using namespace farol;
using render::PictureOptions;

TEST_CASE("every option takes its values and refuses the rest by name and range") {
    struct Case {
        const char* name;
        const char* value;
        bool good;
    };
    const Case one = GENERATE(values<Case>({
        {"width", "1", true},
        {"width", "4096", true},
        {"width", "0", false},
        {"width", "4097", false},
        {"width", "100000", false},
        {"width", "12px", false},
        {"width", "", false},
        {"width", "-3", false},
        {"width", "1.5", false},
        {"height", "512", true},
        {"height", "99999999999", false},
        {"eye", "1,2,3", true},
        {"eye", "-1.5, .5,1e3", true},
        {"eye", "1,2", false},
        {"eye", "1,2,3,4", false},
        {"eye", "1,2,nan", false},
        {"eye", "inf,0,0", false},
        {"eye", ",,", false},
        {"eye", "1e13,0,0", false},
        {"azimuth", "-30", true},
        {"azimuth", "+30", true},
        {"elevation", "91", false},
        {"elevation", "-90", true},
        {"distance", "0", false},
        {"fov", "0", false},
        {"fov", "60", true},
        {"fov", "180", false},
        {"near", "-1", false},
        {"time", "12.5", true},
        {"time", "nan", false},
        {"shading", "phong", true},
        {"shading", "Phong", false},
        {"shading", "toon", false},
        {"aa", "3", false},
        {"aa", "16", true},
        {"aa", "32", false},
        {"filter", "linear", true},
        {"filter", "cubic", false},
        {"budget_ms", "16.7", true},
        {"budget_ms", "0", false},
        {"budget_ms", "60001", false},
        {"axes", "1", true},
        {"axes", "yes", false},
        {"background", "#ff0000", true},
        {"background", "", false},
        {"format", "webp", true},
        {"format", "gif", false},
        {"quality", "0", false},
        {"quality", "100", true},
        {"layer", "id", true},
        {"viewer", "local", true},
        {"viewer", "near", false},
        {"scale", "0.05", false},
        {"scale", "0.5", true},
        {"error", "0.25", true},
        {"error", "0", false},
    }));
    CAPTURE(one.name, one.value);
    PictureOptions options;
    if (one.good) {
        CHECK_NOTHROW(render::applyOption(options, one.name, one.value));
        return;
    }
    try {
        render::applyOption(options, one.name, one.value);
        FAIL("was accepted");
    } catch (const Error& error) {
        CHECK(error.code() == "option.range");
        CHECK(error.primary().field == one.name);
        CHECK(std::string(error.what()).find(one.name) != std::string::npos);
        CHECK(std::string(error.what()).find("; expected ") != std::string::npos);
    }
}

TEST_CASE("messages quote a bounded part of a value") {
    PictureOptions options;
    try {
        render::applyOption(options, "target", std::string(100'000, 'x'));
        FAIL("was accepted");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() < 200);
    }
}

TEST_CASE("an unknown option is named, with the nearest known one") {
    PictureOptions options;
    try {
        render::applyOption(options, "widht", "5");
        FAIL("was accepted");
    } catch (const Error& error) {
        CHECK(error.code() == "option.unknown");
        CHECK(std::string(error.what()).find("\"width\"") != std::string::npos);
    }
}
