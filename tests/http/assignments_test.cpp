// Assignments over HTTP: what teachers and students may do, and what an answer gives away.
#include "server/assignments/assignments.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <set>
#include <thread>

#include "real.h"
#include "worker/tasks/assignment.h"
#include "worker/tasks/grade.h"

using namespace farol;
using namespace farol::test;
using nlohmann::json;

namespace {

constexpr const char* kToken = "secret-token";
constexpr std::chrono::milliseconds kStep{400};

using Headers = std::vector<std::pair<std::string, std::string>>;

Headers bearer(const std::string& value) { return {{"Authorization", "Bearer " + value}}; }

/// A service with a token, and the fakes of a grader: `band` is what a submission earns.
struct School : FakeServer {
    explicit School(server::ServiceOptions options = withToken()) : FakeServer(std::move(options)) {
        backend.on<worker::ReferenceTask>([](const worker::ReferenceTask::Request& request) {
            if (request.reference.job.xml == "<svg/>")
                throw Error(Message{"scene.root", "is no scene", {}});
            return worker::ReferenceTask::Reply{};
        });
        backend.on<worker::AssignmentTask>([this](const worker::AssignmentTask::Request& request) {
            if (onGrade) onGrade(request);
            grade::Grade grade;
            grade.points = points;
            grade.most = 100.0;
            return grade::studentAnswer(grade, request.view, request.grade.language);
        });
    }
    static server::ServiceOptions withToken() {
        server::ServiceOptions options;
        options.token = kToken;
        options.checkTime = kStep;
        return options;
    }
    Answer teach(const std::string& method, const std::string& target, const std::string& body = "",
                 const std::string& type = "application/json") {
        Headers headers = bearer(kToken);
        if (!body.empty()) headers.emplace_back("Content-Type", type);
        return ask(port(), {method, target, headers, body});
    }
    Answer put(const std::string& id, const std::string& settings,
               const std::string& reference = "<world/>") {
        std::vector<FilePart> parts;
        if (!settings.empty()) parts.push_back({"assignment", "", settings, "application/json"});
        if (!reference.empty()) parts.push_back({"reference", "scene.xml", reference, ""});
        return teach("PUT", "/v1/assignments/" + id, multipart(parts), kMultipartType);
    }
    std::string codeOf(const std::string& id, const std::string& student) {
        const Answer answer =
            teach("POST", "/v1/assignments/" + id + "/codes", json{{"students", {student}}}.dump());
        REQUIRE(answer.status == 200);
        return answer.json()["codes"][0]["code"];
    }
    Answer check(const std::string& id, const std::string& code,
                 const std::string& submission = "<world>1</world>") {
        Headers headers = bearer(code);
        headers.emplace_back("Content-Type", kMultipartType);
        return ask(port(), {"POST", "/v1/assignments/" + id + "/check", headers,
                            multipart({{"submission", "mine.xml", submission, ""}})});
    }

    double points = 60.0;
    std::function<void(const worker::AssignmentTask::Request&)> onGrade;
};

/// Headers that do not change from request to request.
std::multimap<std::string, std::string> steady(const Answer& answer) {
    auto headers = answer.headers;
    for (const char* own : {"x-request-id", "date"}) headers.erase(own);
    return headers;
}

}  // namespace

