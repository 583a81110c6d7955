// What is said of a shape's arguments: the argument by the name that the user meant, its range,
// what was written, and how the shape is written.
#include <catch2/catch.hpp>

#include "tests/unit/generator/checks.h"

using namespace checks;

namespace {

struct Row {
    const char *text, *code, *message;
};

const std::vector<Row> kRows = {
    {"box 2 0", "shape.argument",
     "the argument DIV of box must be a whole number from 1 to 100000, not \"0\"; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 2 1.5", "shape.argument",
     "the argument DIV of box must be a whole number from 1 to 100000, not \"1.5\"; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"cube 2 -3", "shape.argument",
     "the argument DIV of box must be a whole number from 1 to 100000, not \"-3\"; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 2 0 3", "shape.argument",
     "the argument Y of box must be a number from 1e-06 to 1000000000, not \"0\"; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box 1 2 3 0", "shape.argument",
     "the argument DIV of box must be a whole number from 1 to 100000, not \"0\"; usage: box X "
     "[DIV], or box X Y Z [DIV]"},
    {"box", "shape.argument",
     "the argument X of box is missing; usage: box X [DIV], or box X Y Z [DIV]"},
    {"plane 1,5", "shape.argument",
     "the argument SIZE of plane must be a number from 1e-06 to 1000000000, not \"1,5\" (write "
     "\"1.5\"); usage: plane SIZE [DIV]"},
    {"sphere 1 2 8", "shape.argument",
     "the argument SLICES of sphere must be a whole number from 3 to 100000, not \"2\"; usage: "
     "sphere RADIUS [SLICES] [STACKS]"},
    {"cone 1", "shape.argument",
     "the argument HEIGHT of cone is missing; usage: cone RADIUS HEIGHT [SLICES] [STACKS]"},
    {"cylinder 1 2 3 4 5", "shape.argument",
     "cylinder takes at most 4 numbers, not 5; usage: cylinder RADIUS HEIGHT [SLICES] [STACKS]"},
    {"torus 1 2 10 10", "shape.argument",
     "the argument TUBE of torus must be less than RING; usage: torus RING TUBE [SLICES] [SIDES]"},
    {"ring 2 1", "shape.argument",
     "the argument INNER of ring must be less than OUTER; usage: ring INNER OUTER [SLICES]"},
    {"patch teapot.patch 0", "shape.argument",
     "the argument LEVEL of patch must be a whole number from 1 to 100000, not \"0\"; usage: patch "
     "FILE [LEVEL]"},
    {"revolution", "shape.argument", "revolution needs a file; usage: revolution FILE [N]"},
    {"spher 1 8 8", "shape.unknown", "there is no shape \"spher\"; did you mean \"sphere\"?"},
    {"pyramid 1 2", "shape.unknown",
     "there is no shape \"pyramid\"; there are plane, box, sphere, cone, cylinder, torus, patch, "
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
