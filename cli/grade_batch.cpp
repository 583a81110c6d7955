#include "cli/grade_batch.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/files.h"
#include "cli/messages.h"
#include "core/digest.h"
#include "core/number.h"
#include "core/text.h"
#include "grade/rubric/grader.h"
#include "grade/rubric/rubric.h"

namespace farol::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A result's file: the grade on one line, then each picture after a line with its size.
std::string packed(const worker::GradeTask::Reply& reply) {
    std::string out = reply.json + "\n";
    for (const std::string& picture : reply.pictures)
        out += std::to_string(picture.size()) + "\n" + picture;
    return out;
}

/// Whether the text is a grade: an object with its points.
bool isGrade(const std::string& text) {
    try {
        const nlohmann::json document = parseJson(text, grade::kGradeJson);
        return document.is_object() && document.contains("points") &&
               document["points"].is_number();
    } catch (const JsonError&) {
        return false;
    }
}

/// False where the bytes are not a whole result.
bool unpackInto(grade::TaskGrade& task, const std::string& bytes) {
    std::size_t at = bytes.find('\n');
    task.json = bytes.substr(0, at);
    if (at == std::string::npos || !isGrade(task.json)) return false;
    while (++at < bytes.size()) {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string::npos) return false;
        const auto size = parseExact<std::size_t>(std::string_view(bytes).substr(at, end - at));
        if (!size || *size > bytes.size() - end - 1) return false;
        task.pictures.push_back(bytes.substr(end + 1, *size));
        at = end + *size;
    }
    return true;
}

/// True where an earlier run left the result: a machine that lost power may have left a part of it.
bool isWholeInto(grade::TaskGrade& task, const std::string& path) {
    std::error_code failed;
    return std::filesystem::is_regular_file(path, failed) && unpackInto(task, readInput(path));
}

/// Retries once if the worker is lost or out of memory: earlier submissions may be the cause, and
/// the next worker is a new process. Does not retry after a timeout.
template <worker::Task T>
typename T::Reply ask(worker::Backend& backend, const typename T::Request& request) {
    try {
        return backend.run<T>(request).result;
    } catch (const worker::Busy& busy) {
        if (!busy.code().starts_with("worker.")) throw;
    } catch (const Error& error) {
        if (error.code() != "limit.memory") throw;
    }
    return backend.run<T>(request).result;
}

/// The images of a reference, JPEG. Throws Error, also where it ends its workers.
std::vector<std::string> askForReference(worker::Backend& backend,
                                         const worker::ReferenceTask::Request& request,
                                         const std::string& path) {
    try {
        return ask<worker::ReferenceTask>(backend, request).pictures;
    } catch (const worker::Busy& busy) {
        throw Error(busy.code() == "busy.deadline"
                        ? message<"grade.reference/deadline">()
                        : message<"grade.reference/process">("code"_arg = busy.code()),
                    {path, 0, 0});
    }
}

/// Returns TaskResult::document.
std::string documentOf(const Submission& submission, const grade::Subject& subject) {
    if (submission.archive || !submission.parts.empty() || !subject.job.archive.empty()) return "";
    std::error_code failed;
    const std::filesystem::path path(submission.path);
    if (!std::filesystem::is_directory(path, failed)) return submission.path;
    return subject.job.path.empty() ? "" : (path / subject.job.path).lexically_normal().string();
}

std::string digestOf(const grade::Subject& subject) {
    std::string all = subject.job.name + "\n" + subject.job.path + "\n" +
                      contentDigest(subject.job.xml) + contentDigest(subject.job.archive) +
                      contentDigest(subject.picture.value_or(""));
    if (subject.job.assets)
        for (const std::string& path : subject.job.assets->list())
            all += "\n" + path + "\n" + subject.job.assets->version(path);
    return contentDigest(all);
}

}  // namespace

struct Batch::Task {
    grade::Subject reference;
    grade::Wanted wanted;
    std::string digest;
    worker::PackedRubric rubric;
    std::vector<std::string> pictures;
};

Batch::Batch(worker::Backend& backend, std::vector<Submission> submissions,
             std::vector<GradeTask> tasks, BatchOptions options)
    : backend_(backend),
      submissions_(std::move(submissions)),
      names_(std::move(tasks)),
      options_(std::move(options)),
      entries_(submissions_.size() * names_.size()) {}

std::string Batch::keyOf(const grade::Subject& subject, const Task& task) const {
    return contentDigest(digestOf(subject) + task.wanted.task + task.digest + task.rubric.json +
                         std::string(render::kMissingWords[options_.missing]) +
                         std::string(kLanguageWords[options_.language]) + backend_.version());
}

