#include "generator/io/layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "generator/io/formats.h"

namespace farol::generator::io {
namespace {

/// The lists of a layout, in order: P positions, N normals, T texture coordinates, I indices. 8, 6
/// and 5 are interleaved vertices of that many numbers: position, normal and texture coordinate;
/// without the texture coordinate; without the normal.
constexpr std::string_view kLayouts[] = {"PNT", "PTN",  "PNTI", "PTNI", "PNI", "PTI", "PIN", "PINT",
                                         "PI",  "IPNT", "IPN",  "IP",   "8I",  "6I",  "5I",  "I8",
                                         "I6",  "I5",   "PN",   "PT",   "8",   "6",   "5",   "P"};
/// Where counts stand: all at the head; each before its list; one at the head for all lists of
/// vertices, and indices to the end.
enum class Counts { head, each, one };

/// Units of a count: entries of its list (of indices: numbers), numbers, triangles, quads.
constexpr std::size_t kUnits = 4;

constexpr std::size_t widthOf(char list) {
    switch (list) {
        case 'P':
        case 'N':
            return 3;
        case 'T':
            return 2;
        case 'I':
            return 1;
        default:
            return static_cast<std::size_t>(list - '0');
    }
}

/// The numbers of a file for a layout: those of a text are of one kind, a word of a binary file is
/// a float or an integer.
class Cells {
  public:
    explicit Cells(const std::vector<double>& values) : values_(&values), size_(values.size()) {}
    explicit Cells(const NumberRows& rows) : Cells(rows.values) { rows_ = &rows; }
    Cells(std::string_view bytes, std::size_t wordsPerCount)
        : bytes_(bytes), size_(bytes.size() / 4), wordsPerCount_(wordsPerCount) {}

    std::size_t size() const { return size_; }
    std::size_t wordsPerCount() const { return wordsPerCount_; }
    bool isBinary() const { return values_ == nullptr; }
    double number(std::size_t at) const {
        return values_ != nullptr ? (*values_)[at] : double{std::bit_cast<float>(word(at))};
    }
    /// Whether the rows of a text agree with a list: it begins and ends with a row, and each of its
    /// rows holds whole entries or one number. A text of one row agrees with any list.
    bool fits(std::size_t first, std::size_t numbers, std::size_t width) const {
        if (rows_ == nullptr || rows_->rows.size() == 1) return true;
        auto row =
            std::lower_bound(rows_->rows.begin(), rows_->rows.end(), first,
                             [](const Row& one, std::size_t wanted) { return one.first < wanted; });
        std::size_t at = first;
        for (; at < first + numbers && row != rows_->rows.end(); ++row) {
            if (row->first != at || (row->count != 1 && row->count % width != 0)) return false;
            at += row->count;
        }
        return at == first + numbers;
    }
    /// A count or index; -1 where it is none.
    double whole(std::size_t at) const {
        const double value = values_ != nullptr ? (*values_)[at] : static_cast<double>(word(at));
        return isCount(value) && value <= 4294967295.0 ? value : -1.0;
    }
    double count(std::size_t at) const {
        if (at + wordsPerCount_ > size_) return -1.0;
        if (wordsPerCount_ == 2 && word(at + 1) != 0) return -1.0;
        return whole(at);
    }

  private:
    std::uint32_t word(std::size_t at) const {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < 4; ++k)
            value |= std::uint32_t{static_cast<unsigned char>(bytes_[4 * at + k])} << (8 * k);
        return value;
    }

