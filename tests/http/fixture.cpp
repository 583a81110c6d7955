#include "fixture.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/store/memory_store.h"
#include "tests/support/paths.h"
#include "worker/tasks/check.h"
#include "worker/tasks/compare.h"
#include "worker/tasks/grade.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/mesh.h"
#include "worker/tasks/notice.h"
#include "worker/tasks/render.h"
#include "worker/tasks/turntable.h"
#include "worker/tasks/unpack.h"

namespace farol::test {

namespace {

using namespace worker;

render::Picture pictureOf(const std::string& bytes, const std::string& type) {
    render::Picture picture;
    picture.bytes = bytes;
    picture.contentType = type;
    return picture;
}

}  // namespace

FakeBackend::FakeBackend() {
    on<RenderTask>([this](const RenderTask::Request& request) {
        ++renders;
        if (onRender) return onRender(request.job);
        return pictureOf("picture of " + request.job.name,
                         image::contentType(request.job.options.format));
    });
    on<InspectTask>([this](const InspectTask::Request& request) {
        ++inspections;
        if (onInspect) return onInspect(request.job);
        render::SceneReport report;
        report.title = "Title of " + request.job.name;
        report.triangles = 12;
        report.models = 1;
        return report;
    });
    on<MeshTask>([](const MeshTask::Request& request) {
        std::string text;
        for (const std::string& word : request.words) text += word + " ";
        return text + request.format;
    });
    on<TurntableTask>([this](const TurntableTask::Request& request) {
        ++renders;
        return pictureOf(std::to_string(request.frames) + " pictures of " + request.job.name,
                         request.animation
                             ? std::string(farol::image::specOf(*request.animation).mime)
                             : "multipart/x-mixed-replace; boundary=f");
    });
    on<NoticeTask>([](const NoticeTask::Request& request) {
        return pictureOf("picture of: " + request.text, "image/png");
    });
    on<UnpackTask>([](const UnpackTask::Request& request) {
        const std::string document =
            "<world>" + std::to_string(request.archive.size()) + "</world>";
        return scene::Bundle{"scene.xml", {{"scene.xml", document}}};
    });
    on<GradeTask>([](const GradeTask::Request& request) {
        GradeTask::Reply reply;
        reply.json = "{\"points\":50,\"most\":100}";
        reply.pictures = {request.submission.picture.value_or(""),
                          request.reference.picture.value_or("")};
        return reply;
    });
    on<CompareTask>([](const CompareTask::Request& request) {
        return CompareTask::Reply{"{\"width\":1,\"height\":1}", request.first.picture.value_or(""),
                                  request.second.picture.value_or("")};
    });
    on<CheckTask>([this](const CheckTask::Request&) {
        if (onCheck) onCheck();
        return CheckTask::Reply{};
    });
}

Done<std::any> FakeBackend::submit(PackedJob job, const RunOptions&) {
    constexpr double kQueueMs = 0.5;
    Unpacker unpacker(job.bytes);
    std::string task;
    unpacker(task);
    return {tasks_.at(task)(unpacker), kQueueMs};
}

TestServer::TestServer(worker::Backend& backend, server::ServiceOptions options,
                       const server::http::ListenOptions& listen, server::Logger::Sink log)
    : logger_(std::move(log)),
      service_(withStore(std::move(options)), backend, logger_),
      listener_(listen, service_) {
    service_.watch([this] { return listener_.traffic(); });
    listener_.start();
}

TestServer::~TestServer() { stop(); }

server::http::ListenOptions TestServer::anywhere() {
    server::http::ListenOptions listen;
    listen.port = 0;
    listen.threads = 8;
    return listen;
}

server::ServiceOptions TestServer::withStore(server::ServiceOptions options) {
    constexpr std::uint64_t kBytes = std::uint64_t{128} << 20U;
    if (!options.store)
        options.store = std::make_shared<server::store::MemoryStore>(
            server::store::StoreLimits{kBytes, 10'000});
    if (!options.records) options.records = std::make_shared<server::store::MemoryRecords>(kBytes);
    return options;
}

void TestServer::drain() {
    service_.drain();
    listener_.drain();
}

void TestServer::stop() {
    drain();
    listener_.stop();
}

FakeServer::FakeServer(server::ServiceOptions service,
                       std::function<void(server::http::ListenOptions&)> tune) {
    server::http::ListenOptions listen = TestServer::anywhere();
    if (tune) tune(listen);
    server_ = std::make_unique<TestServer>(backend, std::move(service), listen,
                                           [this](const std::string& line) {
                                               const std::lock_guard lock(mutex_);
                                               log_.push_back(line);
                                           });
}

std::vector<std::string> FakeServer::log() const {
    const std::lock_guard lock(mutex_);
    return log_;
}

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_(std::string(farol::test::kTestOutput) + "/" + name + "-" + std::to_string(getpid())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void TemporaryFolder::write(const std::string& file, const std::string& content) const {
    const std::filesystem::path path = std::filesystem::path(path_) / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
}

}  // namespace farol::test
