#include "generator/io/sniff.h"

#include <algorithm>
#include <array>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/layout.h"
#include "generator/io/patch_file.h"
#include "generator/io/plain_text.h"
#include "generator/messages.h"
#include "generator/primitives/patch.h"

namespace farol::generator::io {
namespace {

/// Triangles of three rows each with a blank line between them, rather than blocks of lists.
bool isSpacedSoup(const NumberRows& rows) {
    std::vector<std::size_t> sizes(rows.blocks());
    for (const Row& row : rows.rows) {
        if (row.count != 3) return false;
        ++sizes[row.block];
    }
    const bool whole = std::all_of(sizes.begin(), sizes.end(), [](auto n) { return n % 3 == 0; });
    return whole && (sizes.size() > 4 || *std::max_element(sizes.begin(), sizes.end()) == 3);
}

RawMesh decodePatches(std::string_view bytes, const std::string& fileName) {
    const PatchFile file = parsePatchFile(bytes, fileName);
    checkTriangles(primitives::patchTriangles(file, primitives::kDefaultPatchLevel), fileName);
    const Mesh mesh = primitives::patch(file, primitives::kDefaultPatchLevel);
    RawMesh raw;
    for (std::size_t i = 0; i < mesh.positions().size(); ++i)
        raw.positions.push_back(mesh.place(i));
    raw.normals = mesh.normals();
    for (const glm::vec2& uv : mesh.uvs()) raw.uvs.emplace_back(uv);
    raw.indices = mesh.indices();
    return raw;
}

std::uint32_t widthOf(const MeshText& text, std::size_t row) { return text.rows->rows[row].count; }
std::size_t rowCount(const MeshText& text) { return text.rows ? text.rows->rows.size() : 0; }

bool isLetterAt(std::string_view line, std::size_t at) {
    const char c = line[at];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// A line of words, or one that begins as comments of other languages do.
bool isTitle(std::string_view line) {
    const std::size_t at = line.find_first_not_of(" \t\r");
    if (at == std::string_view::npos) return false;
    if (line.substr(at, 2) == "--") return true;
    return isLetterAt(line, at) ||
           std::string_view("%/*!=<>'\"$&@~^").find(line[at]) != std::string_view::npos;
}

/// True for "v" lines of positions, normals and coordinates, or faces that count from 0: no OBJ,
/// although they use its words. False for files with the ending of OBJ.
bool isHomeMadeObj(const MeshText& text) {
    if (text.ending == "obj" || !looksLikeObj(text.bytes)) return false;
    std::string_view rest = text.bytes;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        line = line.substr(0, std::min(commentStart(line, false), line.find('\r')));
        const std::size_t at = line.find_first_not_of(" \t");
        if (at == std::string_view::npos || at + 1 >= line.size()) continue;
        if (line[at + 1] != ' ' && line[at + 1] != '\t') continue;
        const bool vertex = line[at] == 'v';
        if (!vertex && line[at] != 'f') continue;
        if (line.find('/') != std::string_view::npos) return false;
        std::size_t count = 0;
        for (std::size_t k = at + 1; k < line.size();) {
            if (isSeparator(line[k])) {
                ++k;
                continue;
            }
            const std::size_t stop = tokenEnd(line, k);
            if (!vertex && line.substr(k, stop - k) == "0") return true;
            ++count;
            k = stop;
        }
        if (vertex && (count == 8 || count == 5 || count == 1)) return true;
        if (vertex && line.find(',') != std::string_view::npos) return true;
    }
    return false;
}

/// The text without its titles, which become comments.
std::string withoutTitles(std::string_view bytes) {
    std::string out;
    out.reserve(bytes.size() + 64);
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        if (isTitle(bytes.substr(0, end))) out += '#';
        out += bytes.substr(0, std::min(end + 1, bytes.size()));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
    }
    return out;
}

/// The text with blanks for the words that lines begin with: "glVertex3f(0, 1, 2);".
std::string withoutFirstWords(std::string_view bytes) {
    std::string out(bytes);
    bool first = true;
    for (std::size_t at = 0; at < out.size(); ++at) {
        if (out[at] == '\n') {
            first = true;
        } else if (first && isLetterAt(out, at)) {
            for (; at < out.size() && !isSeparator(out[at]) && out[at] != '\n' && out[at] != ':' &&
                   out[at] != '=';
                 ++at)
                out[at] = ' ';
            if (at < out.size() && out[at] != '\n') out[at] = ' ';
            if (at < out.size() && out[at] == '\n') --at;
            first = false;
        } else if (!isSeparator(out[at])) {
            first = false;
        }
    }
    return out;
}

/// Rows of one width that count themselves: 0, 1, 2 or 1, 2, 3 before a vertex or a triangle.
bool isNumbered(const NumberRows& rows) {
    const std::uint32_t width = rows.rows[0].count;
    if (width != 4 && width != 7 && width != 10) return false;
    const double first = *rows.at(rows.rows[0]);
    if (first != 0.0 && first != 1.0) return false;
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
        if (rows.rows[i].count != width || *rows.at(rows.rows[i]) != first + static_cast<double>(i))
            return false;
    return rows.rows.size() >= (width == 10 ? 1U : 3U);
}

RawMesh decodeNumbered(const NumberRows& rows) {
    NumberRows bare;
    bare.file = rows.file;
    for (Row row : rows.rows) {
        const double* v = rows.at(row);
        row.first = static_cast<std::uint32_t>(bare.values.size());
        bare.values.insert(bare.values.end(), v + 1, v + row.count);
        --row.count;
        bare.rows.push_back(row);
    }
    return decodeSoup(bare);
}

/// OFF without its word and "4 2 0" before places and triangles: the counts are right.
bool hasThreeCounts(const NumberRows& rows) {
    const double* head = rows.at(rows.rows[0]);
    const auto left = static_cast<double>(rows.rows.size() - 1);
    if (rows.rows[0].count != 3 || !isCount(head[0]) || !isCount(head[1]) || !isCount(head[2]) ||
        head[0] < 3 || head[1] < 1 || head[0] + head[1] != left)
        return false;
    for (std::size_t i = 1 + static_cast<std::size_t>(head[0]); i < rows.rows.size(); ++i) {
        const Row& row = rows.rows[i];
        for (std::uint32_t k = 0; k < row.count; ++k)
            if (!isCount(rows.at(row)[k]) || rows.at(row)[k] > std::max(head[0], 4.0)) return false;
    }
    return rows.rows.back().count >= 3;
}

RawMesh decodeThreeCounts(const MeshText& text) {
    const Row& last = text.rows->rows.back();
    const bool off = last.count >= 4 && *text.rows->at(last) == last.count - 1.0;
    return off ? decodeOff(text.bytes, text.file) : decodeCounted(*text.rows);
}

constexpr std::size_t kFirstOfRows = 8;  ///< index in the table of the first form that reads rows

const std::vector<MeshForm>& formTable() {
    static const std::vector<MeshForm> made = {
        {"binary", [](const MeshText& t) { return looksLikeBinary(t.bytes); },
         [](const MeshText& t) { return decodeBinary(t.bytes, t.file); }},
        {"PLY", [](const MeshText& t) { return looksLikePly(t.bytes); },
         [](const MeshText& t) { return decodePly(t.bytes, t.file, true); }},
        {"STL", [](const MeshText& t) { return looksLikeStl(t.bytes, t.file); },
         [](const MeshText& t) { return decodeStl(t.bytes, t.file); }},
        {"OFF", [](const MeshText& t) { return looksLikeOff(t.bytes, t.file); },
         [](const MeshText& t) { return decodeOff(t.bytes, t.file); }},
        {"patches", [](const MeshText& t) { return t.ending == "patch"; },
         [](const MeshText& t) { return decodePatches(t.bytes, t.file); }},
        {"elements",
         [](const MeshText& t) { return t.ending != "obj" && looksLikeElements(t.bytes); },
         [](const MeshText& t) { return decodeElements(t.bytes, t.file); }},
        {"OBJ from 0", isHomeMadeObj,
         [](const MeshText& t) { return decodeLabelled(t.bytes, t.file); }},
        {"OBJ", [](const MeshText& t) { return t.ending == "obj" || looksLikeObj(t.bytes); },
         [](const MeshText& t) { return decodeObj(t.bytes, t.file); }},
        {"lists",
         [](const MeshText& t) {
             return t.rows && t.rows->rows[0].count >= 3 && looksLikeLists(t.bytes);
         },
         [](const MeshText& t) { return decodeLists(t.bytes, t.file); }},
        {"stream", [](const MeshText& t) { return t.rows && looksLikeStream(*t.rows); },
         [](const MeshText& t) { return decodeStream(*t.rows); }},
        {"numbered rows", [](const MeshText& t) { return t.rows && isNumbered(*t.rows); },
         [](const MeshText& t) { return decodeNumbered(*t.rows); }},
        {"three counts", [](const MeshText& t) { return t.rows && hasThreeCounts(*t.rows); },
         decodeThreeCounts},
        {"patches in rows",
         [](const MeshText& t) {
             const std::size_t count = rowCount(t);
             return count > 2 && widthOf(t, 0) == 1 && widthOf(t, 1) == 16;
         },
         [](const MeshText& t) { return decodePatches(t.bytes, t.file); }},
        {"two counts",
         [](const MeshText& t) {
             const std::size_t count = rowCount(t);
             return (count > 1 && widthOf(t, 0) == 2) ||
                    (count > 2 && widthOf(t, 0) == 1 && widthOf(t, 1) == 1 && widthOf(t, 2) == 3);
         },
         [](const MeshText& t) { return decodeCounted(*t.rows); }},
        {"sections",
         [](const MeshText& t) {
             return rowCount(t) > 0 && widthOf(t, 0) == 1 && looksLikeSections(*t.rows);
         },
         [](const MeshText& t) { return decodeSections(*t.rows); }},
        {"one count", [](const MeshText& t) { return rowCount(t) > 1 && widthOf(t, 0) == 1; },
         [](const MeshText& t) { return decodeSingleCount(*t.rows); }},
        {"blocks",
         [](const MeshText& t) {
             return rowCount(t) > 0 && widthOf(t, 0) == 3 && t.rows->blocks() > 1 &&
                    !looksLikeThreeLines(*t.rows) && !isSpacedSoup(*t.rows);
         },
         [](const MeshText& t) { return decodeBlocks(*t.rows); }},
        {"soup", [](const MeshText& t) { return rowCount(t) > 0; },
         [](const MeshText& t) { return decodeSoup(*t.rows); }},
        {"floats", [](const MeshText& t) { return looksLikeFloats(t.bytes); },
         [](const MeshText& t) { return decodeFloats(t.bytes, t.file); }},
        {"labelled", [](const MeshText& t) { return looksLabelled(t.bytes); },
         [](const MeshText& t) { return decodeLabelled(t.bytes, t.file); }},
    };
    return made;
}

/// Numbers and comments alone, or why they are not.
void parseAsRows(MeshText& text) {
    try {
        text.rows = parseRows(text.bytes, text.file);
    } catch (const Error& error) {
        text.notRows = error;
    }
}

/// Returns the first form that recognises the text. Parses its rows only if no earlier form does.
const MeshForm* recogniseForm(MeshText& text) {
    const std::vector<MeshForm>& forms = formTable();
    for (const MeshForm& form : forms) {
        const bool needsRows = &form == &forms[kFirstOfRows];
        if (needsRows) parseAsRows(text);
        if (form.recognise(text)) return &form;
    }
    return nullptr;
}

/// True for a form that is recognised by its numbers alone, so that another form may fit, too.
bool isLoose(const MeshForm& form) {
    const std::string_view name = form.name;
    return &form >= &formTable()[kFirstOfRows] || name == "OBJ from 0";
}

bool hasDigits(std::string_view bytes) { return std::any_of(bytes.begin(), bytes.end(), isDigit); }

/// Returns the kind of a file that is no mesh, by its first bytes; empty for any other.
std::string_view kindOfOther(std::string_view bytes) {
    struct Kind {
        std::string_view start, name;
    };
    using std::string_view_literals::operator""sv;
    static constexpr Kind kKinds[] = {
        {"\x89PNG", "an image"},
        {"\xFF\xD8\xFF", "an image"},
        {"GIF8", "an image"},
        {"%PDF-", "a PDF document"},
        {"PK\3\4", "a zip archive"},
        {"Rar!", "a rar archive"},
        {"7z\xBC\xAF", "a 7z archive"},
        {"\x1f\x8b", "a gzip archive"},
        {"\x7f"
         "ELF",
         "a program"},
        {"version https://git-lfs", "a pointer of Git LFS, whose file was not fetched"},
        {"BLENDER", "a Blender file"},
        {"Kaydara FBX", "an FBX file"},
        {"glTF\2", "a glTF file"},
        {"<!DOCTYPE html", "a web page"},
        {"<html", "a web page"}};
    for (const Kind& kind : kKinds)
        if (sameWord(bytes.substr(0, kind.start.size()), kind.start)) return kind.name;
    return "";
}

/// Reads a file without titles and notes among its numbers ("plane", "size 2"); else without a word
/// before each row; else as lists in another order. Nothing if none of these succeeds.
std::optional<RawMesh> readOtherwise(const MeshText& text) {
    std::vector<std::string> texts{withoutTitles(text.bytes), withoutFirstWords(text.bytes)};
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (texts[i] == text.bytes) continue;
        MeshText bare{texts[i], text.file, text.ending, {}, {}};
        const MeshForm* form = recogniseForm(bare);
        if (form == nullptr) continue;
        try {
            RawMesh mesh = form->read(bare);
            if (i == 0) ++mesh.leftOut["titles"];
            return mesh;
        } catch (const Error& error) {
            if (!error.code().starts_with("mesh.")) throw;
        }
    }
    if (text.rows) return guessLayout(*text.rows);
    for (const std::string& bare : texts) {
        MeshText rows{bare, text.file, text.ending, {}, {}};
        parseAsRows(rows);
        if (!rows.rows) continue;
        if (auto mesh = guessLayout(*rows.rows)) return mesh;
    }
    return guessBinaryLayout(text.bytes, text.file);
}

}  // namespace