TEST_CASE("a teacher keeps an assignment, and students see what is theirs") {
    School school;
    const Answer put = school.put(
        "arm",
        R"({"title": "Robot arm", "closes": "2199-12-01T00:00:00Z", "shows": ["lights"], "tries": 5})");
    REQUIRE(put.status == 201);
    CHECK(put.json()["reference"]["bytes"] == 8);
    CHECK(put.json()["referenceFiles"] == false);
    CHECK(school.put("arm", R"({"title": "Arm"})").status == 200);

    const Answer seen = get(school.port(), "/v1/assignments/arm");
    REQUIRE(seen.status == 200);
    CHECK(seen.json() == json{{"id", "arm"},
                              {"title", "Arm"},
                              {"open", true},
                              {"opens", nullptr},
                              {"closes", nullptr},
                              {"shows", {"requirements", "document"}},
                              {"bands", 4},
                              {"mask", false},
                              {"triesPerHour", 2},
                              {"tries", 12}});
    CHECK(seen.header("etag").empty());
    CHECK(seen.header("cache-control") == "no-store");
    CHECK(get(school.port(), "/v1/assignments/arm", bearer("wrong")).status == 401);
    CHECK(school.teach("GET", "/v1/assignments/arm").json().contains("reference"));
    CHECK(school.teach("GET", "/v1/assignments").json()["assignments"].size() == 1);
    for (const char* path :
         {"/v1/assignments", "/v1/assignments/arm/codes", "/v1/assignments/arm/submissions"})
        CHECK(get(school.port(), path).status == 401);
    CHECK(ask(school.port(), {"DELETE", "/v1/assignments/arm", {}, ""}).status == 401);
    CHECK(school.teach("DELETE", "/v1/assignments/arm").status == 204);
    CHECK(school.teach("DELETE", "/v1/assignments/arm").status == 404);
    CHECK(get(school.port(), "/v1/assignments/arm").status == 404);
}

TEST_CASE("a server without a token keeps no assignments") {
    School school{server::ServiceOptions{}};
    const Answer put = school.put("arm", "");
    CHECK(put.status == 403);
    CHECK(put.code() == "assignment.no-token");
    CHECK(get(school.port(), "/v1/assignments").status == 403);
}

TEST_CASE("wrong assignments are refused, and name what is wrong") {
    School school;
    struct Case {
        const char *settings, *reference;
        int status;
        const char *code, *field;
    };
    const Case table[] = {
        {"{", "<world/>", 422, "assignment.json", ""},
        {"[]", "<world/>", 422, "assignment.json", ""},
        {R"({"title": 3})", "<world/>", 422, "assignment.type", "/title"},
        {R"({"tries": 2.5})", "<world/>", 422, "assignment.type", "/tries"},
        {R"({"mask": 1})", "<world/>", 422, "assignment.type", "/mask"},
        {R"({"shows": "all"})", "<world/>", 422, "assignment.type", "/shows"},
        {R"({"shows": [3]})", "<world/>", 422, "assignment.type", "/shows/0"},
        {R"({"shows": ["models", "models", "models", "models", "models", "models", "models",
                        "models", "models", "models"]})",
         "<world/>", 422, "assignment.range", "/shows"},
        {R"({"shows": ["transforms", "transforms"]})", "<world/>", 422, "assignment.range",
         "/shows/1"},
        {R"({"triez": 3})", "<world/>", 422, "assignment.key", "/triez"},
        {R"({"tries": 0})", "<world/>", 422, "assignment.range", "/tries"},
        {R"({"tries": 1001})", "<world/>", 422, "assignment.range", "/tries"},
        {R"({"bands": 1})", "<world/>", 422, "assignment.range", "/bands"},
        {R"({"bands": 11})", "<world/>", 422, "assignment.range", "/bands"},
        {R"({"retentionDays": 401})", "<world/>", 422, "assignment.range", "/retentionDays"},
        {R"({"shows": ["all"]})", "<world/>", 422, "assignment.range", "/shows/0"},
        {R"({"closes": "soon"})", "<world/>", 422, "assignment.time", "/closes"},
        {R"({"opens": "2026-12-01T00:00:00Z", "closes": "2026-11-01T00:00:00Z"})", "<world/>", 422,
         "assignment.time", "/closes"},
        {"{}", "", 400, "grade.no-reference", "reference"},
        {"{}", "<svg/>", 422, "scene.root", ""},
    };
    for (const Case& one : table) {
        INFO(one.settings);
        const Answer answer = school.put("arm", one.settings, one.reference);
        CHECK(answer.status == one.status);
        CHECK(answer.code() == one.code);
        CHECK(answer.json()["errors"][0].value("field", "") == one.field);
    }
    CHECK(school.put("Arm", "{}").code() == "assignment.id");
    CHECK(school.put(std::string(41, 'a'), "{}").code() == "assignment.id");
    CHECK(get(school.port(), "/v1/assignments/arm").status == 404);
    REQUIRE(school.put("arm", "").status == 201);
    for (const char* body : {"", "{}", R"({"students": []})", R"({"students": [""]})",
                             R"({"students": ["a\nb"]})", R"({"students": [1]})"})
        CHECK(school.teach("POST", "/v1/assignments/arm/codes", body).status == 422);
    CHECK(school
              .teach("POST", "/v1/assignments/arm/codes",
                     json{{"students", {std::string(101, 'a')}}}.dump())
              .code() == "assignment.students");
    CHECK(school.teach("POST", "/v1/assignments/leg/codes", R"({"students": ["a"]})").status ==
          404);
}

