#include <algorithm>

#include "grade/formats/formats.h"

namespace farol::grade {
namespace {

constexpr Format kFormats[] = {
    {.name = "html",
     .file = "report.html",
     .summary = "a page of all submissions, for reading",
     .isDefault = true,
     .ofClass = writeHtml},
    {.name = "class",
     .file = "class.html",
     .summary = "a page about the class, for the teacher",
     .isDefault = true,
     .ofClass = writeClassPage},
    {.name = "moodle",
     .file = "grades.csv",
     .summary = "Moodle's offline grading worksheet",
     .source = "https://docs.moodle.org/en/Assignment_settings",
     .sourceDate = "as before this table",
     .required = "Identifier, Full name, Grade, Maximum Grade, Last modified (grade), "
                 "Feedback comments",
     .isDefault = true,
     .ofClass = writeCsv},
    {.name = "criteria",
     .file = "criteria.csv",
     .summary = "a column for each task and criterion",
     .isDefault = true,
     .ofClass = writeCriteria},
    {.name = "junit",
     .file = "junit.xml",
     .summary = "JUnit's XML, for CI services",
     .source = "https://github.com/testmoapp/junitxml",
     .sourceDate = "as before this table",
     .required = "testsuites, testsuite, testcase; failure, error",
     .isDefault = true,
     .ofClass = writeJunit},
    {.name = "json",
     .file = "report.json",
     .summary = "everything but the images, for programs",
     .isDefault = true,
     .ofClass = writeJson},
    {.name = "gradescope",
     .file = "results.json",
     .summary = "Gradescope autograder: a test a criterion, HTML with the images",
     .source = "https://gradescope-autograders.readthedocs.io/en/latest/specs/",
     .sourceDate = "Ubuntu 18.04 to 22.04 images",
     .required = "score, or a score in each of tests",
     .limits = "none that the page names",
     .ofOne = writeGradescope},
    {.name = "prairielearn",
     .file = "results.json",
     .summary = "PrairieLearn external grader: score 0 to 1, tests, images",
     .source = "https://docs.prairielearn.com/externalGrading/",
     .sourceDate = "commit 06a6d590",
     .required = "score in [0, 1], or gradable false",
     .limits = "1 MB: images that do not fit are left out",
     .ofOne = writePrairieLearn},
    {.name = "submitty",
     .file = "validation_results.json",
     .summary = "Submitty custom validator: score 0 to 1 and messages",
     .source = "https://submitty.org/instructor/autograding/validation",
     .sourceDate = "commit 10a101de",
     .required = "status; data with score in [0, 1] and message",
     .limits = "none that the page names",
     .ofOne = writeSubmitty},
    {.name = "vpl",
     .file = "vpl.txt",
     .summary = "Moodle's Virtual Programming Lab: what vpl_execution prints",
     .source = "https://vpl.dis.ulpgc.es/documentation/vpl-3.4.3+/advancedfeatures.html",
     .sourceDate = "VPL 3.4.3",
     .required = "Grade :=>> and a number; Comment :=>> and a text",
     .limits = "none that the page names; no images",
     .ofOne = writeVpl},
    {.name = "classroom50",
     .file = "result.json",
     .summary = "Classroom 50 autograder: classroom50/result/v1",
     .source = "https://github.com/foundation50/classroom50/wiki/Advanced-Autograding",
     .sourceDate = "2026-08-16",
     .required = "schema, classroom, assignment, submission, commit, release, review, datetime, "
                 "score, max-score, tests",
     .limits = "10 MiB; scores are integers",
     .environment = "CLASSROOM ASSIGNMENT SUBMISSION_TAG COMMIT_URL RELEASE_URL",
     .ofOne = writeClassroom50},
    {.name = "sarif",
     .file = "findings.sarif",
     .summary = "SARIF 2.1.0: findings on the lines of a pull request",
     .source = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html",
     .sourceDate = "2020-03-27; GitHub's page on its part of it, 2026",
     .required = "version, runs, tool.driver.name, results, message.text; GitHub: ruleId, "
                 "level, locations, partialFingerprints",
     .limits = "GitHub: 5,000 results shown; more are left out, the least severe first",
     .ofClass = writeSarif},
    {.name = "github",
     .file = "annotations.txt",
     .summary = "GitHub workflow commands: print the file in a step",
     .source = "https://docs.github.com/en/actions/reference/workflow-commands-for-github-actions",
     .sourceDate = "2026",
     .required = "::error, ::warning or ::notice with file and line",
     .limits = "10 annotations of a kind are shown for a step; the log holds all",
     .ofClass = writeGithub},
};

}  // namespace

std::span<const Format> formats() { return kFormats; }

const Format* findFormat(std::string_view name) {
    const auto* const found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                           [&](const Format& one) { return one.name == name; });
    return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace farol::grade
