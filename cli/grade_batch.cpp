#include "cli/grade_batch.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/files.h"
#include "grade/rubric.h"
#include "scene/digest.h"
#include "scene/words.h"

namespace farol::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A result's file: the grade on one line, then each picture after a line with its size.
std::string packed(const server::GradeReply& reply) {
    std::string out = reply.json + "\n";
    for (const std::string& picture : reply.pictures)
        out += std::to_string(picture.size()) + "\n" + picture;
    return out;
}

/// False where the bytes are not a whole result.
bool unpackInto(grade::TaskResult& task, const std::string& bytes) {
    std::size_t at = bytes.find('\n');
    task.json = bytes.substr(0, at);
    if (at == std::string::npos || !nlohmann::json::accept(task.json)) return false;
    while (++at < bytes.size()) {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string::npos) return false;
        const std::size_t size = std::strtoul(bytes.c_str() + at, nullptr, 10);
        if (size > bytes.size() - end - 1) return false;
        task.pictures.push_back(bytes.substr(end + 1, size));
        at = end + size;
    }
    return true;
}

/// True where an earlier run left the result: a machine that lost power may have left a part of it.
bool isWhole(const std::string& path) {
    grade::TaskResult kept;
    return std::filesystem::exists(path) && unpackInto(kept, readInput(path));
}

/// Asks again where the worker is lost or its memory full: that may be what earlier submissions
/// left in it, and the next worker is a fresh one. Who is late is not asked again.
server::GradeReply ask(server::Backend& backend, const server::GradeJob& job) {
    try {
        return backend.grade(job).result;
    } catch (const server::Busy& busy) {
        if (!busy.code().starts_with("worker.")) throw;
    } catch (const Error& error) {
        if (error.code() != "limit.memory") throw;
    }
    return backend.grade(job).result;
}

std::string digestOf(const grade::Subject& subject) {
    std::string all = subject.job.name + "\n" + scene::contentDigest(subject.job.xml) +
                      scene::contentDigest(subject.job.archive) +
                      scene::contentDigest(subject.picture);
    if (subject.job.assets)
        for (const std::string& path : subject.job.assets->list())
            all += "\n" + path + "\n" + subject.job.assets->version(path);
    return scene::contentDigest(all);
}

}  // namespace

struct Batch::Task {
    grade::Subject reference;
    std::string digest;
    std::vector<std::string> pictures;
};

Batch::Batch(server::Backend& backend, std::vector<Submission> submissions,
             std::vector<GradeTask> tasks, BatchOptions options)
    : backend_(backend),
      submissions_(std::move(submissions)),
      names_(std::move(tasks)),
      options_(std::move(options)),
      entries_(submissions_.size() * names_.size()) {
    const grade::Rubric rubric = grade::readRubric(options_.rubric, "rubric");
    most_ = rubric.points;
    passMark_ = rubric.passMark;
}

std::string Batch::keyOf(const grade::Subject& subject, const Task& task) const {
    return scene::contentDigest(digestOf(subject) + subject.task + task.digest + options_.rubric +
                                backend_.version());
}

BatchTimes Batch::run() {
    const auto begin = Clock::now();
    std::vector<std::filesystem::path> apart = {
        std::filesystem::path(options_.resultsDir).parent_path()};
    if (!submissions_.empty())  // all lie in one folder
        apart.push_back(std::filesystem::path(submissions_.front().path).parent_path());
    for (const GradeTask& one : names_) {
        auto task = std::make_shared<Task>();
        task->reference = readReference(one.path, apart);
        task->digest = digestOf(task->reference);
        // Asked for first: a reference that is at fault ends the run before it begins.
        server::GradeJob job;
        job.reference = task->reference;
        job.rubric = options_.rubric;
        task->pictures = backend_.grade(job).result.pictures;
        tasks_.push_back(std::move(task));
    }
    std::atomic<std::size_t> next{0}, done{0};
    std::vector<std::thread> threads;
    // One more than workers, so that each finds its next job waiting.
    for (int i = 0; i <= options_.jobs; ++i)
        threads.emplace_back([&] {
            for (std::size_t at = next++; at < entries_.size() && !failed(); at = next++) {
                gradeOne(at / names_.size(), at % names_.size());
                const std::size_t count = ++done;
                if (options_.progress) options_.progress(count, entries_.size());
            }
        });
    for (std::thread& thread : threads) thread.join();
    if (fault_) std::rethrow_exception(fault_);
    times_.wallMs = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    return times_;
}

bool Batch::failed() {
    const std::lock_guard lock(mutex_);
    return fault_ != nullptr;
}

void Batch::gradeOne(std::size_t submission, std::size_t task) {
    Entry& entry = entries_[submission * names_.size() + task];
    try {
        server::GradeJob job;
        job.submission = readSubject(submissions_[submission].path, names_[task].name);
        job.reference = tasks_[task]->reference;
        job.rubric = options_.rubric;
        const std::string file =
            options_.resultsDir + "/" + keyOf(job.submission, *tasks_[task]) + ".grade";
        if (isWhole(file)) {
            entry.file = file;
            const std::lock_guard lock(mutex_);
            ++times_.kept;
            return;
        }
        const server::GradeReply reply = ask(backend_, job);
        writeOutput(file, packed(reply));
        entry.file = file;
        const std::lock_guard lock(mutex_);
        ++times_.graded;
        times_.readMs += reply.readMs;
        times_.drawMs += reply.drawMs;
        times_.compareMs += reply.compareMs;
    } catch (const Error& error) {
        entry.code = error.code();
        entry.failure = error.what();
    } catch (const server::Busy& busy) {
        entry.code = busy.code();
        entry.failure = busy.code() == "busy.deadline"
                            ? "The submission took too long and was ended."
                            : "The submission ended the process that graded it.";
    } catch (const OutputError&) {
        // The run cannot go on, and another thread may not throw.
        const std::lock_guard lock(mutex_);
        fault_ = std::current_exception();
    } catch (const std::exception& fault) {
        entry.code = "internal";
        entry.failure = scene::shown(fault.what());
    }
}

grade::SubmissionResult Batch::load(std::size_t submission) const {
    const Submission& who = submissions_[submission];
    grade::SubmissionResult out;
    out.id = who.id;
    out.name = who.name;
    out.number = who.number;
    out.most = most_;
    for (std::size_t t = 0; t < names_.size(); ++t) {
        const Entry& entry = entries_[submission * names_.size() + t];
        grade::TaskResult task;
        task.task = names_[t].name;
        task.code = entry.code;
        task.failure = entry.failure;
        if (!entry.file.empty()) {
            unpackInto(task, readInput(entry.file));
            out.points += nlohmann::json::parse(task.json).value("points", 0.0);
        }
        out.tasks.push_back(std::move(task));
    }
    out.points = std::round(100.0 * out.points / static_cast<double>(names_.size())) / 100.0;
    out.passed = out.points >= most_ * passMark_ / 100.0;
    return out;
}

grade::ClassResult Batch::result(const std::string& title) const {
    grade::ClassResult all;
    all.title = title;
    all.count = submissions_.size();
    all.at = [this](std::size_t i) { return load(i); };
    for (const GradeTask& one : names_) all.tasks.push_back(one.name);
    for (const auto& task : tasks_) all.references.push_back(task->pictures);
    all.rubric = options_.rubric;
    return all;
}

}  // namespace farol::cli
