#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/message.h"
#include "grade/rubric/frame.h"
#include "grade/rubric/severity.h"

/// The metrics that a rubric's criteria go by, in one table (metrics.cpp). From it follow the
/// rubric's reader, its default and JSON schema, scoring, the reports' columns and sentences, and
/// the tables of docs/grading.md and api/openapi.yaml.
namespace farol::grade {

/// A metric's result for one view.
struct Measurement {
    double loss = 0.0;            ///< 0 (alike) to 1
    std::vector<double> columns;  ///< for reports: one number for each of the columns
};

/// A number of a metric in reports.
struct MetricColumn {
    std::string_view key;    ///< in JSON, where the metric has several columns: "p95"
    std::string_view label;  ///< before the number: "95th percentile"
    enum class Format { percent, decimals } format;  ///< 12.5 %, or 0.125
};

/// A metric that is computed of each view. One that needs layers applies to scenes alone, others
/// to pictures too.
struct ImageMetric {
    FrameParts needs;
    Measurement (*compute)(FramePair& pair);
    Message (*sentence)(double loss);  ///< without the full stop
    std::vector<MetricColumn> columns;
    double tolerance = 0.0, limit = 1.0;  ///< of a rubric that does not set them
};

/// A metric of scenes: the share of the present work that the causes of a topic leave correct.
struct CauseMetric {
    Topic topic;
    double perFinding = 0.5;  ///< of a rubric that does not set it: costs as in the table of kinds
};

struct MetricSpec {
    std::string_view name;     ///< "measure" of a criterion, key in JSON: "ssim"
    std::string_view summary;  ///< for docs/grading.md
    std::variant<ImageMetric, CauseMetric> kind;
    double weight = 1.0;  ///< of a rubric that does not set it
    bool isInDefault = true;

    const ImageMetric* image() const { return std::get_if<ImageMetric>(&kind); }
    const CauseMetric* causes() const { return std::get_if<CauseMetric>(&kind); }
    /// Whether it compares pictures that no scene is known of.
    bool appliesToPictures() const { return image() != nullptr && !image()->needs.hasLayers(); }
};

/// All metrics, in the order of reports. Their addresses are the metrics' identity.
std::span<const MetricSpec> metrics();

/// Returns the first metric: measured and shown with any rubric; the heat maps show it, and
/// reports order views by it.
const MetricSpec& mainMetric();

/// Formats a number with at most four digits after the point and no trailing zeros.
std::string shortNumber(double value);

/// A share as sentences show it: "12.5 %".
std::string percent(double share);

/// The table of docs/grading.md.
std::string metricsMarkdown();
/// The properties of a view in api/openapi.yaml, not indented.
std::string metricsOpenApi();

}  // namespace farol::grade