std::span<const MeshForm> meshForms() { return formTable(); }

RawMesh decodeRaw(std::string_view bytes, const std::string& fileName) {
    std::string storage;
    MeshText text{plainText(bytes, storage), fileName, fileEnding(fileName), {}, {}};
    if (const std::string_view kind = kindOfOther(bytes); !kind.empty())
        throw Error(message<"mesh.format/other">("kind"_arg = kind), {fileName, 0, 0});
    const MeshForm* form = recogniseForm(text);
    std::optional<Error> first = text.notRows;
    if (form != nullptr) {
        try {
            return form->read(text);
        } catch (const Error& error) {
            if (!isLoose(*form) || !error.code().starts_with("mesh.")) throw;
            first = error;
        }
    }
    if (auto mesh = readOtherwise(text)) return std::move(*mesh);
    if (!trimmed(text.bytes).empty() && !hasDigits(text.bytes))
        throw Error(message<"mesh.format/words">("start"_arg = trimmed(text.bytes)),
                    {fileName, 0, 0});
    throw Error(*first);
}

std::string formOf(std::string_view bytes, const std::string& fileName) {
    std::string storage;
    MeshText text{plainText(bytes, storage), fileName, fileEnding(fileName), {}, {}};
    const MeshForm* form = recogniseForm(text);
    return form != nullptr ? form->name : "";
}

}  // namespace farol::generator::io
