#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "run.h"
#include "service.h"
#include "tests/support/paths.h"

/// Starting the service, and asking whether it is ready.
using namespace farol::test;

TEST_CASE("scripts/run reports a port in use before it builds, and names --port") {
    freshFolder();
    Service service;
    const std::string port = service.url().substr(service.url().rfind(':') + 1);
    const std::string log = (folder() / "run.txt").string();
    for (const std::string& words :
         {"FAROL_PORT=" + port + std::string(" '") + farol::test::kSourceDir + "/scripts/run'",
          std::string("'") + farol::test::kSourceDir + "/scripts/run' --port " + port,
          std::string("'") + farol::test::kSourceDir +
              "/scripts/run' --host=0.0.0.0 --port=" + port}) {
        INFO(words);
        CHECK(std::system(("FAROL_SKIP_SETUP=1 " + words + " > '" + log + "' 2>&1").c_str()) != 0);
        const std::string text = readFile("run.txt");
        CHECK_THAT(text, Catch::Contains("port " + port + " of 127.0.0.1 is in use"));
        CHECK_THAT(text, Catch::Contains("scripts/run --port"));
        CHECK_THAT(text, !Catch::Contains("configuring"));
    }
    CHECK(service.stop() == 0);
}

TEST_CASE("serve is healthy until it is asked to end, and ends with exit code 0") {
    freshFolder();
    Service service;
    const Outcome up = run("health " + service.url());
    INFO(up.err);
    CHECK(up.status == 0);
    CHECK(run("health " + service.url() + "/ --timeout 30").status == 0);
    CHECK_THAT(run("health --json " + service.url()).out, Catch::Contains("\"ready\": true"));
    CHECK(service.stop() == 0);
    CHECK(run("health " + service.url()).status == 1);
}
