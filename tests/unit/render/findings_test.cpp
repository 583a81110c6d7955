#include <catch2/catch.hpp>

#include "render/renderer.h"

using namespace farol;

TEST_CASE("many missing meshes are reported within the bound, with how many are not shown") {
    render::Job job;
    job.xml = "<world><group><models>";
    for (int i = 0; i < 15'000; ++i)
        job.xml += "<model file=\"missing" + std::to_string(i) + ".obj\"/>";
    job.xml += "</models></group></world>";
    try {
        render::inspect(job);
        FAIL("the scene is accepted");
    } catch (const Error& error) {
        CHECK(error.code() == "asset.missing");
        REQUIRE(error.diagnostics().size() == 2'000);
        CHECK(error.diagnostics().back().code == "limit.diagnostics");
        CHECK(error.diagnostics().back().message == "13001 more findings are not shown");
    }
}
