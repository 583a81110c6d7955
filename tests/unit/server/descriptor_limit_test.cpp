#include "server/descriptor_limit.h"

#include <catch2/catch.hpp>

#include "core/error.h"

using namespace farol;
using namespace farol::server;

TEST_CASE("connections fit into the descriptors that threads and workers leave") {
    const DescriptorUse use{32, 3};  // 32 + 64 + 6
    CHECK(connectionsWithin(1U << 20U, use, 1024, false) == 1024);
    CHECK(connectionsWithin(1024, use, 1024, false) == 922);
    CHECK(connectionsWithin(1024, use, 922, true) == 922);
    CHECK(connectionsWithin(118, use, 1024, false) == 16);
    CHECK(connectionsWithin(103, use, 1, true) == 1);
    for (const auto& [limit, wanted, isSet] :
         {std::tuple{1024, 923, true}, {117, 1024, false}, {0, 1024, false}, {50, 1, true}}) {
        INFO(limit << " " << wanted);
        try {
            connectionsWithin(static_cast<std::uint64_t>(limit), use, wanted, isSet);
            FAIL_CHECK("accepted");
        } catch (const Error& error) {
            CHECK(error.code() == "option.range");
            CHECK_THAT(error.what(), Catch::Contains(std::to_string(limit)) &&
                                         Catch::Contains("102") &&
                                         Catch::Contains("--max-connections"));
        }
    }
}

TEST_CASE("the limit on descriptors is the hard one") {
    const std::uint64_t limit = raiseDescriptorLimit();
    CHECK(limit >= 256);
    CHECK(raiseDescriptorLimit() == limit);
}
