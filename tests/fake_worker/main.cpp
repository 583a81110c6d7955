// A worker that does what the scene of its request names instead of drawing it: what a process can
// do that a hostile file has taken over.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>

#include "worker/channel.h"
#include "worker/hello.h"
#include "worker/job.h"
#include "worker/sandbox.h"
#include "worker/tasks/grade.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/render.h"
#include "worker/tasks/unpack.h"

using namespace farol;
using namespace farol::worker;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20U;
const std::string kPng = "\x89PNG\r\n\x1a\n";

render::Picture image() {
    render::Picture picture;
    picture.bytes = kPng + "pixels";
    picture.width = picture.height = 32;
    return picture;
}

std::string done(const auto& reply) { return pack(AnswerHead{}, reply); }

std::string picture(const std::function<void(render::Picture&)>& change) {
    render::Picture made = image();
    change(made);
    return done(made);
}

std::string refusal(const std::string& code) {
    AnswerHead head{Outcome::refused, {}, {}};
    if (!code.empty()) head.diagnostics = {{Severity::error, code, {}, "message", ""}};
    return pack(head);
}

std::string grade(const std::string& json) {
    GradeTask::Reply reply;
    reply.json = json;
    return done(reply);
}

std::string nested(const std::string& before, std::size_t depth) {
    return before + std::string(depth, '[') + std::string(depth, ']') + "}";
}

/// A report of so many elements.
std::string report(std::size_t elements) {
    render::SceneReport made;
    made.elements.resize(elements);
    return done(made);
}

std::string bundle(const scene::Bundle& files) { return done(files); }

std::string replyTo(const std::string& deed) {
    using Picture = render::Picture;
    if (deed == "large image") return picture([](Picture& it) { it.bytes.resize(kMiB, 'x'); });
    if (deed == "html") return picture([](Picture& it) { it.bytes = "<script>alert(1)</script>"; });
    if (deed == "wide image") return picture([](Picture& it) { it.width = 33; });
    if (deed == "time")
        return picture(
            [](Picture& it) { it.times.drawMs = std::numeric_limits<double>::quiet_NaN(); });
    if (deed == "many diagnostics")
        return picture([](Picture& it) { it.diagnostics.resize(20'000); });
    if (deed == "code")
        return picture([](Picture& it) {
            it.diagnostics = {{Severity::info, "a\r\nb: c", {}, "", ""}};
        });
    if (deed == "other reply") return done(std::string("v 0 0 0"));
    if (deed == "image and more") return done(image()) + done(image());
    if (deed == "done and refused") {
        AnswerHead head;
        head.diagnostics = {{Severity::error, "scene.empty", {}, "message", ""}};
        return pack(head, image());
    }
    if (deed == "many elements") return report(20'000);
    if (deed == "refusal") return refusal("scene.empty");
    if (deed == "unauthorized") return refusal("http.unauthorized");
    if (deed == "quarantine") return refusal("worker.quarantine");
    if (deed == "empty refusal") return refusal("");
    if (deed == "refusal and image") return refusal("scene.empty") + pack(image());
    if (deed == "memory") return pack(AnswerHead{Outcome::memory, {}, {}});
    if (deed == "report") return report(0);
    if (deed == "grade") return grade(R"({"points": 1, "views": []})");
    if (deed == "deep grade") return grade(nested(R"({"a":)", 100'000));
    if (deed == "list grade") return grade("[1]");
    if (deed == "no grade") return grade("");
    if (deed == "bundle") return bundle({"scene.xml", {{"scene.xml", "<world/>"}}});
    if (deed == "outside") return bundle({"a", {{"a", ""}, {"../b", ""}}});
    if (deed == "no scene") return bundle({"a", {{"b", ""}}});
    return done(image());
}

/// The file that the document of the job, or its archive, names.
std::string deedOf(std::string_view message) {
    Unpacker unpacker(message);
    std::string task;
    unpacker(task);
    const auto request = [&]<typename T>(T made) {
        unpacker(made);
        return made;
    };
    if (task == UnpackTask::kName) return request(UnpackTask::Request{}).archive;
    if (task == GradeTask::kName) return request(GradeTask::Request{}).submission.job.xml;
    return request(RenderTask::Request{}).job.xml;  // a report's has the same members
}

void spin() {
    for (std::atomic<std::uint64_t> i{0};;) ++i;
}

/// The length of a message and its bytes, as many as anybody takes.
void flood(std::uint64_t length) {
    const std::string block(kMiB, 'x');
    if (write(kSocket, &length, sizeof length) != sizeof length) return;
    while (write(kSocket, block.data(), block.size()) > 0) {
    }
}

}  // namespace

int main() {
    Channel channel(kSocket);
    constexpr auto kNever = Clock::time_point::max();
    Hello hello;
    hello.gl = "none";
    if (channel.send(pack(hello), kNever) != Channel::Result::done) return 1;
    std::string message;
    while (channel.receive(message, kNever) == Channel::Result::done) {
        std::string deed = deedOf(message);
        if (const std::size_t end = deed.find('\n'); end != std::string::npos) deed.resize(end);
        if (deed == "spin") spin();
        if (deed == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
        if (deed == "abort") abort();
        if (deed == "leave") return 0;
        if (deed == "flood") flood(600 * kMiB);
        if (deed == "endless") flood(std::uint64_t{1} << 63U);
        std::string reply = replyTo(deed);
        if (deed == "cut off") reply.resize(reply.size() / 2);
        if (deed == "longer") reply += "more";
        if (channel.send(reply, kNever) != Channel::Result::done) return 1;
    }
    return 0;
}
