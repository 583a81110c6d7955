#include "server/request/problem.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "server/messages.h"

using namespace farol;
using namespace farol::server;
using nlohmann::json;

namespace {

json bodyOf(const Problem& problem) { return json::parse(problemResponse(problem, "r1").body); }

Diagnostics missing(int count, bool isSame) {
    Diagnostics all;
    for (int i = 0; i < count; ++i) {
        Diagnostic finding;
        finding.code = "asset.missing";
        finding.message = "no file \"" + std::to_string(isSame ? 0 : i) + ".3d\"";
        finding.where = {"a.xml", i + 1, 1};
        all.push_back(finding);
    }
    return all;
}

}  // namespace

TEST_CASE("a problem of a message has its code, text and status") {
    const json body = bodyOf(problemOf(404, message<"http.not-found/file">("name"_arg = "x.js")));
    CHECK(body.at("status") == 404);
    CHECK(body.at("code") == "http.not-found");
    CHECK(body.at("detail") == "no file \"x.js\" here");
    REQUIRE(body.at("errors").size() == 1);
    CHECK(body.at("errors")[0].at("message") == body.at("detail"));
    CHECK(body.at("errorsTotal") == 1);
}

TEST_CASE("a problem lists the same missing file once, and at most 50 errors") {
    const json same = bodyOf(problemOf(Error(missing(132, true))));
    REQUIRE(same.at("errors").size() == 1);
    CHECK(same.at("errors")[0].at("count") == 132);
    CHECK(same.at("errors")[0].at("line") == 1);
    CHECK(same.at("errorsTotal") == 132);

    const json many = bodyOf(problemOf(Error(missing(132, false))));
    CHECK(many.at("errors").size() == 50);
    CHECK(many.at("errorsTotal") == 132);
    CHECK(many.at("errors").back().at("code") == "limit.diagnostics");
    CHECK(many.at("errors").back().at("message") == "83 more findings are not shown");
    CHECK_FALSE(many.at("errors").front().contains("count"));
}

TEST_CASE("a problem's texts are in the language, its title and code are not") {
    const Problem problem = problemOf(404, message<"http.not-found/file">("name"_arg = "x.js"));
    const http::Response response = problemResponse(problem, "r1", Language::es);
    const json body = json::parse(response.body);
    CHECK(body.at("detail") == "aquí no hay ningún archivo \"x.js\"");
    CHECK(body.at("errors")[0].at("message") == body.at("detail"));
    CHECK(body.at("title") == "Not Found");
    CHECK(body.at("code") == "http.not-found");
    const auto has = [&](const char* name, const char* value) {
        return std::find(response.headers.begin(), response.headers.end(),
                         std::pair<std::string, std::string>(name, value)) !=
               response.headers.end();
    };
    CHECK(has("Content-Language", "es"));
    CHECK(has("Vary", "Accept-Language"));
}
