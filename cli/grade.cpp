#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/grade_batch.h"
#include "cli/grade_formats.h"
#include "cli/grade_tables.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "grade/rubric/rubric.h"
#include "worker/pool.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string reference, submissions, output, rubric, missing = "placeholder";
    std::string overrides, groups, anonymous, agreement;
    std::vector<std::string> formats;
    bool isSingle = false;
    bool hasFeedback = false;
    int jobs = 0;
    render::GlSource gl = render::GlSource::automatic;
    double deadlineS = 60.0;
    std::size_t memoryMiB = 1024;
    bool printRubric = false;
};

worker::PoolOptions poolOptions(const Flags& flags) {
    worker::PoolOptions pool;
    pool.workers = flags.jobs > 0
                       ? flags.jobs
                       : std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 64);
    pool.worker.gl = flags.gl;
    pool.worker.memoryBytes = flags.memoryMiB << 20U;
    pool.queue.waiting = pool.workers + 8;
    pool.queue.wait = std::chrono::hours(24);
    pool.queue.deadline =
        std::chrono::milliseconds(static_cast<std::int64_t>(flags.deadlineS * 1000.0));
    // One user's own machine: the deadline alone bounds a job on many cores.
    pool.cpu = std::chrono::hours(24);
    return pool;
}

/// Replaces control characters: a name cannot write to the terminal.
std::string printable(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, '?');
    return name;
}

void printTable(const grade::ClassResult& all, const BatchTimes& times, int jobs) {
    std::size_t passed = 0;
    for (std::size_t i = 0; i < all.count; ++i) {
        const grade::SubmissionResult one = all.at(i);
        passed += one.passed ? 1 : 0;
        if (one.graded)
            std::printf("%8.2f / %.0f  %s  %s\n", one.points, one.most,
                        one.passed ? "pass" : "FAIL", printable(one.id).c_str());
        else
            std::printf("%8s / %.0f  none  %s\n", "-", one.most, printable(one.id).c_str());
    }
    std::printf("%zu of %zu passed\n", passed, all.count);
    const double each = static_cast<double>(std::max<std::size_t>(1, times.graded));
    std::fprintf(
        stderr,
        "graded %zu (%zu kept from before) in %.1f s with %d workers: %.1f a second; "
        "each read %.1f ms, drawn %.1f ms, compared %.1f ms\n",
        times.graded, times.kept, times.wallMs / 1000.0, jobs,
        static_cast<double>(times.graded + times.kept) * 1000.0 / std::max(1.0, times.wallMs),
        times.readMs / each, times.drawMs / each, times.compareMs / each);
}

/// Says the figures on stdout, and warns of rows that name nobody.
void printAgreement(const grade::Agreement& agreement, const std::string& file, Report& report) {
    for (const int line : agreement.unusedLines)
        report.add(
            {diagnosticOf(Severity::warning, message<"grade.override-unused">(), {file, line, 0})});
    if (report.json()) {
        const auto number = [](const std::optional<double>& value) {
            return value ? nlohmann::json(*value) : nlohmann::json();
        };
        report.set("agreement", {{"submissions", agreement.submissions.size()},
                                 {"alpha", number(agreement.alpha)},
                                 {"tauB", number(agreement.tauB)},
                                 {"meanDifference", agreement.meanDifference}});
        return;
    }
    const auto text = [&](const std::optional<double>& value) {
        if (!value) return textIn(report.language(), message<"part.agreement/undefined">());
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.3f", *value);
        return std::string(digits);
    };
    char difference[32];
    std::snprintf(difference, sizeof difference, "%.2f", agreement.meanDifference);
    std::printf("%s\n", textIn(report.language(),
                               message<"part.agreement/summary">(
                                   "count"_arg = agreement.submissions.size(),
                                   "alpha"_arg = text(agreement.alpha),
                                   "tau"_arg = text(agreement.tauB), "difference"_arg = difference))
                            .c_str());
}

