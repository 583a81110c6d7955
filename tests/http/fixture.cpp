#include "fixture.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace farol::test {

server::Done<render::Picture> FakeBackend::render(const render::Job& job, const std::string&,
                                                  const server::Turn&) {
    ++renders;
    if (onRender) return {onRender(job), 0.5};
    render::Picture picture;
    picture.bytes = "picture of " + job.name;
    static constexpr const char* kTypes[] = {"image/png", "image/jpeg", "image/webp"};
    picture.contentType = kTypes[static_cast<std::size_t>(job.options.format)];
    return {picture, 0.5};
}

server::Done<render::SceneReport> FakeBackend::inspect(const render::Job& job) {
    ++inspections;
    if (onInspect) return {onInspect(job), 0.0};
    render::SceneReport report;
    report.title = "Title of " + job.name;
    report.triangles = 12;
    report.models = 1;
    return {report, 0.0};
}

server::Done<std::string> FakeBackend::mesh(const server::MeshJob& job) {
    std::string text;
    for (const std::string& word : job.words) text += word + " ";
    return {text + job.format, 0.0};
}

server::Done<render::Picture> FakeBackend::turntable(const render::Job& job,
                                                     const server::Turntable& turn) {
    ++renders;
    render::Picture picture;
    picture.bytes = std::to_string(turn.frames) + " pictures of " + job.name;
    picture.contentType = turn.apng ? "image/apng" : "multipart/x-mixed-replace; boundary=f";
    return {picture, 0.0};
}

server::Done<render::Picture> FakeBackend::notice(const std::string& text,
                                                  const render::PictureOptions&) {
    render::Picture picture;
    picture.bytes = "picture of: " + text;
    picture.contentType = "image/png";
    return {picture, 0.0};
}

server::Done<scene::Bundle> FakeBackend::unpack(const std::string& archive) {
    const std::string document = "<world>" + std::to_string(archive.size()) + "</world>";
    return {scene::Bundle{"scene.xml", {{"scene.xml", document}}}, 0.0};
}

server::Done<server::GradeReply> FakeBackend::grade(const server::GradeJob& job) {
    server::GradeReply reply;
    reply.json = "{\"points\":50,\"most\":100}";
    reply.points = 50;
    reply.most = 100;
    reply.pictures = {job.submission.picture, job.reference.picture};
    return {reply, 0.0};
}

server::Done<server::CompareReply> FakeBackend::compare(const server::CompareJob& job) {
    return {{"{\"width\":1,\"height\":1}", job.first.picture, job.second.picture}, 0.0};
}

void FakeBackend::check() {
    if (onCheck) onCheck();
}

FakeServer::FakeServer(server::ServiceOptions service,
                       std::function<void(server::http::ListenOptions&)> tune) {
    server::http::ListenOptions listen;
    listen.port = 0;
    listen.threads = 8;
    if (tune) tune(listen);
    server_ = std::make_unique<server::Server>(listen, std::move(service), backend,
                                               [this](const std::string& line) {
                                                   const std::lock_guard lock(mutex_);
                                                   log_.push_back(line);
                                               });
    server_->start();
}

std::vector<std::string> FakeServer::log() const {
    const std::lock_guard lock(mutex_);
    return log_;
}

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_(std::string(FAROL_TEST_OUTPUT) + "/" + name + "-" + std::to_string(getpid())) {
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
