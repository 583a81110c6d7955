// A worker's reply is held against what was asked: one that does not fit ends the worker.
#include <unistd.h>

#include <fstream>

#include "fake.h"
#include "worker/tasks/grade.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/turntable.h"
#include "worker/tasks/unpack.h"

using namespace farol;
using namespace farol::worker;
using namespace farol::test;

namespace {

/// Lets the largest memory so far begin anew. False where the kernel cannot.
bool resetPeak() {
    std::ofstream out("/proc/self/clear_refs");
    out << "5" << std::flush;
    return static_cast<bool>(out);
}

/// The largest memory since then, MiB.
long peakMiB() {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("VmHWM:", 0) == 0) return std::stol(line.substr(6)) / 1024;
    return -1;
}

}  // namespace

TEST_CASE("a reply that does not fit the request ends the worker, and no other request notices") {
    WorkerPool pool(fakeOptions(), noLog());
    const std::string deed =
        GENERATE("large image", "html", "wide image", "time", "many diagnostics", "code",
                 "other reply", "image and more", "done and refused", "many elements",
                 "unauthorized", "quarantine", "empty refusal", "refusal and image", "cut off",
                 "longer", "flood", "endless", "grade", "report");
    INFO(deed);
    CHECK(renderCode(pool, deed) == "worker.reply");
    CHECK(restarts(pool, "reply") == 1);
    CHECK(renderCode(pool, "image") == "done");
    CHECK(renderCode(pool, "refusal") == "scene.empty");
    CHECK(restarts(pool, "reply") == 1);
}

TEST_CASE("a grade, a report and unpacked files are held against their bounds") {
    WorkerPool pool(fakeOptions(), noLog());
    const auto gradeCode = [&](const std::string& deed) {
        GradeTask::Request request;
        request.submission.job = jobOf(deed);
        return codeOf([&] { pool.run<GradeTask>(request); });
    };
    CHECK(gradeCode("grade") == "done");
    for (const char* deed : {"deep grade", "list grade", "no grade", "image"})
        CHECK(gradeCode(deed) == "worker.reply");
    CHECK(codeOf([&] { pool.run<InspectTask>({jobOf("report")}); }) == "done");
    CHECK(codeOf([&] { pool.run<InspectTask>({jobOf("image")}); }) == "worker.reply");
    CHECK(codeOf([&] { pool.run<UnpackTask>({"bundle\n"}); }) == "done");
    for (const char* deed : {"outside\n", "no scene\n", "report\n"})
        CHECK(codeOf([&] { pool.run<UnpackTask>({deed}); }) == "worker.reply");
    CHECK(restarts(pool, "reply") == 8);
}

TEST_CASE("600 MiB in the place of an image of 32 x 32 px take no memory") {
    WorkerPool pool(fakeOptions(), noLog());
    REQUIRE(renderCode(pool, "image") == "done");
    REQUIRE(resetPeak());
    const long before = peakMiB();
    CHECK(renderCode(pool, "flood") == "worker.reply");
    CHECK(renderCode(pool, "many elements") == "worker.reply");
    CHECK(peakMiB() <= before + 16);
}

TEST_CASE("bounds of a reply follow from the size and the format that were asked for") {
    RenderTask::Request request;
    request.job.options.width = 100;
    request.job.options.height = 50;
    const ImageBounds small = RenderTask::boundsOf(request);
    CHECK(small.maxWidth == 100);
    CHECK(small.maxHeight == 50);
    CHECK(small.imageBytes == maxImageBytes(image::Format::png, 5'000));
    CHECK(small.imageBytes >= 4 * 5'000);
    CHECK(small.bytes < 5'000'000);
    request.job.options.height.reset();  // the scene's own, at most the largest
    CHECK(RenderTask::boundsOf(request).imageBytes ==
          maxImageBytes(image::Format::png, 100 * render::kMaxSide));
    request.job.options.width.reset();
    CHECK(RenderTask::boundsOf(request).imageBytes ==
          maxImageBytes(image::Format::png, render::kMaxPixels));
    TurntableTask::Request turn;
    turn.frames = 3;
    turn.job.options.width = turn.job.options.height = 10;
    CHECK(TurntableTask::boundsOf(turn).imageBytes == 3 * maxImageBytes(image::Format::png, 100));
    CHECK(UnpackTask::boundsOf({std::string(1'000, 'x')}).fileBytes == std::uint64_t{4} << 20U);
}