TEST_CASE("a check needs a code, an open assignment and a submission") {
    School school;
    REQUIRE(school.put("arm", "").status == 201);
    const std::string code = school.codeOf("arm", "ana");
    CHECK(school.check("leg", code).status == 404);
    CHECK(school.check("arm", "").code() == "assignment.code");
    CHECK(school.check("arm", code.substr(1)).code() == "assignment.code");
    CHECK(school.check("arm", kToken).status == 401);
    CHECK(school.check("arm", code, "").status == 400);
    Headers headers = bearer(code);
    headers.emplace_back("Content-Type", kMultipartType);
    const FilePart mine{"submission", "a.xml", "<world/>", ""};
    for (const auto& parts : {std::vector<FilePart>{mine, mine}, {{"rubric", "", "{}", ""}}})
        CHECK(ask(school.port(), {"POST", "/v1/assignments/arm/check", headers, multipart(parts)})
                  .status == 400);

    school.put("arm", R"({"opens": "2199-12-01T00:00:00Z"})");
    const Answer early = school.check("arm", code);
    CHECK(early.status == 403);
    CHECK(early.code() == "assignment.closed");
    CHECK(early.json()["detail"].get<std::string>().find("2199-12-01T00:00:00Z") !=
          std::string::npos);
    CHECK(get(school.port(), "/v1/assignments/arm").json()["open"] == false);
    school.put("arm", R"({"closes": "2001-12-01T00:00:00Z"})");
    const Answer late = school.check("arm", code);
    CHECK(late.status == 403);
    CHECK(late.json()["detail"].get<std::string>().find("2001-12-01T00:00:00Z") !=
          std::string::npos);
}

