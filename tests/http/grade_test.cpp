#include "worker/tasks/grade.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "fixture.h"
#include "server/routes/subject.h"
#include "worker/tasks/mesh_check.h"

// POST /v1/grade: accepted and refused requests, before any worker sees them.
using namespace farol;
using namespace farol::test;

TEST_CASE("a grade takes a submission and a reference, and nothing else") {
    FakeServer server;
    const FilePart submission{"submission", "s.xml", "<world/>", ""},
        reference{"reference", "r.png", "\x89PNG...", ""}, rubric{"rubric", "", "{}", ""};
    struct Case {
        const char* about;
        std::vector<FilePart> parts;
        int status;
        const char* code;
    };
    const std::vector<Case> table = {
        {"both", {submission, reference}, 200, ""},
        {"with a rubric", {submission, reference, rubric}, 200, ""},
        {"an archive", {{"submission", "s.zip", "PK\3\4...", ""}, reference}, 200, ""},
        {"no reference", {submission}, 400, "grade.no-reference"},
        {"no submission", {reference}, 400, "grade.no-submission"},
        {"two submissions", {submission, submission, reference}, 400, "http.multipart"},
        {"another part", {submission, reference, {"scene", "a", "b", ""}}, 400, "http.multipart"},
        {"an empty part", {submission, {"reference", "r.xml", "", ""}}, 400, "http.multipart"},
    };
    for (const Case& one : table) {
        INFO(one.about);
        const Answer answer =
            post(server.port(), "/v1/grade", multipart(one.parts), kMultipartType);
        CHECK(answer.status == one.status);
        CHECK(answer.code() == one.code);
    }
    CHECK(post(server.port(), "/v1/grade", "<world/>").status == 415);
    CHECK(post(server.port(), "/v1/grade?pictures=3", multipart({submission, reference}),
               kMultipartType)
              .status == 400);
}

TEST_CASE("a grade knows its task among others, and adds the reference's images where asked") {
    FakeServer server;
    grade::Wanted wanted;
    server.backend.on<worker::GradeTask>([&](const worker::GradeTask::Request& request) {
        wanted = request.submission.wanted;
        worker::GradeTask::Reply reply;
        reply.json = R"({"points":50,"views":[{"name":"a"},{"name":"b"}]})";
        reply.pictures = {"one", "two", "", "three"};
        return reply;
    });
    server.backend.on<worker::ReferenceTask>([](const worker::ReferenceTask::Request&) {
        return worker::ReferenceTask::Reply{{"four", "five"}};
    });
    const std::vector<FilePart> parts{{"submission", "s.zip", "PK\3\4...", ""},
                                      {"reference", "r.xml", "<world/>", ""}};
    const auto viewsOf = [&](const std::string& query) {
        const Answer answer =
            post(server.port(), "/v1/grade" + query, multipart(parts), kMultipartType);
        REQUIRE(answer.status == 200);
        return nlohmann::json::parse(answer.body).at("views");
    };
    const auto url = [](const char* base64) {
        return std::string("data:image/jpeg;base64,") + base64;
    };
    nlohmann::json views = viewsOf("?pictures=2&task=test%204&others=test%205,%20house,");
    CHECK(wanted.task == "test 4");
    CHECK(wanted.others == std::vector<std::string>{"test 5", "house"});
    CHECK(views[0] == nlohmann::json{{"name", "a"},
                                     {"picture", url("b25l")},
                                     {"heat", url("dHdv")},
                                     {"expected", url("Zm91cg==")}});
    CHECK(views[1] ==
          nlohmann::json{{"name", "b"}, {"heat", url("dGhyZWU=")}, {"expected", url("Zml2ZQ==")}});
    CHECK_FALSE(viewsOf("")[0].contains("expected"));
    CHECK(wanted.task.empty());
    CHECK_FALSE(viewsOf("?pictures=0")[0].contains("picture"));
}

TEST_CASE("the content says whether an archive, an image or a scene was handed in") {
    const auto kindOf = [](const char* name, std::string content) {
        const grade::Subject subject =
            server::subjectOf({"submission", name, "", std::move(content)});
        if (subject.picture) return "image";
        return subject.job.archive.empty() ? "scene" : "archive";
    };
    CHECK(kindOf("a.xml", "<world/>") == std::string("scene"));
    CHECK(kindOf("a.xml", "\xFF\xFE<\0w\0") == std::string("scene"));
    CHECK(kindOf("a.xml", "sphere { <0, 0, 0>, 1 }") == std::string("scene"));
    CHECK(kindOf("a.png", "<world/>") == std::string("scene"));
    CHECK(kindOf("a.xml", "\xFF\xD8\xFF\xE0") == std::string("image"));
    CHECK(kindOf("a.tga", std::string(20, '\0')) == std::string("image"));
    CHECK(kindOf("a.xml", "PK\3\4...") == std::string("archive"));
}

