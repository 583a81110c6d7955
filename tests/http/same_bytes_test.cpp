// The same request gives the same bytes, whatever the number of workers, and those of the command
// line.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "daemon.h"
#include "fixture.h"
#include "tests/support/paths.h"

using namespace farol::test;

TEST_CASE("pictures do not depend on the number of workers, nor on who asks beside") {
    const std::string folder = std::string(farol::test::kSourceDir) + "/scenes";
    std::filesystem::create_directories(farol::test::kTestOutput);
    const std::vector<std::string> azimuths{"0", "40", "80", "120", "160", "200"};
    std::vector<std::string> expected;
    for (const std::string& azimuth : azimuths) {
        const std::string out = std::string(farol::test::kTestOutput) + "/workers.png";
        const std::string command = std::string("'") + farol::test::kProgram +
                                    "' render --width 120 --height 90 --azimuth " + azimuth + " '" +
                                    folder + "/primitives/scene.xml' -o '" + out + "'";
        REQUIRE(std::system(command.c_str()) == 0);
        std::ifstream in(out, std::ios::binary);
        expected.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    REQUIRE(expected[0] != expected[1]);
    for (const char* workers : {"1", "3"}) {
        Daemon daemon({"--port", "0", "--workers", workers, "--queue", "32", "--scenes", folder});
        const int port = portIn(daemon.firstLine());
        std::vector<std::string> got(2 * azimuths.size());  // each asked for twice at once
        std::vector<std::thread> clients;
        for (std::size_t i = 0; i < got.size(); ++i)
            clients.emplace_back([&, i] {
                got[i] = get(port, "/v1/scenes/primitives/image?width=120&height=90&azimuth=" +
                                       azimuths[i % azimuths.size()])
                             .body;
            });
        for (std::thread& client : clients) client.join();
        for (std::size_t i = 0; i < got.size(); ++i) {
            INFO(workers << " workers, " << azimuths[i % azimuths.size()]);
            CHECK(got[i] == expected[i % azimuths.size()]);
        }
    }
}
