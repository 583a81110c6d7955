#include <catch2/catch.hpp>

#include "core/base64.h"
#include "core/code_status.h"
#include "core/did_you_mean.h"
#include "core/digest.h"
#include "core/number.h"
#include "core/text.h"

using namespace farol;

TEST_CASE("base64 gives the examples of RFC 4648") {
    CHECK(base64("").empty());
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foob") == "Zm9vYg==");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64("\xFF\xFE\xFB") == "//77");
}

// By Python's hashlib.blake2b(..., digest_size=16).
TEST_CASE("contents are named by their BLAKE2b") {
    CHECK(contentDigest("") == "cae66941d9efbd404e4d88758ea67670");
    CHECK(contentDigest("abc") == "cf4ab791c62b8d2b2109c90275287816");
    CHECK(contentDigest(std::string(129, 'a')) == "68b7bafbad5055c4ebe6eb170a0f8524");
}

TEST_CASE("a likely word is proposed, an unlikely one is not") {
    const std::vector<std::string> shapes = {"torus", "teapot", "Cylinder", "box"};
    CHECK(didYouMean("trous", shapes) == "torus");  // neighbours swapped: one edit
    CHECK(didYouMean("TORU", shapes) == "torus");
    CHECK(didYouMean("cilindre", shapes) == "Cylinder");  // two edits
    CHECK(didYouMean("cilandre", shapes).empty());        // three, two are allowed
    CHECK(didYouMean("cilinder", shapes) == "Cylinder");
    CHECK(didYouMean("bx", shapes) == "box");
    CHECK(didYouMean("b", shapes).empty());
    CHECK(didYouMean("", shapes).empty());
    CHECK(didYouMean(std::string(65, 'a'), {std::string(64, 'a')}).empty());
    CHECK(didYouMean("torus", {std::string(65, 'a'), "torvs"}) == "torvs");
    std::vector<std::string> many(2'000, "unlike");
    many.emplace_back("torus");
    CHECK(didYouMean("torvs", many).empty());  // too far down the list
}

TEST_CASE("a code's family decides its status") {
    CHECK(statusOf("option.range") == 400);
    CHECK(statusOf("xml.unclosed") == 400);
    CHECK(statusOf("http.method") == 405);
    CHECK(statusOf("limit.body") == 413);
    CHECK(statusOf("busy.queue") == 503);
    CHECK(statusOf("scene.empty") == 422);
    CHECK(statusOf("") == 422);
}

TEST_CASE("what a message quotes is short, and cut between characters") {
    CHECK(quoted("a\n\tb") == "\"a  b\"");
    CHECK(quoted(std::string(60, 'x')) == '"' + std::string(60, 'x') + '"');
    CHECK(shown(std::string(61, 'x')) == std::string(60, 'x') + "...");
    // The sixtieth byte is the first of two.
    CHECK(shown(std::string(59, 'x') + "\xC3\xA9y") == std::string(59, 'x') + "...");
}

TEST_CASE("numbers are read as scenes write them, and written to read back") {
    for (const double value : {0.0, 1.0, -0.1, 1e-7, 123456789.25, 1e17})
        CHECK(parseExact<double>(formatNumber(value)) == value);
    CHECK(parseNumber(" +.5f ").value == 0.5);
    CHECK(parseNumber("1e-60").value == 0.0);  // below a float's range
    for (const char* text : {"", "1,5", "nan", "inf", "1e19", "1.2.3", "x"}) {
        CAPTURE(text);
        CHECK_FALSE(parseNumber(text).problem.empty());
    }
    CHECK(parseExact<int>("-3") == -3);
    CHECK_FALSE(parseExact<unsigned>("-3"));
    CHECK_FALSE(parseExact<int>("3 "));
    CHECK_FALSE(parseExact<double>("inf"));
}
