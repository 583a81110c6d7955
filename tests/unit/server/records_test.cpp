// Records and tries, in memory, on disk and in a Redis: the same guarantees.
#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>

#include "redis_server.h"
#include "server/assignments/assignments.h"
#include "server/store/disk_records.h"
#include "server/store/redis_records.h"
#include "tests/support/paths.h"
#include "worker/backend.h"

using namespace farol;
using namespace farol::server;
using namespace farol::server::store;
using farol::test::RedisServer;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kRoom = 1'000'000;

std::string freshFolder() {
    static int count = 0;
    const fs::path path = fs::path(test::kTestOutput) /
                          ("records-" + std::to_string(getpid()) + "-" + std::to_string(++count));
    fs::remove_all(path);
    return path.string();
}

std::unique_ptr<RecordStore> onDisk(const std::string& folder, std::uint64_t room = kRoom) {
    return std::make_unique<DiskRecords>(folder, room, [](const std::string&) {});
}

Time inSeconds(int seconds) { return now() + std::chrono::seconds(seconds); }

std::string codeOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    } catch (const worker::Busy& busy) {
        return busy.code();
    }
    return "none";
}

/// What all stores of records promise.
void checkPromises(RecordStore& records) {
    CHECK_FALSE(records.get("a", "x"));
    CHECK_FALSE(records.remove("a", "x"));
    CHECK(records.keys("a").empty());
    const std::string bytes("one\n\0two", 8);
    records.put("a", "x", bytes, Time::max());
    records.put("a", "w", "1", inSeconds(1'000));
    records.put("a.b", "x", "2", Time::max());
    CHECK(records.get("a", "x") == bytes);
    CHECK(records.get("a", "w") == "1");
    CHECK(records.keys("a") == std::vector<std::string>{"w", "x"});
    records.put("a", "x", "", Time::max());
    CHECK(records.get("a", "x") == "");
    records.put("a", "gone", "3", inSeconds(-10));
    CHECK_FALSE(records.get("a", "gone"));
    CHECK(records.expire() == 1);
    CHECK(records.expire() == 0);
    CHECK(records.remove("a", "w"));
    CHECK_FALSE(records.get("a", "w"));
    records.clear("a");
    CHECK(records.keys("a").empty());
    CHECK(records.get("a.b", "x") == "2");

    const TryLimits limits{2, 3, inSeconds(10'000)};
    const Tries first = records.take("tries", "ana", limits);
    CHECK(first.isGranted);
    CHECK(first.left == 2);
    REQUIRE(first.next);
    CHECK(*first.next <= inSeconds(5));
    const Tries second = records.take("tries", "ana", limits);
    CHECK(second.isGranted);
    CHECK(second.left == 1);
    const Tries third = records.take("tries", "ana", limits);
    CHECK_FALSE(third.isGranted);
    CHECK(third.left == 1);
    REQUIRE(third.next);
    CHECK(*third.next > inSeconds(3'500));
    CHECK(*third.next < inSeconds(3'700));
    CHECK(records.take("tries", "rui", limits).left == 2);
    // Limits may change; what was counted stays.
    CHECK(records.take("tries", "ana", {9, 3, inSeconds(10'000)}).isGranted);
    const Tries none = records.take("tries", "ana", {9, 3, inSeconds(10'000)});
    CHECK_FALSE(none.isGranted);
    CHECK(none.left == 0);
    CHECK_FALSE(none.next);
    records.clear("tries");
    CHECK(records.take("tries", "ana", limits).left == 2);

    CHECK(codeOf([&] { records.put("a", "large", std::string(kRoom + 1, 'x'), Time::max()); }) ==
          "store.full");
    CHECK_FALSE(records.get("a", "large"));
    records.put("a", "large", std::string(kRoom - 10'000, 'x'), Time::max());
    records.put("a", "large", std::string(kRoom - 10'000, 'y'), Time::max());  // in its place
    records.clear("a");
    records.put("a", "again", std::string(kRoom - 10'000, 'x'), Time::max());
    records.clear("a");
}

/// Many takers at once get as many tries as there are.
void checkRace(const std::function<RecordStore&(int)>& storeOf) {
    std::atomic<int> granted{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&, i] {
            for (int k = 0; k < 5; ++k)
                granted += storeOf(i).take("race", "ana", {20, 12, inSeconds(1'000)}).isGranted;
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(granted == 12);
}

}  // namespace

TEST_CASE("tries are limited within an hour and in all") {
    std::vector<std::int64_t> triesMs;
    const Time start = Time(std::chrono::seconds(1'000'000));
    const auto at = [&](int minutes) { return start + std::chrono::minutes(minutes); };
    const TryLimits limits{2, 5, Time::max()};
    CHECK(takeTry(triesMs, limits, at(0)) == Tries{true, 4, at(0)});
    CHECK(takeTry(triesMs, limits, at(10)) == Tries{true, 3, at(60)});
    CHECK(takeTry(triesMs, limits, at(59)) == Tries{false, 3, at(60)});
    CHECK(takeTry(triesMs, limits, at(60)) == Tries{true, 2, at(70)});
    CHECK(takeTry(triesMs, limits, at(69)) == Tries{false, 2, at(70)});
    CHECK(takeTry(triesMs, limits, at(500)) == Tries{true, 1, at(500)});
    CHECK(takeTry(triesMs, limits, at(501)) == Tries{true, 0, std::nullopt});
    CHECK(takeTry(triesMs, limits, at(9'000)) == Tries{false, 0, std::nullopt});
    CHECK(triesMs.size() == 5);
}

TEST_CASE("records in memory and on disk keep the same promises") {
    MemoryRecords memory(kRoom);
    checkPromises(memory);
    checkRace([&](int) -> RecordStore& { return memory; });
    const std::string folder = freshFolder();
    const auto disk = onDisk(folder);
    checkPromises(*disk);
    checkRace([&](int) -> RecordStore& { return *disk; });
    fs::remove_all(folder);
}

TEST_CASE("records on disk survive a restart, and damaged ones are never served") {
    const std::string folder = freshFolder();
    {
        const auto records = onDisk(folder);
        records->put("a", "x", "one", Time::max());
        records->put("a", "bent", "two", Time::max());
        records->put("a", "soon", "three", inSeconds(2));
        CHECK(records->take("tries", "ana", {1, 9, Time::max()}).isGranted);
    }
    {
        std::fstream file(folder + "/records/a/bent", std::ios::in | std::ios::out);
        file.seekp(-1, std::ios::end);
        file.put('X');
    }
    std::ofstream(folder + "/records/new/half") << "cut";
    const auto records = onDisk(folder);
    CHECK(records->get("a", "x") == "one");
    CHECK_FALSE(records->get("a", "bent"));
    CHECK_FALSE(fs::exists(folder + "/records/new/half"));
    CHECK_FALSE(records->take("tries", "ana", {1, 9, Time::max()}).isGranted);
    // Its end is in whole seconds, rounded up.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (records->get("a", "soon") && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK_FALSE(records->get("a", "soon"));
    CHECK(records->expire() == 1);
    CHECK_FALSE(fs::exists(folder + "/records/a/soon"));
    fs::remove_all(folder);
}

TEST_CASE("two services that share a Redis share records and tries") {
    RedisServer redis;
    const auto open = [&] {
        return std::make_unique<RedisRecords>(redis.address(), kRoom, [](const std::string&) {});
    };
    const auto here = open(), there = open();
    checkPromises(*here);
    here->put("a", "x", "one", Time::max());
    CHECK(there->get("a", "x") == "one");
    CHECK(there->remove("a", "x"));
    CHECK_FALSE(here->get("a", "x"));
    checkRace([&](int i) -> RecordStore& { return i % 2 == 0 ? *here : *there; });
    redis.stop();
    CHECK(codeOf([&] { here->put("a", "x", "one", Time::max()); }) == "store.unreachable");
    CHECK(codeOf([&] { here->take("a", "x", {}); }) == "store.unreachable");
    CHECK(here->expire() == 0);
}

TEST_CASE("codes belong to students, and end when they are renewed") {
    MemoryRecords records(kRoom);
    Assignments assignments(records);
    Assignment arm;
    arm.id = "arm";
    CHECK(assignments.put(arm));
    CHECK_FALSE(assignments.put(arm));
    const auto first = assignments.issue("arm", {"rui", "Ana Sá"}, false);
    REQUIRE(first.size() == 2);
    CHECK(first[0].code.size() == 24);
    CHECK(first[0].code != first[1].code);
    CHECK(assignments.studentOf("arm", first[1].code) == "Ana Sá");
    CHECK_FALSE(assignments.studentOf("arm", ""));
    CHECK_FALSE(assignments.studentOf("arm", first[0].code + "a"));
    CHECK_FALSE(assignments.studentOf("leg", first[0].code));
    CHECK(assignments.issue("arm", {"rui"}, false)[0].code == first[0].code);
    const auto renewed = assignments.issue("arm", {"rui"}, true);
    CHECK(renewed[0].code != first[0].code);
    CHECK_FALSE(assignments.studentOf("arm", first[0].code));
    CHECK(assignments.studentOf("arm", renewed[0].code) == "rui");
    REQUIRE(assignments.codes("arm").size() == 2);
    CHECK(assignments.codes("arm")[0].student == "Ana Sá");
    // A new code has no new tries.
    CHECK(assignments.take(arm, "rui").left == arm.tries - 1);
    assignments.issue("arm", {"rui"}, true);
    CHECK(assignments.take(arm, "rui").left == arm.tries - 2);
    CHECK(assignments.remove("arm"));
    CHECK_FALSE(assignments.remove("arm"));
    CHECK_FALSE(assignments.studentOf("arm", renewed[0].code));
    CHECK(assignments.codes("arm").empty());
    CHECK(assignments.take(arm, "rui").left == arm.tries - 1);
    CHECK_FALSE(assignments.remove("../x"));
    CHECK_FALSE(assignments.find("../x"));
}

TEST_CASE("the last submission of a student is kept until its end") {
    MemoryRecords records(kRoom);
    Assignments assignments(records);
    Assignment arm;
    arm.id = "arm";
    assignments.put(arm);
    const auto submission = [](const char* student, Time at, const std::string& bytes) {
        return KeptSubmission{student, "s.xml", at, bytes.size(), bytes};
    };
    assignments.keep(arm, submission("rui", now(), "<world/>"));
    CHECK(assignments.submissions("arm").empty());  // nothing is kept by default
    arm.retentionDays = 2;
    assignments.keep(arm, submission("rui", now(), "<world>1</world>"));
    assignments.keep(arm, submission("rui", now(), "<world>2</world>"));
    assignments.keep(arm, submission("ana", now() - std::chrono::hours(49), "<world>3</world>"));
    REQUIRE(assignments.submissions("arm").size() == 1);
    CHECK(assignments.submissions("arm")[0].bytes.empty());
    CHECK(assignments.submissions("arm")[0].size == 16);
    CHECK(assignments.submissionOf("arm", "rui")->bytes == "<world>2</world>");
    CHECK_FALSE(assignments.submissionOf("arm", "ana"));
    CHECK(assignments.expire() == 1);
    assignments.remove("arm");
    CHECK_FALSE(assignments.submissionOf("arm", "rui"));
}

TEST_CASE("an assignment is the same after it was kept") {
    Assignment arm;
    arm.id = "arm";
    arm.title = "Arm \xE9";  // no UTF-8
    arm.opens = *timeOfText("2026-11-01T08:00:00Z");
    arm.closes = *timeOfText("2026-12-01T23:59:59Z");
    arm.view.shows = {};
    arm.view.bands = 7;
    arm.view.hasMask = true;
    arm.lendsFiles = true;
    arm.triesPerHour = 4;
    arm.tries = 40;
    arm.retentionDays = 30;
    arm.rubric = "{\"points\": 20}";
    arm.referenceName = "scene.zip";
    arm.reference = std::string("PK\3\4\0\n{", 7);
    const std::string record = encodeAssignment(arm);
    const auto again = decodeAssignment("arm", record);
    REQUIRE(again);
    CHECK(again->reference == arm.reference);
    CHECK(again->rubric == arm.rubric);
    CHECK(again->opens == arm.opens);
    CHECK(again->closes == arm.closes);
    CHECK(again->view.shows.empty());
    CHECK(encodeAssignment(*again) == record);
    CHECK(again->rules().lend);
    CHECK(again->rules().points == 20.0);
    for (const std::string& wrong :
         {std::string(), std::string("{}\n"), record.substr(0, 40),
          "{\"settings\":{},\"referenceName\":\"\",\"rubricBytes\":9}\n" + std::string("short")})
        CHECK_FALSE(decodeAssignment("arm", wrong));
}

TEST_CASE("times are RFC 3339 in UTC, and nothing else") {
    CHECK(timeText(*timeOfText("2028-02-29T23:59:59Z")) == "2028-02-29T23:59:59Z");
    for (const char* wrong :
         {"", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-01-01T24:00:00Z",
          "2026-01-01 00:00:00Z", "2026-01-01T00:00:00+01:00", "2026-1-01T00:00:00ZZ",
          "1969-12-31T23:59:59Z", "9999-01-01T00:00:00Z", "2026-01-01T00:00:60Z", "tomorrow"})
        CHECK_FALSE(timeOfText(wrong));
    for (const char* id : {"arm", "4-1", "a"}) CHECK(isAssignmentId(id));
    for (const char* id : {"", "Arm", "a b", "../x", ".a", "a.b", "é"})
        CHECK_FALSE(isAssignmentId(id));
    CHECK_FALSE(isAssignmentId(std::string(41, 'a')));
}
