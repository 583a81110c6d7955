#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/pseudonyms.h"
#include "cli/submissions.h"
#include "grade/report/overrides.h"
#include "grade/report/report.h"
#include "grade/rubric/rubric.h"
#include "worker/backend.h"
#include "worker/tasks/grade.h"

namespace farol::cli {

/// Stages of a run, summed over its workers, ms.
struct BatchTimes {
    double readMs = 0, drawMs = 0, compareMs = 0, wallMs = 0;
    std::size_t graded = 0, kept = 0;  ///< kept: taken from an earlier run
};

struct BatchOptions {
    /// Of each task; the points and the pass mark of the first are the class's.
    std::vector<grade::Rubric> rubrics;
    grade::Overrides overrides;
    grade::Groups groups;
    std::optional<Pseudonyms> pseudonyms;
    std::string resultsDir;  ///< where each result is kept, so that a run can go on
    int jobs = 1;
    Language language = Language::en;  ///< of the reports
    /// Effect of a submission's missing or damaged file; references must be complete.
    render::Missing missing = render::Missing::placeholder;
    std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Grades every submission in every task over the backend. A submission that cannot be read, ends
/// its worker or is late has that for a result; only a fault of the reference is thrown.
class Batch {
  public:
    Batch(worker::Backend& backend, std::vector<Submission> submissions,
          std::vector<GradeTask> tasks, BatchOptions options);

    BatchTimes run();
    grade::ClassResult result() const;

  private:
    struct Task;
    std::string keyOf(const grade::Subject& subject, const Task& task) const;
    grade::TaskResult loadTask(std::size_t submission, std::size_t task) const;
    void gradeOne(std::size_t submission, std::size_t task);
    bool failed();
    grade::SubmissionResult load(std::size_t submission) const;

    worker::Backend& backend_;
    std::vector<Submission> submissions_;
    std::vector<GradeTask> names_;
    BatchOptions options_;
    std::vector<std::shared_ptr<Task>> tasks_;
    struct Entry {
        std::string file;  ///< of the result; empty: failed
        std::string code, failure;
        std::string document;  ///< TaskResult::document
    };
    std::vector<Entry> entries_;  ///< by submission, then task
    BatchTimes times_;
    std::exception_ptr fault_;  ///< that ends the run: results cannot be written
    std::mutex mutex_;
};

}  // namespace farol::cli