BatchTimes Batch::run() {
    const auto begin = Clock::now();
    std::vector<std::filesystem::path> apart = {
        std::filesystem::path(options_.resultsDir).parent_path()};
    if (!submissions_.empty())  // all lie in one folder
        apart.push_back(std::filesystem::path(submissions_.front().path).parent_path());
    for (const GradeTask& one : names_) {
        auto task = std::make_shared<Task>();
        task->rubric = worker::packRubric(options_.rubrics[tasks_.size()]);
        if (!one.path.empty()) task->reference = readReference(one.path, apart);
        task->digest = digestOf(task->reference);
        task->wanted = {one.name, {}, grade::filesNamedIn(task->reference.job.xml), true};
        task->wanted.isScene = grade::needsScene(options_.rubrics[tasks_.size()]);
        for (const GradeTask& other : names_)
            if (other.name != one.name) task->wanted.others.push_back(other.name);
        // Asked for first: a reference that is at fault ends the run before it begins.
        if (!one.path.empty())
            task->pictures = askForReference(backend_, {task->reference, task->rubric}, one.path);
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
        worker::GradeTask::Request job;
        job.submission = readSubmission(submissions_[submission], tasks_[task]->wanted);
        entry.document = documentOf(submissions_[submission], job.submission);
        job.submission.job.options.missing = options_.missing;
        job.reference = tasks_[task]->reference;
        job.rubric = tasks_[task]->rubric;
        job.language = options_.language;
        const std::string file =
            options_.resultsDir + "/" + keyOf(job.submission, *tasks_[task]) + ".grade";
        if (grade::TaskGrade kept; isWholeInto(kept, file)) {
            entry.file = file;
            const std::lock_guard lock(mutex_);
            ++times_.kept;
            return;
        }
        const worker::GradeTask::Reply reply = ask<worker::GradeTask>(backend_, job);
        if (!isGrade(reply.json)) throw std::runtime_error("a worker sent no grade");
        writeOutput(file, packed(reply));
        entry.file = file;
        const std::lock_guard lock(mutex_);
        ++times_.graded;
        times_.readMs += reply.readMs;
        times_.drawMs += reply.drawMs;
        times_.compareMs += reply.compareMs;
    } catch (const Error& error) {
        entry.code = error.code();
        entry.failure = toUtf8(textIn(options_.language, error.primary()));
    } catch (const worker::Busy& busy) {
        entry.code = busy.code();
        entry.failure = textIn(options_.language, busy.code() == "busy.deadline"
                                                      ? message<"part.failure/late">()
                                                      : message<"part.failure/ended">());
    } catch (const OutputError&) {
        // The run cannot go on, and another thread may not throw.
        const std::lock_guard lock(mutex_);
        fault_ = std::current_exception();
    } catch (const std::exception& fault) {
        entry.code = "internal";
        entry.failure = shown(fault.what());
    }
}

grade::TaskResult Batch::loadTask(std::size_t submission, std::size_t task) const {
    const Submission& who = submissions_[submission];
    const Entry& entry = entries_[submission * names_.size() + task];
    // Messages and excerpts must not show the student's name either.
    const auto shownAs = [&](const std::string& text) {
        return options_.pseudonyms ? withoutName(text, who, options_.pseudonyms->of(who)) : text;
    };
    grade::TaskResult out;
    out.task = names_[task].name;
    if (!options_.pseudonyms) out.document = entry.document;
    if (grade::TaskGrade kept; entry.file.empty()) {
        out.result = grade::TaskFailure{entry.code, shownAs(entry.failure)};
    } else if (isWholeInto(kept, entry.file)) {
        kept.json = shownAs(kept.json);
        out.result = std::move(kept);
    } else {
        out.result = grade::TaskFailure{"grade.lost",
                                        textIn(options_.language, message<"part.failure/lost">())};
    }
    return out;
}

grade::SubmissionResult Batch::load(std::size_t submission) const {
    const Submission& who = submissions_[submission];
    const grade::Rubric& main = options_.rubrics.front();
    grade::SubmissionResult out;
    out.id = who.id;
    out.name = who.name;
    out.number = who.number;
    out.most = main.points;
    out.graded = false;
    double share = 0.0, weights = 0.0;
    for (std::size_t t = 0; t < names_.size(); ++t) {
        const grade::Rubric& rubric = options_.rubrics[t];
        grade::TaskResult task = loadTask(submission, t);
        options_.overrides.applyToTask(task, out, rubric.points, rubric.passMark);
        weights += rubric.weight;
        if (task.grade() != nullptr) {
            const nlohmann::json grade = parseJson(task.grade()->json, grade::kGradeJson);
            share += rubric.weight * grade.value("points", 0.0) / rubric.points;
            out.graded = out.graded || !grade.value("refused", false);
        }
        out.tasks.push_back(std::move(task));
    }
    if (weights > 0.0) out.points = std::round(100.0 * main.points * share / weights) / 100.0;
    out.passed = out.graded && out.points >= main.points * main.passMark / 100.0;
    options_.overrides.applyToTotal(out, main.passMark);
    if (options_.pseudonyms) {
        out.id = options_.pseudonyms->of(who);
        out.name = out.id;
        out.number.clear();
    }
    return out;
}

grade::ClassResult Batch::result() const {
    grade::ClassResult all;
    all.title = options_.rubrics.front().title;
    all.count = submissions_.size();
    all.at = [this](std::size_t i) { return load(i); };
    for (const GradeTask& one : names_) all.tasks.push_back(one.name);
    for (const auto& task : tasks_) all.references.push_back(task->pictures);
    all.rubric = tasks_.front()->rubric.json;
    all.language = options_.language;
    if (!options_.pseudonyms) all.groups = options_.groups;
    return all;
}

}  // namespace farol::cli
