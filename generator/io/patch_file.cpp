#include "generator/io/patch_file.h"

#include <algorithm>

#include "generator/io/plain_text.h"
#include "generator/io/rows.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// The row that holds the number `index`.
const Row& rowOf(const NumberRows& rows, std::size_t index) {
    const auto after =
        std::upper_bound(rows.rows.begin(), rows.rows.end(), index,
                         [](std::size_t wanted, const Row& row) { return wanted < row.first; });
    return *(after - 1);
}

/// A count of lists of `width` numbers that follow it, at least one.
std::size_t readCount(const NumberRows& rows, std::size_t at, std::size_t width,
                      const Message& kind) {
    if (at >= rows.values.size())
        rows.refuse(message<"mesh.truncated/patch">("kind"_arg = kind), rows.rows.back());
    const Row& row = rowOf(rows, at);
    const double value = rows.values[at];
    if (!isCount(value) || value < 1)
        rows.refuse(message<"mesh.count/patch">("kind"_arg = kind), row);
    const std::size_t left = (rows.values.size() - at - 1) / width;
    if (value > static_cast<double>(left))
        rows.refuse(message<"mesh.truncated/follow">("count"_arg = value, "kind"_arg = kind,
                                                     "left"_arg = left),
                    row);
    return static_cast<std::size_t>(value);
}

/// Whether a file is nothing but points: each sixteen of them are a patch.
bool isBare(const NumberRows& rows) {
    return rows.rows.size() % 16 == 0 && std::all_of(rows.rows.begin(), rows.rows.end(),
                                                     [](const Row& row) { return row.count == 3; });
}

PatchFile readBare(const NumberRows& rows) {
    PatchFile out;
    for (const Row& row : rows.rows) out.points.push_back(placeAt(rows, row, rows.at(row)));
    for (std::size_t i = 0; i < out.points.size(); ++i) {
        if (i % 16 == 0) out.patches.emplace_back();
        out.patches.back()[i % 16] = static_cast<std::uint32_t>(i);
    }
    return out;
}

}  // namespace

PatchFile parsePatchFile(std::string_view bytes, const std::string& fileName) {
    std::string storage;
    const NumberRows rows = parseRows(plainText(bytes, storage), fileName);
    if (isBare(rows)) return readBare(rows);
    const std::vector<double>& values = rows.values;
    const std::size_t patches = readCount(rows, 0, 16, message<"part.patches">());
    const std::size_t after = 1 + 16 * patches;
    // The points' own count may be left out.
    const bool isCounted = (values.size() - after) % 3 == 1;
    const std::size_t first = after + (isCounted ? 1 : 0);
    const std::size_t left = (values.size() - first) / 3;
    if (!isCounted && left == 0) readCount(rows, after, 3, message<"part.control-points">());
    const std::size_t points =
        isCounted ? readCount(rows, after, 3, message<"part.control-points">()) : left;
    if ((values.size() - first) != 3 * points)
        rows.refuse(message<"mesh.syntax/patch-end">("count"_arg = points),
                    rowOf(rows, std::min(first + 3 * points, values.size() - 1)));
    PatchFile out;
    const double base = indexBase(&values[1], &values[1] + 16 * patches, points);
    for (std::size_t i = 0; i < 16 * patches; ++i) {
        if (i % 16 == 0) out.patches.emplace_back();
        out.patches.back()[i % 16] =
            indexIn(rows, rowOf(rows, 1 + i), values[1 + i] - base, points);
    }
    for (std::size_t at = first; at < values.size(); at += 3)
        out.points.push_back(placeAt(rows, rowOf(rows, at), &values[at]));
    return out;
}

}  // namespace farol::generator::io