TEST_CASE("tries count for a student, whatever the code, and end") {
    School school;
    REQUIRE(school.put("arm", R"({"triesPerHour": 2, "tries": 3})").status == 201);
    std::string code = school.codeOf("arm", "ana");
    const std::string other = school.codeOf("arm", "rui");
    const Answer first = school.check("arm", code);
    REQUIRE(first.status == 200);
    CHECK(first.json()["tries"]["left"] == 2);
    CHECK(first.json()["points"] ==
          json{{"band", 2}, {"bands", 4}, {"fromPercent", 50.0}, {"toPercent", 75.0}});
    CHECK(school.check("arm", code).status == 200);
    const Answer none = school.check("arm", code);
    CHECK(none.status == 429);
    CHECK(none.code() == "assignment.tries");
    CHECK(std::stoi(none.header("retry-after")) > 3'500);
    CHECK(std::stoi(none.header("retry-after")) <= 3'600);
    CHECK(school.check("arm", other).status == 200);
    code =
        school.teach("POST", "/v1/assignments/arm/codes", R"({"students": ["ana"], "renew": true})")
            .json()["codes"][0]["code"];
    CHECK(school.check("arm", code).status == 429);
    // A document that cannot be read costs no try.
    school.backend.onRender = [](const render::Job& job) -> render::Picture {
        if (job.xml == "<svg/>") throw Error(Message{"scene.root", "is no scene", {}});
        return {};
    };
    school.put("arm", R"({"triesPerHour": 9, "tries": 3})");
    CHECK(school.check("arm", code, "<svg/>").status == 422);
    CHECK(school.check("arm", code).json()["tries"] == json{{"left", 0}, {"next", nullptr}});
    const Answer all = school.check("arm", code);
    CHECK(all.status == 429);
    CHECK(all.header("retry-after").empty());
}

TEST_CASE("the own image is rendered without the reference") {
    School school;
    REQUIRE(school.put("arm", "", "<world>hidden</world>").status == 201);
    school.backend.onRender = [](const render::Job& job) {
        CHECK(job.xml == "<world>1</world>");
        CHECK(job.assets->list() == std::vector<std::string>{"mine.xml"});
        render::Picture own;
        own.bytes = "own";
        own.diagnostics = {
            {Severity::warning, "camera.missing", {"mine.xml", 1, 1}, "no camera", ""}};
        return own;
    };
    school.onGrade = [](const worker::AssignmentTask::Request& request) {
        CHECK(request.grade.reference.job.xml == "<world>hidden</world>");
        CHECK(request.grade.submission.job.xml == "<world>1</world>");
        CHECK(json::parse(request.grade.rubric.json)["lend"] == false);
    };
    const Answer answer = school.check("arm", school.codeOf("arm", "ana"));
    REQUIRE(answer.status == 200);
    CHECK(answer.json()["image"] == "data:image/jpeg;base64,b3du");
    CHECK(answer.json()["diagnostics"][0]["code"] == "camera.missing");
    school.put("arm", R"({"shows": []})", "<world>hidden</world>");
    CHECK_FALSE(school.check("arm", school.codeOf("arm", "rui")).json().contains("diagnostics"));
}

TEST_CASE("headers, lengths and times of answers do not depend on the points in a band") {
    School school;
    REQUIRE(school.put("arm", R"({"triesPerHour": 1000, "tries": 1000})").status == 201);
    std::set<std::multimap<std::string, std::string>> headers;
    std::set<std::string> bodies;
    int student = 0;
    for (const double points : {50.0, 55.5, 74.99, 30.0}) {
        school.points = points;
        const auto pause = std::chrono::milliseconds(static_cast<int>(points) % 7 * 20);
        school.onGrade = [pause](const auto&) { std::this_thread::sleep_for(pause); };
        const std::string code = school.codeOf("arm", std::to_string(++student));
        const auto since = std::chrono::steady_clock::now();
        const Answer answer = school.check("arm", code);
        const auto took = std::chrono::steady_clock::now() - since;
        REQUIRE(answer.status == 200);
        CHECK(took >= kStep);  // later, never earlier
        for (const char* absent : {"etag", "server-timing", "x-farol-stats", "x-farol-diagnostics"})
            CHECK(answer.header(absent).empty());
        headers.insert(steady(answer));
        json body = answer.json();
        body.erase("tries");
        bodies.insert(body.dump());
    }
    CHECK(headers.size() == 1);  // Content-Length among them
    CHECK(bodies.size() == 2);   // two bands
    // The times of the jobs are not on the page of metrics either.
    const std::string metrics = get(school.port(), "/metrics").body;
    CHECK(metrics.find("farol_job_duration_seconds_sum{task=\"assignment\"}") == std::string::npos);
}

TEST_CASE("faults of a check have one shape and leave at the same times") {
    School school;
    REQUIRE(school.put("arm", R"({"triesPerHour": 1000, "tries": 1000})").status == 201);
    std::set<std::string> bodies;
    int student = 0;
    const std::vector<std::function<void()>> faults = {
        [] {
            throw Error(Message{"limit.cost", "the reference has 4.25 models", {}});
        },
        [] { throw std::runtime_error("reference at 1 2 3"); },
        [] {
            throw worker::Busy(Message{"worker.crashed", "worker 7", {}}, 1);
        }};
    for (const auto& fault : faults) {
        school.onGrade = [&](const auto&) { fault(); };
        const std::string code = school.codeOf("arm", std::to_string(++student));
        const auto since = std::chrono::steady_clock::now();
        const Answer answer = school.check("arm", code);
        CHECK(std::chrono::steady_clock::now() - since >= kStep);
        CHECK(answer.status == 503);
        CHECK(answer.code() == "assignment.failed");
        json body = answer.json();
        body.erase("requestId");
        bodies.insert(body.dump() + answer.header("retry-after"));
    }
    CHECK(bodies.size() == 1);
    std::string log;
    for (const std::string& line : school.log()) log += line;
    CHECK(log.find("the reference has 4.25 models") != std::string::npos);  // for the operator
}

TEST_CASE("submissions are kept where the assignment says so, for the teacher alone") {
    School school;
    REQUIRE(school.put("arm", R"({"retentionDays": 7})").status == 201);
    REQUIRE(school.check("arm", school.codeOf("arm", "Ana Sá")).status == 200);
    const Answer list = school.teach("GET", "/v1/assignments/arm/submissions");
    REQUIRE(list.json()["submissions"].size() == 1);
    CHECK(list.json()["submissions"][0]["student"] == "Ana Sá");
    CHECK(list.json()["submissions"][0]["file"] == "mine.xml");
    const Answer bytes =
        school.teach("GET", "/v1/assignments/arm/submissions?student=Ana%20S%C3%A1");
    CHECK(bytes.body == "<world>1</world>");
    CHECK(bytes.header("content-type") == "application/octet-stream");
    CHECK(school.teach("GET", "/v1/assignments/arm/submissions?student=rui").status == 404);
    school.teach("DELETE", "/v1/assignments/arm");
    CHECK(school.teach("GET", "/v1/assignments/arm/submissions").status == 404);
}

TEST_CASE("two services on the same records count tries together, and a restart forgets nothing") {
    server::ServiceOptions options = School::withToken();
    options.records = std::make_shared<server::store::MemoryRecords>(1'000'000);
    std::string code;
    {
        School first{options}, second{options};
        REQUIRE(first.put("arm", R"({"triesPerHour": 2, "tries": 2})").status == 201);
        code = first.codeOf("arm", "ana");
        CHECK(first.check("arm", code).status == 200);
        CHECK(second.check("arm", code).json()["tries"]["left"] == 0);
        CHECK(first.check("arm", code).status == 429);
    }
    School third{options};
    CHECK(third.check("arm", code).status == 429);
}

TEST_CASE("the real grader answers a check with a band, and with nothing of the reference") {
    server::ServiceOptions options = School::withToken();
    options.checkTime = std::chrono::milliseconds(50);
    RealServer server(options);
    const auto boxAt = [](const std::string& x) {
        return world("<group><transform><translate x=\"" + x +
                     "\" y=\"0\" z=\"0\"/></transform><models>\n<model file=\"box_1_2.3d\"/>"
                     "</models></group>");
    };
    Headers teacher = bearer(kToken);
    teacher.emplace_back("Content-Type", kMultipartType);
    const auto put = [&](const std::string& id, const std::string& x) {
        const std::string settings = R"({"shows": ["transforms", "document"], "mask": true})";
        const Answer answer =
            ask(server.port(), {"PUT", "/v1/assignments/" + id, teacher,
                                multipart({{"assignment", "", settings, ""},
                                           {"reference", "scene.xml", boxAt(x), ""}})});
        REQUIRE(answer.status == 201);
        const Answer codes = ask(server.port(), {"POST", "/v1/assignments/" + id + "/codes",
                                                 bearer(kToken), R"({"students": ["ana"]})"});
        return codes.json()["codes"][0]["code"].get<std::string>();
    };
    const auto check = [&](const std::string& id, const std::string& code, const std::string& x) {
        Headers headers = bearer(code);
        headers.emplace_back("Content-Type", kMultipartType);
        const Answer answer =
            ask(server.port(), {"POST", "/v1/assignments/" + id + "/check", headers,
                                multipart({{"submission", "mine.xml", boxAt(x), ""}})});
        INFO(answer.body);
        REQUIRE(answer.status == 200);
        return answer;
    };
    const std::string left = put("left", "-1.375"), right = put("right", "1.625");
    const json same = check("left", left, "-1.375").json();
    CHECK(same["points"]["band"] == 3);
    CHECK(same["findings"].empty());
    CHECK(same["mask"]["cells"] == std::string(192, '0'));
    const Answer other = check("left", left, "0.5");
    CHECK(other.json()["findings"][0]["line"].get<int>() > 0);
    CHECK(other.json()["findings"][0]["message"] == "a transform here differs from the assignment");
    for (const char* secret : {"1.375", "1.625"}) {
        CHECK(other.body.find(secret) == std::string::npos);
        for (const auto& [name, value] : other.headers)
            CHECK(value.find(secret) == std::string::npos);
    }
    // The own image is that of the submission alone, whatever the reference.
    CHECK(check("right", right, "0.5").json()["image"] == other.json()["image"]);
}