/// Reads the teacher's tables beside the class; returns the file name of the overrides.
std::string readTables(const Flags& flags, const std::vector<Submission>& submissions,
                       BatchOptions& options) {
    std::string overrides = flags.overrides, groups = flags.groups;
    const std::string marks = readTable(overrides, flags.output + "/overrides.csv");
    if (!overrides.empty()) options.overrides = {marks, overrides};
    const std::string members = readTable(groups, flags.output + "/groups.csv");
    if (!groups.empty()) options.groups = {members, groups};
    if (flags.anonymous.empty()) return overrides;
    std::error_code failed;
    const auto isIn = std::filesystem::weakly_canonical(folderOf(flags.anonymous), failed);
    if (isIn == std::filesystem::weakly_canonical(flags.output, failed))
        throw UsageError(message<"usage/anonymous">("path"_arg = uncut(flags.anonymous)));
    options.pseudonyms.emplace(flags.anonymous, submissions);
    return overrides;
}

/// The tasks of the reference; without one, one task that the rubric's requirements describe.
std::vector<GradeTask> readTasks(const Flags& flags, BatchOptions& options) {
    if (!flags.reference.empty()) {
        std::vector<GradeTask> tasks = findTasks(flags.reference);
        options.rubrics = readRubrics(flags.rubric, tasks);
        for (const grade::Rubric& rubric : options.rubrics)
            if (grade::comparedPoints(rubric) <= 0.0)
                throw UsageError(message<"usage/grade-needless">());
        return tasks;
    }
    std::vector<GradeTask> tasks{{"", ""}};
    options.rubrics = readRubrics(flags.rubric, tasks);
    const double compared = grade::comparedPoints(options.rubrics.front());
    if (compared > 0.0)
        throw UsageError(
            message<"usage/grade-reference">("points"_arg = std::round(100.0 * compared) / 100.0));
    return tasks;
}

int run(const Flags& flags, Report& report) {
    if (flags.printRubric) {
        std::cout << grade::writeRubric(grade::defaultRubric()) << std::flush;
        return kDone;
    }
    const bool hasTask = !flags.reference.empty() || !flags.rubric.empty();
    if (!hasTask || flags.submissions.empty() || flags.output.empty())
        throw UsageError(message<"usage/grade">());
    const std::vector<const grade::Format*> formats = chooseFormats(flags.formats);
    std::vector<grade::PersonMark> marks;
    if (!flags.agreement.empty())
        marks = grade::readPersonMarks(readInput(flags.agreement), flags.agreement);
    BatchOptions options;
    render::PictureOptions picture;
    render::applyOption(picture, "missing", flags.missing);
    options.missing = picture.missing;
    options.language = report.language();
    std::vector<GradeTask> tasks = readTasks(flags, options);
    std::vector<Submission> submissions = flags.isSingle
                                              ? std::vector{oneSubmission(flags.submissions)}
                                              : findSubmissions(flags.submissions);
    const std::string overridesFile = readTables(flags, submissions, options);
    options.resultsDir = flags.output + "/results";
    std::error_code failed;
    std::filesystem::create_directories(options.resultsDir, failed);
    if (failed)
        throw OutputError(message<"output.unwritable/folder">(
            "path"_arg = uncut(options.resultsDir), "reason"_arg = failed.message()));
    Progress progress("grading");
    options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };

    std::signal(SIGPIPE, SIG_IGN);  // a worker that dies while it is spoken to
    const worker::PoolOptions poolSettings = poolOptions(flags);
    options.jobs = poolSettings.workers;
    const worker::EventLog quiet = [](const std::string&, const std::string&) {};
    worker::WorkerPool pool(poolSettings, quiet);
    Batch batch(pool, std::move(submissions), std::move(tasks), options);
    const BatchTimes times = batch.run();
    for (const auto& [layer, state] : pool.facts().sandbox)
        if (state.starts_with("missing"))
            std::fprintf(stderr, "sandbox.%s=\"%s\"\n", layer.c_str(), state.c_str());
    const grade::ClassResult all = batch.result();
    writeFormats(flags.output, formats, all, flags.isSingle);
    if (!marks.empty())
        printAgreement(writeAgreement(flags.output, all, marks, flags.agreement), flags.agreement,
                       report);
    if (flags.hasFeedback) writeFeedback(flags.output + "/feedback.zip", all);
    if (!options.pseudonyms)
        for (const int line : options.overrides.unused(all))
            report.add({diagnosticOf(Severity::warning, message<"grade.override-unused">(),
                                     {overridesFile, line, 0})});
    if (!report.json()) {
        printTable(all, times, poolSettings.workers);
        return kDone;
    }
    nlohmann::json list = nlohmann::json::array();
    for (std::size_t i = 0; i < all.count; ++i) {
        const grade::SubmissionResult one = all.at(i);
        list.push_back({{"id", one.id},
                        {"name", one.name},
                        {"points", one.points},
                        {"most", one.most},
                        {"passed", one.passed},
                        {"graded", one.graded}});
    }
    report.set("submissions", std::move(list));
    report.set("timesMs", {{"read", times.readMs},
                           {"draw", times.drawMs},
                           {"compare", times.compareMs},
                           {"wall", times.wallMs}});
    report.set("graded", times.graded);
    report.set("kept", times.kept);
    return kDone;
}

}  // namespace

