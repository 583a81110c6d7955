// Texts that are generated from the table of metrics.
#include "core/text.h"
#include "grade/rubric/metrics.h"

namespace farol::grade {
namespace {

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

}  // namespace farol::grade
