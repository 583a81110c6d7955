// Test cases that are skipped on purpose; tests/structure/skip_test.cpp runs them.
#include <catch2/catch.hpp>

#include "tests/support/skip.h"

TEST_CASE("without data") {
    farol::test::skip("no data");
    FAIL("reached");
}

TEST_CASE("without a tool") { farol::test::skipMissing("no tool"); }

TEST_CASE("fails before it is skipped") {
    CHECK(false);
    farol::test::skip("no data");
}

TEST_CASE("runs") { CHECK(true); }