void addGrade(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand(
        "grade", "Grades a class's scenes by a reference, or by a rubric's requirements");
    const auto flags = std::make_shared<Flags>();
    command
        ->add_option("SUBMISSIONS", flags->submissions,
                     "folder with an entry for each student, or the .zip of the class")
        ->type_name("");
    command
        ->add_option("--reference", flags->reference,
                     "a scene, an image, or a folder of them: a task each, found by its name; none "
                     "where the rubric has requirements alone")
        ->type_name("REF");
    command->add_option("-o,--output", flags->output, "folder for the reports; a run goes on in it")
        ->type_name("DIR");
    command
        ->add_option("--rubric", flags->rubric,
                     "a .json file, or a folder with TASK.json; default: --print-rubric")
        ->type_name("FILE");
    command
        ->add_option("--missing", flags->missing,
                     "what a submission's missing or damaged file does: placeholder draws a "
                     "checker or a box for it; error grades with no points; default placeholder")
        ->type_name("error|placeholder");
    takesNumber(command->add_option("--jobs", flags->jobs, "processes; 0: one a core"), 0, 64);
    takesNumber(
        command->add_option("--deadline", flags->deadlineS, "longest time for one submission, s"),
        0.1, 3600);
    addGlSource(*command, flags->gl);
    takesNumber(command->add_option("--worker-memory", flags->memoryMiB,
                                    "memory of a process, MiB; 0: no cap"),
                0, 1 << 20);
    command
        ->add_option("--overrides", flags->overrides,
                     "marks and comments by hand, .csv; default: overrides.csv in DIR")
        ->type_name("FILE");
    command
        ->add_option("--groups", flags->groups,
                     "who handed in together, .csv; default: groups.csv in DIR")
        ->type_name("FILE");
    command
        ->add_option("--anonymous", flags->anonymous,
                     "reports show pseudonyms; FILE keeps who is who, outside of DIR")
        ->type_name("FILE");
    command
        ->add_option("--format", flags->formats,
                     "files to write, separated by commas; default: html to json")
        ->type_name(formatWords())
        ->delimiter(',');
    command->add_flag("--single", flags->isSingle,
                      "SUBMISSIONS is one submission: a folder, a scene, an image or an archive");
    command
        ->add_option("--agreement", flags->agreement,
                     "marks by people, .csv: also writes agreement.html, how far the marks agree")
        ->type_name("FILE");
    command->add_flag("--feedback", flags->hasFeedback,
                      "also writes feedback.zip, a page for each student, for Moodle");
    command->add_flag("--print-rubric", flags->printRubric, "writes the default rubric and ends");
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
