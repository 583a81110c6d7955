#include <catch2/catch.hpp>

#include "fixture.h"

// POST /v1/grade: what is taken and what is refused, before any worker sees it.
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
    CHECK(post(server.port(), "/v1/grade?pictures=2", multipart({submission, reference}),
               kMultipartType)
              .status == 400);
}
