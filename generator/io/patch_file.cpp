#include "generator/io/patch_file.h"

#include "generator/io/plain_text.h"
#include "generator/io/rows.h"

namespace farol::generator::io {
namespace {

/// A count that stands alone on its row, with that many rows of `width` numbers after it.
std::size_t readCount(const NumberRows& rows, std::size_t at, std::uint32_t width,
                      const std::string& what) {
    if (at >= rows.rows.size())
        rows.refuse("mesh.truncated", rows.rows.back(),
                    "the file ends before the number of " + what);
    const Row& row = rows.rows[at];
    const double value = *rows.at(row);
    if (row.count != 1 || !isCount(value) || value < 1)
        rows.refuse("mesh.count", row, "expected the number of " + what);
    const std::size_t left = rows.rows.size() - at - 1;
    if (value > static_cast<double>(left))
        rows.refuse("mesh.truncated", row,
                    "the file says " + std::to_string(static_cast<long long>(value)) + " " + what +
                        " but only " + std::to_string(left) + " lines follow");
    const auto count = static_cast<std::size_t>(value);
    for (std::size_t i = at + 1; i <= at + count; ++i)
        if (rows.rows[i].count != width)
            rows.refuse("mesh.syntax", rows.rows[i],
                        "expected " + std::to_string(width) + " numbers, not " +
                            std::to_string(rows.rows[i].count));
    return count;
}

}  // namespace

PatchFile parsePatchFile(std::string_view bytes, const std::string& fileName) {
    std::string storage;
    const NumberRows rows = parseRows(plainText(bytes, storage), fileName);
    const std::size_t patches = readCount(rows, 0, 16, "patches");
    const std::size_t pointsAt = patches + 1;
    const std::size_t points = readCount(rows, pointsAt, 3, "control points");
    if (rows.rows.size() > pointsAt + 1 + points)
        rows.refuse("mesh.syntax", rows.rows[pointsAt + 1 + points],
                    "the file goes on after its " + std::to_string(points) + " control points");
    PatchFile out;
    for (std::size_t i = 1; i <= patches; ++i) {
        const Row& row = rows.rows[i];
        for (std::size_t k = 0; auto& index : out.patches.emplace_back())
            index = indexIn(rows, row, rows.at(row)[k++], points);
    }
    for (std::size_t i = pointsAt + 1; i < rows.rows.size(); ++i) {
        out.points.push_back(placeAt(rows, rows.rows[i], rows.at(rows.rows[i])));
    }
    return out;
}

}  // namespace farol::generator::io
