// Messages about a shape's arguments: the argument by the name that the user meant, the value, the
// range, and the usage of the shape.
#include <catch2/catch.hpp>

#include "tests/unit/generator/checks.h"

using namespace checks;

namespace {

struct Row {
    const char *text, *code, *message;
};

const std::vector<Row> kRows = {
    {"box 2 0", "shape.argument",
     "the argument DIV of box is \"0\"; expected a whole number in 1 to 100000; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 2 1.5", "shape.argument",
     "the argument DIV of box is \"1.5\"; expected a whole number in 1 to 100000; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"cube 2 -3", "shape.argument",
     "the argument DIV of box is \"-3\"; expected a whole number in 1 to 100000; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 2 0 3", "shape.argument",
     "the argument Y of box is \"0\"; expected a number in 1e-06 to 1000000000; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 1 2 3 0", "shape.argument",
     "the argument DIV of box is \"0\"; expected a whole number in 1 to 100000; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box", "shape.argument",
     "the argument X of box is missing; usage: box X [DIV], or box X Y Z [DIV]"},
    {"plane 1,5", "shape.argument",
     "the argument SIZE of plane is \"1,5\"; expected a number in 1e-06 to 1000000000 (write "
     "\"1.5\"); usage: plane SIZE [DIV]"},
    {"sphere 1 2 8", "shape.argument",
     "the argument SLICES of sphere is \"2\"; expected a whole number in 3 to 100000; usage: "
     "sphere RADIUS [SLICES] [STACKS]"},
    {"cone 1", "shape.argument",
     "the argument HEIGHT of cone is missing; usage: cone RADIUS HEIGHT [SLICES] [STACKS]"},
    {"cylinder 1 2 3 4 5", "shape.argument",
     "cylinder has 5 numbers; expected at most 4; usage: cylinder RADIUS HEIGHT [SLICES] [STACKS]"},
    {"torus 1 2 10 10", "shape.argument",
     "the argument TUBE of torus is 2; expected less than RING, 1; usage: torus RING TUBE [SLICES] "
     "[SIDES]"},
    {"ring 2 1", "shape.argument",
     "the argument INNER of ring is 2; expected less than OUTER, 1; usage: ring INNER OUTER "
     "[SLICES]"},
    {"patch teapot.patch 0", "shape.argument",
     "the argument LEVEL of patch is \"0\"; expected a whole number in 1 to 100000; usage: patch "
     "FILE [LEVEL]"},
    {"revolution", "shape.argument", "revolution has no file; usage: revolution FILE [N]"},
    {"spher 1 8 8", "shape.unknown", "there is no shape \"spher\"; did you mean \"sphere\"?"},
    {"pyramid 1 2", "shape.unknown",
     "there is no shape \"pyramid\"; expected plane, box, sphere, cone, cylinder, torus, patch, "
     "ring, ellipsoid, frustum, revolution, wedge, dome"},
};

}  // namespace

TEST_CASE("a shape's bad arguments are named as they were meant, with their range and the usage") {
    for (const Row& row : kRows) {
        CAPTURE(row.text);
        try {
            make(row.text);
            FAIL_CHECK("it was accepted");
        } catch (const farol::Error& error) {
            CHECK(error.code() == row.code);
            CHECK(std::string(error.what()) == row.message);
        }
    }
}

TEST_CASE("a second and last number of a box is its divisions, and auto is none") {
    CHECK(make("box 2 3") == make("box 2 2 2 3"));
    CHECK_THROWS(make("box 2 auto"));
}