TEST_CASE("a comparison takes two pictures or scenes, and nothing else") {
    FakeServer server;
    const FilePart first{"first", "a.png", "\x89PNG...", ""},
        second{"second", "b.xml", "<world/>", ""};
    struct Case {
        const char* about;
        std::string query;
        std::vector<FilePart> parts;
        int status;
        const char* code;
    };
    const std::vector<Case> table = {
        {"both", "", {first, second}, 200, ""},
        {"options", "?crop=auto&mask=axes&pictures=1&azimuth=3", {first, second}, 200, ""},
        {"rectangles", "?crop=4x4%2B0%2B0&mask=1x1%2B2%2B2", {first, second}, 200, ""},
        {"one", "", {first}, 400, "http.multipart"},
        {"twice", "", {first, first, second}, 400, "http.multipart"},
        {"empty", "", {first, {"second", "b.png", "", ""}}, 400, "http.multipart"},
        {"another", "", {first, second, {"third", "c", "x", ""}}, 400, "http.multipart"},
        {"a crop that is none", "?crop=4x4", {first, second}, 400, "option.range"},
        {"a mask that is none", "?mask=all", {first, second}, 400, "option.range"},
    };
    for (const Case& one : table) {
        INFO(one.about);
        const Answer answer =
            post(server.port(), "/v1/compare" + one.query, multipart(one.parts), kMultipartType);
        CHECK(answer.status == one.status);
        CHECK(answer.code() == one.code);
    }
}

TEST_CASE("a mesh is compared with a shape or another mesh, and nothing else") {
    FakeServer server;
    std::string shape, expected, language;
    server.backend.on<worker::MeshCheckTask>([&](const worker::MeshCheckTask::Request& request) {
        shape = request.shape;
        expected = request.expectedBytes;
        language = kLanguageWords[request.language];
        return std::string("{\"same\":true,\"findings\":[]}");
    });
    const FilePart first{"first", "a.3d", "3", ""}, second{"second", "b.3d", "4", ""};
    struct Case {
        std::string query;
        std::vector<FilePart> parts;
        int status;
        const char* code;
    };
    const std::vector<Case> table = {
        {"?shape=sphere%201%2010%2010", {first}, 200, ""},
        {"?mesh=1", {first, second}, 200, ""},
        {"?mesh=1", {first}, 400, "http.multipart"},
        {"?shape=sphere%201%2010%2010", {first, second}, 400, "http.multipart"},
        {"?mesh=1", {first, first}, 400, "http.multipart"},
        {"?mesh=1", {first, {"second", "b.3d", "", ""}}, 400, "http.multipart"},
        {"?mesh=2", {first, second}, 400, "option.range"},
    };
    for (const Case& one : table) {
        INFO(one.query);
        const Answer answer =
            post(server.port(), "/v1/compare" + one.query, multipart(one.parts), kMultipartType);
        CHECK(answer.status == one.status);
        CHECK(answer.code() == one.code);
        if (answer.status != 200) continue;
        CHECK((shape == "sphere 1 10 10") != (expected == "4"));
    }
    const Answer czech =
        ask(server.port(), {"POST",
                            "/v1/compare?mesh=1",
                            {{"Content-Type", kMultipartType}, {"Accept-Language", "cs"}},
                            multipart({first, second})});
    CHECK(language == "cs");
    CHECK(czech.header("content-language") == "cs");
}

TEST_CASE("a rubric whose requirements have all points takes no reference") {
    FakeServer server;
    const FilePart submission{"submission", "s.xml", "<world/>", ""},
        reference{"reference", "r.xml", "<world/>", ""};
    const FilePart all{"rubric", "",
                       R"({"requirements": [{"id": "a", "text": "t", "select": {}}]})", ""};
    const FilePart some{
        "rubric", "", R"({"points": 9, "requirements": [{"id": "a", "text": "t", "select": {}}]})",
        ""};
    const FilePart wrong{"rubric", "",
                         R"({"requirements": [{"id": "a", "text": "t", "select": {}, "cout": 1}]})",
                         ""};
    const auto grade = [&](const std::vector<FilePart>& parts) {
        return post(server.port(), "/v1/grade", multipart(parts), kMultipartType);
    };
    CHECK(grade({submission, all}).status == 200);
    CHECK(grade({submission, all, reference}).code() == "grade.needless-reference");
    CHECK(grade({submission, some}).code() == "grade.no-reference");
    CHECK(grade({submission, some, reference}).status == 200);
    const Answer refused = grade({submission, wrong});
    CHECK(refused.status == 422);
    CHECK(refused.json()["errors"][0]["field"] == "/requirements/0/cout");
}