    const std::vector<double>* values_ = nullptr;
    const NumberRows* rows_ = nullptr;
    std::string_view bytes_;
    std::size_t size_;
    std::size_t wordsPerCount_ = 1;
};

struct List {
    char kind;
    std::size_t first = 0, numbers = 0;
};

/// Numbers of a list with a count in a unit; 0 where it is not possible.
std::size_t numbersOf(char kind, double count, std::size_t unit) {
    if (count < 1 || count > 4e8) return 0;
    const auto n = static_cast<std::size_t>(count);
    const std::size_t width = widthOf(kind);
    switch (unit) {
        case 0:
            return n * width;
        case 1:
            return width > 1 && n % width == 0 ? n : 0;
        case 2:  // triangles: three entries
            return 3 * n * width;
        default:
            return kind == 'I' ? 4 * n : 0;
    }
}

/// Returns the lists of a layout if their length equals the file's; else none.
std::vector<List> place(const Cells& cells, std::string_view layout, Counts counts,
                        std::size_t vertexUnit, std::size_t indexUnit) {
    const std::size_t per = cells.wordsPerCount();
    std::vector<List> lists;
    std::size_t at = counts == Counts::head ? per * layout.size() : counts == Counts::one ? per : 0;
    if (at >= cells.size()) return {};
    for (std::size_t k = 0; k < layout.size(); ++k) {
        const char kind = layout[k];
        std::size_t numbers = 0;
        if (counts == Counts::one && kind == 'I') {
            if (k + 1 < layout.size() || at >= cells.size() || indexUnit > 0) return {};
            numbers = cells.size() - at;
        } else {
            const std::size_t from = counts == Counts::head   ? per * k
                                     : counts == Counts::each ? at
                                                              : 0;
            numbers = numbersOf(kind, cells.count(from), kind == 'I' ? indexUnit : vertexUnit);
            if (counts == Counts::each) at += per;
        }
        if (numbers == 0 || at + numbers > cells.size() || !cells.fits(at, numbers, widthOf(kind)))
            return {};
        lists.push_back({kind, at, numbers});
        at += numbers;
    }
    if (at != cells.size()) return {};
    return lists;
}

/// Sizes that coordinates have, and other bytes read as floats have not.
bool isPlausiblePlace(const Cells& cells, double value) {
    const double size = std::abs(value);
    if (!cells.isBinary()) return size <= kMaxCoordinate;
    return size < 1e12 && (size == 0.0 || size > 1e-24);
}

bool isUnit(const glm::vec3& normal) {
    const double squared = glm::dot(glm::dvec3(normal), glm::dvec3(normal));
    return std::abs(squared - 1.0) < 0.02;
}

/// Fills the mesh's lists; nothing where the numbers do not fit the layout.
class LayoutReader {
  public:
    LayoutReader(const Cells& cells, const std::string& file) : cells_(cells), file_(file) {}

    std::optional<RawMesh> read(const std::vector<List>& lists, bool quads) {
        mesh_ = {};
        for (const List& list : lists)
            if (list.kind != 'I' && !vertices(list)) return std::nullopt;
        if (mesh_.positions.size() < 3) return std::nullopt;
        const std::size_t count = mesh_.positions.size();
        if (mesh_.normals.size() == 1) mesh_.normals.assign(count, mesh_.normals[0]);
        if (!mesh_.normals.empty() && mesh_.normals.size() != count) return std::nullopt;
        if (!mesh_.uvs.empty() && mesh_.uvs.size() != count) return std::nullopt;
        for (const List& list : lists)
            if (list.kind == 'I' && !indices(list, quads)) return std::nullopt;
        if (mesh_.indices.empty()) {
            if (mesh_.positions.size() % 3 != 0) return std::nullopt;
            checkTriangles(mesh_.positions.size() / 3, file_);
            mesh_.indices.resize(mesh_.positions.size());
            std::iota(mesh_.indices.begin(), mesh_.indices.end(), 0U);
        }
        return std::move(mesh_);
    }

  private:
    bool vertices(const List& list) {
        const std::size_t width = widthOf(list.kind), count = list.numbers / width;
        if (list.numbers % width != 0) return false;
        checkCounts(mesh_.positions.size() + count, 0, file_);
        std::size_t odd = 0, normals = 0;
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t at = list.first + i * width;
            if (list.kind != 'N' && list.kind != 'T') {
                const glm::dvec3 place(cells_.number(at), cells_.number(at + 1),
                                       cells_.number(at + 2));
                for (int k = 0; k < 3; ++k)
                    if (!isPlausiblePlace(cells_, place[k])) return false;
                mesh_.positions.push_back(place);
                at += 3;
            }
            if (list.kind == 'N' || width >= 6) {
                const glm::vec3 normal(cells_.number(at), cells_.number(at + 1),
                                       cells_.number(at + 2));
                odd += isUnit(normal) ? 0 : 1;
                ++normals;
                mesh_.normals.push_back(normal);
                at += 3;
            }
            if (list.kind == 'T' || width == 8 || width == 5) {
                const glm::dvec2 uv(cells_.number(at), cells_.number(at + 1));
                if (!isPlausiblePlace(cells_, uv.x) || !isPlausiblePlace(cells_, uv.y))
                    return false;
                mesh_.uvs.push_back(uv);
            }
        }
        return 10 * odd <= normals;
    }

