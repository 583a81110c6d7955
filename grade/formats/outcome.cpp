#include "grade/formats/outcome.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "core/text.h"
#include "grade/rubric/grader.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

Location placeOf(const ordered_json& finding, const std::string& document) {
    Location where{toUtf8(finding.value("file", "")), finding.value("line", 0),
                   finding.value("column", 0)};
    if (document.empty()) return where;
    const std::filesystem::path path(document);
    if (where.file.empty() || where.file == toUtf8(path.filename().string()))
        where.file = toUtf8(document);
    else
        where.file = toUtf8((path.parent_path() / where.file).string());
    return where;
}

OutcomeFinding causeOf(const ordered_json& finding, const std::string& document) {
    OutcomeFinding out;
    out.code = finding.value("code", "");
    out.message = onOneLine(finding.value("message", ""));
    out.points = finding.value("points", 0.0);
    out.severity =
        out.points > 0.0 || out.code.ends_with(".missing") ? Severity::warning : Severity::info;
    out.where = placeOf(finding, document);
    return out;
}

OutcomeFinding diagnosticOf(const ordered_json& diagnostic, const std::string& document) {
    OutcomeFinding out;
    out.code = diagnostic.value("code", "");
    out.message = onOneLine(diagnostic.value("message", ""));
    const std::string word = diagnostic.value("severity", "");
    for (const Severity severity : {Severity::info, Severity::warning, Severity::error})
        if (word == kSeverityWords[severity]) out.severity = severity;
    out.where = placeOf(diagnostic, document);
    return out;
}

void readImages(OutcomePart& part, const ordered_json& grade, const TaskGrade& task,
                const std::vector<std::string>& references) {
    const ordered_json views = grade.value("views", ordered_json::array());
    for (std::size_t v = 0; 2 * v < task.pictures.size(); ++v) {
        std::string label = "view " + std::to_string(v + 1);
        if (v < views.size() && views[v].value("name", "") != "")
            label += " (" + onOneLine(views[v].value("name", "")) + ")";
        const std::string& own = task.pictures[2 * v];
        // A render that is the reference's is kept once.
        if (!own.empty())
            part.images.push_back({"submission, " + label, own});
        else if (v < references.size())
            part.images.push_back({"submission, " + label, references[v]});
        if (2 * v + 1 < task.pictures.size() && !task.pictures[2 * v + 1].empty())
            part.images.push_back({"difference, " + label, task.pictures[2 * v + 1]});
    }
}

OutcomePart partOf(const TaskResult& task, const std::vector<std::string>& references) {
    OutcomePart part;
    part.task = toUtf8(task.task);
    if (const TaskFailure* failure = task.failure()) {
        part.reason = onOneLine(failure->message);
        part.diagnostics.push_back(
            {failure->code, part.reason, Severity::error, {toUtf8(task.document), 0, 0}, 0});
        return part;
    }
    const ordered_json grade = parseOrderedJson(task.grade()->json, kGradeJson);
    part.isGraded = !grade.value("refused", false);
    part.points = grade.value("points", 0.0);
    part.most = grade.value("most", 0.0);
    part.penalty = grade.value("penalty", 0.0);
    part.unexplained = grade.value("unexplained", ordered_json::object()).value("points", 0.0);
    for (const auto& criterion : grade.value("criteria", ordered_json::array())) {
        OutcomeItem item;
        item.id = criterion.value("measure", "");
        item.name = onOneLine(criterion.value("text", item.id));
        item.points = criterion.value("points", 0.0);
        item.most = criterion.value("most", 0.0);
        item.reason = onOneLine(criterion.value("reason", ""));
        part.items.push_back(std::move(item));
    }
    for (const auto& finding : grade.value("findings", ordered_json::array())) {
        const std::string criterion = finding.value("criterion", "");
        const auto item = std::find_if(part.items.begin(), part.items.end(),
                                       [&](const auto& one) { return one.id == criterion; });
        (item == part.items.end() ? part.diagnostics : item->findings)
            .push_back(causeOf(finding, task.document));
    }
    for (const auto& diagnostic : grade.value("diagnostics", ordered_json::array()))
        part.diagnostics.push_back(diagnosticOf(diagnostic, task.document));
    if (grade.contains("reason")) {
        part.reason = onOneLine(grade["reason"].value("message", ""));
        if (part.diagnostics.empty())
            part.diagnostics.push_back({grade["reason"].value("code", ""),
                                        part.reason,
                                        Severity::error,
                                        {toUtf8(task.document), 0, 0},
                                        0});
    }
    readImages(part, grade, *task.grade(), references);
    return part;
}

}  // namespace

std::string onOneLine(const std::string& text) {
    std::string line = toUtf8(text);
    std::replace_if(
        line.begin(), line.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    // Separators that readers take for the end of a line: NEL, LS, PS.
    for (const char* end : {"\xC2\x85", "\xE2\x80\xA8", "\xE2\x80\xA9"})
        for (std::size_t at = line.find(end); at != std::string::npos; at = line.find(end, at))
            line.replace(at, std::string_view(end).size(), " ");
    return line;
}

Outcome outcomeOf(const ClassResult& all, std::size_t index) {
    const SubmissionResult one = all.at(index);
    Outcome out{onOneLine(one.id),
                onOneLine(one.name),
                onOneLine(all.title),
                one.points,
                one.most,
                one.graded,
                one.passed,
                {},
                {}};
    for (const std::string& comment : one.comments) out.comments.push_back(onOneLine(comment));
    for (std::size_t t = 0; t < one.tasks.size(); ++t)
        out.parts.push_back(partOf(one.tasks[t], t < all.references.size()
                                                     ? all.references[t]
                                                     : std::vector<std::string>{}));
    return out;
}

}  // namespace farol::grade
