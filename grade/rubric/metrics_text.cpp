// Texts that are generated from the table of metrics.
#include "core/text.h"
#include "grade/rubric/metrics.h"

namespace farol::grade {
namespace {

/// A number as JavaScript shows it in a template literal.
std::string shownInScript(const MetricColumn& column, const std::string& value) {
    const std::string number = column.format == MetricColumn::Format::percent
                                   ? "${number(100 * " + value + ")} %"
                                   : "${" + value + ".toFixed(3)}";
    return std::string(column.label) + " " + number;
}

std::string appliesTo(const MetricSpec& metric) {
    return metric.appliesToPictures() ? "pictures" : "scenes";
}

std::string defaultsOf(const MetricSpec& metric) {
    if (!metric.isInDefault) return "not in the default | ";
    const std::string weight = shortNumber(metric.weight) + " | ";
    if (metric.causes() != nullptr) return weight + "by the table of kinds";
    return weight + shortNumber(metric.image()->tolerance) + " to " +
           shortNumber(metric.image()->limit);
}

}  // namespace

std::string metricsMarkdown() {
    std::string out =
        "| measure | of | is | default weight | tolerance to limit |\n| --- | --- | --- | --- | "
        "--- |\n";
    for (const MetricSpec& metric : metrics())
        out += "| `" + std::string(metric.name) + "` | " + appliesTo(metric) + " | " +
               std::string(metric.summary) + " | " + defaultsOf(metric) + " |\n";
    return out;
}

std::string metricsOpenApi() {
    std::string out;
    for (const MetricSpec& metric : metrics()) {
        if (metric.image() == nullptr) continue;
        const auto& columns = metric.image()->columns;
        const std::string parts = joined(columns, ", ", [](const MetricColumn& column) {
            return std::string(column.key) + ": { type: number }";
        });
        out += std::string(metric.name) + ": " +
               (columns.size() == 1 ? "{ type: number }"
                                    : "{ type: object, properties: { " + parts + " } }") +
               "\n";
    }
    return out;
}

std::string metricsScript() {
    std::string out;
    for (const MetricSpec& metric : metrics()) {
        if (metric.image() == nullptr) continue;
        const auto& columns = metric.image()->columns;
        const std::string value = "view." + std::string(metric.name);
        const bool isObject = columns.size() > 1;
        const std::string text = joined(columns, ", ", [&](const MetricColumn& column) {
            return shownInScript(column, isObject ? value + "." + std::string(column.key) : value);
        });
        const std::string isThere = isObject ? value : value + " !== undefined";
        out += "    " + (&metric == &mainMetric() ? "" : isThere + " && ") + "`" + text + "`,\n";
    }
    return out;
}

}  // namespace farol::grade