    bool indices(const List& list, bool quads) {
        const std::size_t corners = quads ? 4 : 3;
        if (list.numbers % corners != 0) return false;
        const auto size = static_cast<double>(mesh_.positions.size());
        double least = size, most = 0;
        for (std::size_t i = 0; i < list.numbers; ++i) {
            const double index = cells_.whole(list.first + i);
            if (index < 0) return false;
            least = std::min(least, index);
            most = std::max(most, index);
        }
        const double base = least >= 1.0 && most == size ? 1.0 : 0.0;
        if (most - base >= size) return false;
        checkTriangles(list.numbers / corners * (corners - 2), file_);
        const auto corner = [&](std::size_t at) {
            return static_cast<std::uint32_t>(cells_.whole(at) - base);
        };
        std::size_t flat = 0;  // triangles with a corner twice
        for (std::size_t at = list.first; at < list.first + list.numbers; at += corners)
            for (std::size_t k = 2; k < corners; ++k) {
                const std::uint32_t a = corner(at), b = corner(at + k - 1), c = corner(at + k);
                flat += a == b || b == c || c == a ? 1 : 0;
                mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
            }
        return 2 * flat <= mesh_.triangles();
    }

    const Cells& cells_;
    const std::string& file_;
    RawMesh mesh_;
};

std::optional<RawMesh> guessLists(const Cells& cells, const std::string& file) {
    LayoutReader reader(cells, file);
    for (const std::string_view layout : kLayouts)
        for (const Counts counts : {Counts::each, Counts::head, Counts::one}) {
            const bool hasIndices = layout.find('I') != std::string_view::npos;
            if (counts == Counts::head && layout.size() == 1) continue;  // as `each`
            for (std::size_t vertexUnit = 0; vertexUnit + 1 < kUnits; ++vertexUnit)
                for (std::size_t unit = 0; unit < (hasIndices ? kUnits : 1); ++unit) {
                    const auto lists = place(cells, layout, counts, vertexUnit, unit);
                    if (lists.empty()) continue;
                    if (auto mesh = reader.read(lists, unit == 3)) return mesh;
                }
        }
    return std::nullopt;
}

/// Rows of places, then as many of normals, then as many of two coordinates, without any count.
std::optional<RawMesh> guessByWidths(const NumberRows& rows) {
    const auto isPair = [](const Row& row) { return row.count == 2; };
    const auto first = std::find_if(rows.rows.begin(), rows.rows.end(), isPair);
    const auto pairs = static_cast<std::size_t>(rows.rows.end() - first);
    const auto before = static_cast<std::size_t>(first - rows.rows.begin());
    if (pairs == 0 || !std::all_of(first, rows.rows.end(), isPair) ||
        !std::all_of(rows.rows.begin(), first, [](const Row& row) { return row.count == 3; }) ||
        (before != pairs && before != 2 * pairs))
        return std::nullopt;
    const Cells cells(rows.values);
    std::vector<List> lists{{'P', 0, 3 * pairs}};
    if (before == 2 * pairs) lists.push_back({'N', 3 * pairs, 3 * pairs});
    lists.push_back({'T', 3 * before, 2 * pairs});
    return LayoutReader(cells, rows.file).read(lists, false);
}

/// A triangle a row: three times place and coordinate (15) or place and normal (18). Or a vertex a
/// row with the weight 1 behind it (4).
std::optional<RawMesh> guessWideRows(const NumberRows& rows) {
    const std::uint32_t width = rows.rows[0].count;
    if (!std::all_of(rows.rows.begin(), rows.rows.end(),
                     [width](const Row& row) { return row.count == width; }))
        return std::nullopt;
    const Cells cells(rows.values);
    if (width == 15 || width == 18)
        return LayoutReader(cells, rows.file)
            .read({{width == 15 ? '5' : '6', 0, rows.values.size()}}, false);
    if (width != 4) return std::nullopt;
    std::vector<double> places;
    for (const Row& row : rows.rows) {
        const double* v = rows.at(row);
        if (v[3] != 1.0) return std::nullopt;
        places.insert(places.end(), v, v + 3);
    }
    const Cells bare(places);
    return LayoutReader(bare, rows.file).read({{'P', 0, places.size()}}, false);
}

}  // namespace

std::optional<RawMesh> guessLayout(const NumberRows& rows) {
    if (auto mesh = guessByWidths(rows)) return mesh;
    if (auto mesh = guessWideRows(rows)) return mesh;
    return guessLists(Cells(rows), rows.file);
}

std::optional<RawMesh> guessBinaryLayout(std::string_view bytes, const std::string& fileName) {
    if (bytes.size() % 4 != 0 || bytes.find('\0') == std::string_view::npos) return std::nullopt;
    for (const std::size_t wordsPerCount : {1U, 2U})
        if (auto mesh = guessLists(Cells(bytes, wordsPerCount), fileName)) return mesh;
    return std::nullopt;
}

}  // namespace farol::generator::io
